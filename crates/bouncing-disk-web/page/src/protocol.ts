/**
 * What the page reads of the module's answers; all of it, and the requests with their units, are described in
 * `src/request.rs` and its neighbours, whose names these are. A request is JSON, so that it can be printed and given to
 * the native library, which answers it with the same bits.
 */

/** From a low to a high number. */
export type Range = [number, number];

/** Platform and disk, as `System` of the library, and how long a contact lasts (s); 0: impacts are rigid. */
export const SYSTEM_NAMES = [
  "amplitude", "twist_amplitude", "angular_frequency", "phase_lag", "contact_radius", "gyration_radius",
  "friction", "restitution", "preload_acceleration", "load_acceleration", "contact_time",
] as const; // prettier-ignore
type Parameters = Record<(typeof SYSTEM_NAMES)[number], number>;

/** Parameters, and what the library then sets to a value, one after the other: these, or what follows from them. */
export type SystemParameters = Parameters & { set?: readonly (readonly [name: string, value: number])[] };

/** A motor's data sheet, with one of each pair of alternatives; the library's `MotorParameters`. */
export type MotorSheet = {
  readonly load_torque: number;
  readonly contact?: { readonly time?: number } | null;
  readonly stator?: Stator | null;
};

/** The modes of a stator that yields, the library's `StatorParameters`: effective mass (kg), and whether it also twists. */
export type Stator = { readonly kind: string; readonly mass?: number; readonly quality?: number };

/** An impact that an orbit begins with: its phase (rad), and its normalised speed |w_A| Gamma/(A omega), positive. */
export interface ImpactStart {
  impact_phase: number;
  normalised_speed: number;
}

/** A start in the air: phase (rad) and angular speed (rad/s), gap (m) and velocity (m/s) relative to the platform. */
export type FlightStart = Record<"phase" | "gap" | "relative_velocity" | "angular_speed", number>;

export type MotionStart =
  ({ kind: "impact"; angular_speed: number } & ImpactStart) | ({ kind: "flight" } & FlightStart);

/** The module refuses a request with a name that it does not know, or without one that it needs. */
export interface Request {
  readonly call: string;
  readonly [name: string]: unknown;
}

export interface Response<Json> {
  readonly json: Json;
  readonly numbers: Float64Array;
  readonly bytes: Uint8Array;
}

/** The columns of the rows in `numbers`. */
export const MOTION_COLUMNS = [
  "time", "height", "angle", "axial_velocity", "angular_speed",
  "platform_height", "platform_angle", "platform_velocity", "platform_angular_speed",
] as const; // prettier-ignore
export const EVENT_COLUMNS = [
  "time", "phase", "normalised_speed", "tangential_speed", "angular_speed", "height",
] as const; // prettier-ignore
export const DIAGRAM_COLUMNS = ["axial_forcing", "impact_phase", "normalised_speed", "angular_speed"] as const;
export const BRANCH_COLUMNS = [
  "axial_forcing", "impact_phase", "normalised_speed", "branch", "stable", "line",
] as const; // prettier-ignore
export const TRANSIENT_COLUMNS = ["time", "speed", "speed_error"] as const;
/** Modes in the `bytes` of a motion. */
export const MODES = ["flight", "sticking", "sliding forward", "sliding backward"] as const;

export interface Refusal {
  readonly kind: string;
  /** The name of the parameter, where it is one, and its legal range in words, such as "[0, 1)". */
  readonly quantity: string | null;
  readonly range: string | null;
  readonly message: string;
}

/** Contact time over the period and m g/(k A), each with its name in the library. */
export type ContactJson = readonly [[string, string], [string, string]];

type Numbers<Name extends string> = Readonly<Record<Name, number>>;
type Nullable<Name extends string> = Readonly<Record<Name, number | null>>;

/** What follows from a system, whose parameters are those once all is set. */
export type Summary = Numbers<"axial_forcing" | "period" | "contact_periods" | "peak_acceleration"> &
  Numbers<"speed_unit" | "twist_speed" | "friction_acceleration" | "load_torque" | "stroke" | "amplitude_angle"> &
  Nullable<"angular_forcing" | "rise_time"> & {
    readonly bounces: boolean;
    readonly contact: ContactJson | null;
    readonly system: Parameters;
  };

export type MotionJson = Numbers<"samples" | "events"> & {
  readonly energy: Numbers<"platform_work" | "restitution_loss" | "friction_loss" | "load_work" | "stored">;
};

export type DiagramJson = Numbers<"resting" | "unsettled" | "left_out">;

export type VerdictJson = Nullable<"impacts" | "platform_periods" | "exponent" | "exponent_error"> & {
  readonly kind: "periodic" | "chaotic" | "chattering" | "at-rest" | "undecided";
  readonly multipliers: [number, number][] | null;
  readonly rounding_dependent: boolean;
  readonly text: string;
};

export interface BranchesJson {
  readonly branches: number;
  readonly bifurcations: readonly ({ readonly kind: string; readonly axial_forcing: number } & ImpactStart)[];
}

export type AttractorJson = Nullable<"label" | "leads_to"> & {
  readonly text: string;
  readonly share: number;
  readonly interval: Range;
  readonly lasts: boolean;
  readonly impact: ImpactStart | null;
};

export type AttractorsJson = Numbers<"undecided" | "starts" | "fastest_start"> & {
  readonly attractors: readonly AttractorJson[];
  readonly kinds: Readonly<Record<"rest" | "periodic" | "chaotic", IntervalJson>>;
};

/** What a data sheet says of the shared state; its text is that of a file. */
export interface SheetJson {
  readonly sheet: MotorSheet;
  readonly text: string;
  readonly system: SystemParameters;
  readonly mass: number;
}

export type ReportJson = Numbers<"axial_forcing" | "largest_torque"> & {
  readonly angular_forcing: number | null;
  readonly regime: string;
  readonly contact: ContactJson;
  readonly warnings: readonly string[];
  /** Whether the stator yields: regime and forcing are then those of its motion without a rotor. */
  readonly yields: boolean;
  readonly system: SystemParameters;
  readonly trap: TrapJson | null;
};

/** The performance of a single toss; the library's `TossPerformance`. */
export type TossJson = Numbers<"airborne_speed" | "efficiency"> & Nullable<"speed_ratio">;

/** The library's `NearestTrap`; its distance is 0 for a motor that is caught. */
export type TrapJson = Numbers<"preload_acceleration" | "relative_distance"> & { readonly forcing_from_to: Range };

/** The library's `Operation`: a motor under a load, and what it lacks, by its name. */
export type OperationJson = {
  readonly Steady?: PointJson;
  readonly Unsettled?: readonly [PointJson, Readonly<Record<string, Numbers<string>>>];
  readonly Runaway?: Numbers<"load_torque" | "largest_torque" | "acceleration">;
};

/** The library's `OperatingRow`: a motor under a load. The first branch is where most rotors are that started from rest. */
export interface RowJson {
  readonly branches: readonly OperationJson[];
}

/** How the rotor moves up and down, and how long an irregular motion lasts (s); the library's `AxialMotion`. */
export type AxialMotionJson =
  | "Contact"
  | { readonly Periodic: Numbers<"periods" | "impacts"> }
  | { readonly Irregular: { readonly life: { readonly Mean: number } | { readonly NoneEndedIn: number } } };

type PointJson = Numbers<"load_torque"> & { readonly motion: AxialMotionJson } &
  Readonly<Record<"speed" | "mechanical_power" | "input_power", EstimateJson>> & {
    readonly efficiency: EstimateJson | null;
    readonly stator?: { readonly amplitude: EstimateJson };
  };

type EstimateJson = Numbers<"value" | "standard_error">;
export type IntervalJson = Numbers<"value" | "low" | "high">;

export interface TransientJson {
  readonly points: number;
  readonly rise: { form: "exponential" | "ramp"; constant: IntervalJson; residual: number } | null;
  /** The name of the library's `FitRefusal`, most with its numbers. */
  readonly refusal: string | Readonly<Record<string, unknown>> | null;
}

export type StallJson = Nullable<"torque" | "torque_error" | "no_load_speed_error"> & Numbers<"no_load_speed">;
