/**
 * What the page asks the module for, and what it gets: the same names, units and order as in `src/request.rs`.
 *
 * A request is JSON, so that it can be kept in a link, printed and given to the native library, which answers it with
 * the same bits. A response has JSON for what is short and flat arrays for what is long. Numbers are SI and angles are
 * radians, unless a name says otherwise: phases of pictures are in periods of the platform, and the speeds of impacts
 * are normalised by the amplitude of the platform's velocity, as in Fig. 7 of the paper.
 */

/** Platform and disk, as `System` of the library. */
export interface SystemParameters {
  /** Amplitude A of the platform's height (m). */
  amplitude: number;
  /** Amplitude Phi of the platform's angle (rad). */
  twist_amplitude: number;
  /** Angular frequency omega (rad/s). */
  angular_frequency: number;
  /** Phase lag theta of the twist (rad). */
  phase_lag: number;
  /** Effective contact radius a_e (m). */
  contact_radius: number;
  /** Radius of gyration a_g (m). */
  gyration_radius: number;
  /** Coefficient of friction mu. */
  friction: number;
  /** Coefficient of restitution, in [0, 1). */
  restitution: number;
  /** Preload acceleration g (m/s^2). */
  preload_acceleration: number;
  /** Angular deceleration by the load (rad/s^2). */
  load_acceleration: number;
}

/** A motor's data sheet, with one of each pair of alternatives; the library's `MotorParameters`. */
export interface MotorSheet {
  drive_frequency: number; // Hz
  amplitude: number; // m
  peak_angular_speed: number | null; // rad/s
  twist_amplitude: number | null; // rad
  phase_lag: number; // rad
  mass: number | null; // kg
  density: number | null; // kg/m^3
  rotor_radius: number | null; // m
  rotor_thickness: number | null; // m
  contact_radius: number; // m
  gyration_radius: number | null; // m
  preload_force: number | null; // N
  preload_acceleration: number | null; // m/s^2
  spring_constant: number | null; // N/m
  friction: number;
  restitution: number;
  load_torque: number; // N m
}

/** An impact that an orbit begins with: its phase (rad), and its normalised speed |w_A| Gamma/(A omega), positive. */
export interface ImpactStart {
  impact_phase: number;
  normalised_speed: number;
}

/** How a motion begins. Angular speeds are in rad/s, gaps in m, velocities in m/s; phases in rad. */
export type MotionStart =
  | ({ kind: "impact"; angular_speed: number } & ImpactStart)
  | { kind: "contact"; phase: number; angular_speed: number }
  | { kind: "flight"; phase: number; angular_speed: number; gap: number; relative_velocity: number };

/** From a low to a high number. */
export type Range = [number, number];

export type Request =
  /** Are these parameters legal, and what follows from them? `Summary`. */
  | { call: "check"; system: SystemParameters }
  /** The motion of the engine: `MotionJson`; numbers: `samples` rows of `MOTION_COLUMNS`, then `events` rows of
   * `EVENT_COLUMNS`; bytes: the modes of the samples, then the kinds of the events. */
  | { call: "motion"; system: SystemParameters; start: MotionStart; periods: number; samples_per_period: number }
  /** The columns `[from, to)` of an orbit diagram of `count` forcings from `axial_forcing[0]` to `axial_forcing[1]`.
   * `DiagramJson`; numbers: rows of `DIAGRAM_COLUMNS`. Angular speeds follow from the angular forcing, the phase lag
   * and the load of `system`, of which the amplitude alone is that of the column. */
  | {
      call: "diagram";
      system: SystemParameters;
      axial_forcing: Range;
      count: number;
      columns: [number, number];
      start: ImpactStart;
      transient: number;
      recorded: number;
      /** Most impacts that are left out of an orbit that has not settled after `transient` ones. */
      patience?: number;
      /** Whether angular speeds are computed, which takes longer; without it they are NaN. */
      rotation?: boolean;
    }
  /** What the orbit from a start does for good: `VerdictJson`. */
  | { call: "orbit"; axial_forcing: number; restitution: number; start: ImpactStart }
  /** The branches of period 1 with its doublings, stable and unstable, as far as they lie in a range: `BranchesJson`;
   * numbers: rows of `BRANCH_COLUMNS`. */
  | { call: "branches"; restitution: number; axial_forcing: Range }
  /** All attractors of a map with the shares of the starts that end on them: `AttractorsJson`. */
  | { call: "attractors"; axial_forcing: number; restitution: number }
  /** The rows `[from, to)` of a grid of starts (phase along a row, from the lowest speed up): bytes: labels of
   * `attractors`, row by row. */
  | {
      call: "basins";
      axial_forcing: number;
      restitution: number;
      phase_periods: Range;
      phases: number;
      normalised_speed: Range;
      speeds: number;
      rows: [number, number];
    }
  /** What a data sheet says before anything turns: `ReportJson`. */
  | { call: "motor_report"; sheet: MotorSheet }
  /** Run-ups of `members` motors: `TransientJson`; numbers: `points` rows of `TRANSIENT_COLUMNS`. */
  | { call: "motor_transient"; sheet: MotorSheet; members: number; rise_times: number; points: number; seed: number }
  /** Steady operation under loads (N m): `OperationsJson`; numbers: a row of `OPERATION_COLUMNS` for each. */
  | {
      call: "motor_loads";
      sheet: MotorSheet;
      load_torques: number[];
      relative_error: number;
      /** Most impacts that the answer may take, up to 20 million; 5 million where nothing is said. */
      most_impacts?: number;
      seed: number;
    }
  /** The load that stops the motor: `StallJson`. */
  | { call: "motor_stall"; sheet: MotorSheet; relative_error: number; seed: number }
  /** A data sheet as the command line and Python read it: `{ text }`. */
  | { call: "sheet_write"; sheet: MotorSheet }
  /** The data sheet of such a text: `{ sheet, system, mass }`. */
  | { call: "sheet_read"; text: string }
  /** The sheet of a system and a mass (kg), with the load as a torque: `{ sheet }`. */
  | { call: "sheet_of_system"; system: SystemParameters; mass: number };

/** Time (s), height and angle of the disk (m, rad), its velocity and angular speed (m/s, rad/s), height, angle,
 * velocity and angular speed of the platform. */
export const MOTION_COLUMNS = [
  "time", "height", "angle", "axial_velocity", "angular_speed",
  "platform_height", "platform_angle", "platform_velocity", "platform_angular_speed",
] as const; // prettier-ignore
/** Modes in `bytes`. */
export const MODES = ["flight", "sticking", "sliding forward", "sliding backward"] as const;

/** Time (s), phase (rad), normalised impact speed |w_A| Gamma/(A omega) of an impact (else NaN), tangential impact
 * velocity as an angular speed relative to the platform (rad/s; else NaN), angular speed after the event (rad/s),
 * height (m). */
export const EVENT_COLUMNS = [
  "time", "phase", "normalised_speed", "tangential_speed", "angular_speed", "height",
] as const; // prettier-ignore

/** The forcing, the phase of impact (rad), the normalised speed, and the angular speed of the disk after the impact in
 * units of omega Phi (NaN where the platform does not twist or there is no friction). */
export const DIAGRAM_COLUMNS = ["axial_forcing", "impact_phase", "normalised_speed", "angular_speed"] as const;

/** The forcing, phase (rad) and normalised speed of one impact of an orbit on a branch, the number of the branch, 1
 * where the orbit is stable, and the number of the line: one impact along one part of the branch. The rows of a line
 * follow each other. */
export const BRANCH_COLUMNS = [
  "axial_forcing", "impact_phase", "normalised_speed", "branch", "stable", "line",
] as const; // prettier-ignore

/** Time (s), mean angular speed over the members and its standard error (rad/s). */
export const TRANSIENT_COLUMNS = ["time", "speed", "speed_error"] as const;

/** Load (N m); speed (rad/s), mechanical and input power (W), efficiency, each with its standard error; 0 steady, 1
 * unsettled (the numbers are the best so far), 2 runaway (the load drives the rotor; the numbers are NaN). */
export const OPERATION_COLUMNS = [
  "load_torque", "speed", "speed_error", "mechanical_power", "mechanical_power_error", "input_power",
  "input_power_error", "efficiency", "efficiency_error", "status",
] as const; // prettier-ignore

/** What is wrong with a request. */
export interface Refusal {
  /** "out-of-range", "invalid", "computation" or "request". */
  kind: string;
  /** The name of the parameter, where it is one. */
  quantity: string | null;
  value: number | null;
  /** The legal range in words, such as "[0, 1)". */
  range: string | null;
  message: string;
}

export interface Summary {
  axial_forcing: number;
  /** null without friction. */
  angular_forcing: number | null;
  /** s */
  period: number;
  /** The platform's largest acceleration in units of the preload. */
  peak_acceleration: number;
  /** m */
  stroke: number;
  /** Rise time of a motor without load (s); null where nothing turns. */
  rise_time: number | null;
  /** True if the platform ever falls away from a disk at rest on it. */
  bounces: boolean;
}

export interface MotionJson {
  samples: number;
  events: number;
  event_kinds: string[];
  /** Energy per mass from the start to the end (J/kg): what came in by the platform, what impacts, friction and the load
   * took, and what the disk has more than at the start. */
  energy: {
    platform_work: number;
    restitution_loss: number;
    friction_loss: number;
    load_work: number;
    stored: number;
  };
}

export interface DiagramJson {
  /** Orbits that came to rest for ever in these columns, and have no impacts left. */
  resting: number;
  /** Orbits that are still on their way to what they repeat, and the most impacts that were left out of one. */
  unsettled: number;
  left_out: number;
}

export interface VerdictJson {
  kind: "periodic" | "chaotic" | "chattering" | "at-rest" | "undecided";
  /** Impacts and platform periods of a round; null where nothing repeats. */
  impacts: number | null;
  platform_periods: number | null;
  /** Real and imaginary parts of the two Floquet multipliers. */
  multipliers: [number, number][] | null;
  /** Growth per impact and its standard error; that of a periodic orbit follows from its multipliers and has none. */
  exponent: number | null;
  exponent_error: number | null;
  /** True where the cycle after a rest was chosen by rounding. */
  rounding_dependent: boolean;
  /** A sentence. */
  text: string;
}

export interface BranchesJson {
  branches: { impacts: number; platform_periods: number; end: string }[];
  /** Phase (rad) and normalised speed are those of the first impact. */
  bifurcations: {
    kind: string;
    axial_forcing: number;
    impact_phase: number;
    normalised_speed: number;
    branch: number;
  }[];
}

export interface AttractorsJson {
  attractors: {
    /** What `basins` has in its cells; null beyond the 251 that a byte holds. */
    label: number | null;
    kind: "rest" | "periodic" | "marginal" | "chaotic" | "unclassified";
    /** A sentence. */
    text: string;
    /** Share of the starts, and its 95 % interval. */
    share: number;
    interval: [number, number];
    /** False for what leads to another attractor. */
    lasts: boolean;
    leads_to: number | null;
    /** One impact on it, where it is periodic. */
    impact: ImpactStart | null;
  }[];
  /** Share of the starts that are undecided. */
  undecided: number;
  /** The sample that these shares are of: so many starts, evenly over all phases and the speeds up to the bound that no
   * attractor exceeds at that phase; the largest normalised speed of that bound. */
  starts: number;
  fastest_start: number;
}

export interface ReportJson {
  axial_forcing: number;
  angular_forcing: number | null;
  regime: string;
  /** N m */
  largest_torque: number;
  warnings: string[];
  /** All of it, to be read. */
  text: string;
  /** The system of the sheet, and the mass of its rotor (kg). */
  system: SystemParameters;
  mass: number;
  /** The nearest preload acceleration (m/s^2) at which the motor may be caught in a motion of few impacts; null if
   * there is none. `caught` says whether the sheet's own motion is one. */
  trap: TrapJson | null;
}

export interface TrapJson {
  preload_acceleration: number;
  caught: boolean;
  /** The relative change of the preload or the amplitude that reaches it; zero where the motor is caught. */
  relative_distance: number;
  /** From where to where in the forcing it reaches. */
  forcing_from_to: Range;
}

/** A number with its 95 % interval. */
export interface IntervalJson {
  value: number;
  low: number;
  high: number;
}

export interface TransientJson {
  points: number;
  /** The form that fits the run-up best, an exponential or a straight rise to a constant: its time constant, or the
   * time at which the straight rise ends (s), and the root mean square of what it misses (rad/s). */
  rise: { form: "exponential" | "ramp"; constant: IntervalJson; residual: number } | null;
  /** Why there is none, where there is none. */
  refusal: string | null;
}

export interface OperationsJson {
  shortfalls: (string | null)[];
}

export interface StallJson {
  /** Null, as its error and its bracket are, for a motor that does not turn without a load. */
  torque: number | null;
  torque_error: number | null;
  bracket: Range | null;
  no_load_speed: number;
  no_load_speed_error: number | null;
}

export interface Response {
  json: unknown;
  numbers: Float64Array;
  bytes: Uint8Array;
  /** Sixteen hexadecimal digits of all of it; the native library gets the same ones. */
  digest: string;
}
