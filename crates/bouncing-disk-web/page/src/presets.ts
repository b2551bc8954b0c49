/** The states of every figure and table of the paper; `words.json` says what to see in each. */

import type { Change, Quantity, State } from "./contract";
import type { Range, SystemParameters } from "./protocol";
import { amplitudeOf, changed, DEFAULT_STATE, DEFAULT_SYSTEM, systemOf } from "./state";
import tables from "./tables.json";
import { WORDS } from "./words";

export type Panel = Readonly<{ label: string; change: Change }>;

export type Preset = Readonly<Record<"id" | "place" | "title" | "text", string> & { panels: readonly Panel[] }>;

const { PI } = Math;

const { table_one: HAND, table_three: SHEET } = tables;

/** The hand of Table I with other numbers (m, rad); A and a_e Phi are the sides of the stroke, Eq. (13). */
export function tossOf({
  stroke = HAND.stroke,
  angle = HAND.amplitude_angle,
  contact_radius = HAND.contact_radius,
  lag: phase_lag = 0,
}): Partial<SystemParameters> {
  const twist_amplitude = (stroke * Math.sin(angle)) / contact_radius;
  return { amplitude: stroke * Math.cos(angle), twist_amplitude, phase_lag, contact_radius };
}

/** Table I, with the restitution of Sec. IV, which a single toss does not depend on. */
const TABLE_ONE: Readonly<SystemParameters> = { ...DEFAULT_SYSTEM, ...tossOf({}) };

/** Multiple tosses with the semielliptical motion of Fig. 6(d): theta = -0.26 pi, Gamma_T = 1. */
export const multipleToss = withTwist({ ...DEFAULT_SYSTEM, phase_lag: -0.26 * PI }, 1);

/** The same system with the amplitude of this axial forcing, Gamma = A omega²/(pi g). */
export const withForcing = (system: SystemParameters, forcing: number): SystemParameters => ({
  ...system,
  amplitude: amplitudeOf(forcing, system),
});

/** The same system with the twist of this angular forcing, Gamma_T = a_g² Phi omega²/(a_e pi g mu). */
export function withTwist(system: SystemParameters, forcing: number): SystemParameters {
  const { contact_radius, gyration_radius, friction, preload_acceleration, angular_frequency } = system;
  const unit = (contact_radius * PI * preload_acceleration * friction) / (gyration_radius * angular_frequency) ** 2;
  return { ...system, twist_amplitude: forcing * unit };
}

/** At rest on the platform at its lowest point, where a single toss begins: an impact without speed. */
export const REST: State["start"] = { impact_phase: 1.5 * PI, normalised_speed: 0, angular_speed: 0 };

/** A drive frequency (Hz), the largest angular speed of the stator (rad/s) and a preload acceleration (m/s²). */
function motorOf({
  frequency = SHEET.drive_frequency,
  speed = SHEET.peak_angular_speed,
  preload: preload_acceleration = SHEET.preload_acceleration,
}): Partial<SystemParameters> {
  const angular_frequency = 2 * PI * frequency;
  return { angular_frequency, twist_amplitude: speed / angular_frequency, preload_acceleration };
}

/** Its rotor's mass (kg), as the paper prints such numbers: to three digits. */
const MASS = Number(SHEET.mass.toPrecision(3));

/** The motor of Table III, its "70" read as the drive frequency in kHz. */
const MOTOR: Readonly<SystemParameters> = { ...systemOf(SHEET), ...motorOf({}) };

/** A single toss: the dough lies on the hand at its lowest point. */
export const toss = (change: Change["system"]): Change => {
  return { view: "toss", system: { ...TABLE_ONE, ...change }, start: REST };
};

/** The orbit diagram of Fig. 6, whose columns begin with this impact. */
export const diagram = (quantity: Quantity, system: SystemParameters, axial_forcing: Range = [0.3, 0.65]): Change => ({
  view: "diagram",
  system,
  diagram: { ...DEFAULT_STATE.diagram, axial_forcing, quantity },
});

/** A panel of Fig. 7; the paper does not print its window, and speeds up to 5 give its two shares. */
export const basins = (forcing: number): Change => ({ view: "basins", system: withForcing(multipleToss, forcing) });

export const motor = (change: Change["system"]): Change => ({
  view: "motor",
  system: { ...MOTOR, ...change },
  mass: MASS,
  start: { angular_speed: 0 },
});

/** Fig. 9 in slow motion: a platform that all but stands still. */
const braking = (preload_acceleration: number): Change => ({
  ...motor({ amplitude: 1e-6, twist_amplitude: 0, angular_frequency: 20 * PI, preload_acceleration }),
  view: "toss",
  start: { impact_phase: 0, normalised_speed: 0.02, angular_speed: 30 },
});

/** A disk that is tossed again and again, at this forcing. */
export const bouncing = (forcing: number, start: Change["start"] = DEFAULT_STATE.start): Change => ({
  view: "toss",
  system: withForcing(multipleToss, forcing),
  start,
});

/** At the first doubling. */
const DOUBLING = withForcing(multipleToss, 0.486);

type Id = keyof typeof WORDS.presets;

/** Of every panel, from the defaults; in the order of the paper. */
const PANELS: Readonly<Record<Id, readonly [Change, ...Change[]]>> = {
  fig01: [toss({})],
  fig02: [
    toss(tossOf({ angle: 0.25 * PI, lag: -PI / 2 })),
    toss(tossOf({ angle: 0.25 * PI, lag: -PI / 4 })),
    toss(tossOf({ angle: 0.25 * PI, lag: 0 })),
    toss(tossOf({ angle: 0.05 * PI, lag: -PI / 4 })),
    toss(tossOf({ angle: 0.45 * PI, lag: -PI / 4 })),
  ],
  fig03: [bouncing(0.4, REST)],
  fig04: [
    toss(tossOf({ angle: 0.301 * PI })),
    toss(tossOf({ angle: 0.323 * PI })),
    toss({}),
    toss(tossOf({ angle: 0.323 * PI, lag: PI / 4 })),
    toss(tossOf({ angle: 0.323 * PI, lag: PI / 2 })),
    toss({ ...tossOf({ angle: 0.323 * PI }), friction: 0.5 }),
    toss({ ...tossOf({ angle: 0.323 * PI }), friction: 0.7 }),
  ],
  fig05: [
    toss(tossOf({ angle: 0.132 * PI })),
    toss(tossOf({ angle: 0.132 * PI, lag: PI / 2 })),
    toss(tossOf({ angle: 0.323 * PI })),
    toss(tossOf({ angle: 0.323 * PI, lag: PI / 2 })),
    toss(tossOf({ angle: 0.426 * PI })),
    toss(tossOf({ angle: 0.426 * PI, lag: PI / 2 })),
  ],
  fig06: [
    diagram("impact_phase", DOUBLING),
    diagram("normalised_speed", DOUBLING),
    diagram("angular_speed", { ...withTwist({ ...DOUBLING, friction: 0.006 }, 100), phase_lag: 0 }),
    diagram("angular_speed", withTwist(DOUBLING, 1)),
  ],
  fig07: [basins(0.34), basins(0.486), basins(0.5), basins(0.55), basins(0.6)],
  fig08: [motor({})],
  fig09: [braking(9.8), braking(5), braking(2.4)],
  fig10: [motor({ amplitude: 1e-9 }), motor({ amplitude: 1e-8 }), motor({ amplitude: 1e-7 })],
  fig11: [
    motor({ preload_acceleration: 8.51 }),
    motor({ preload_acceleration: 2.43 }),
    motor(motorOf({ frequency: 184e3, preload: 8.51 })),
    motor(motorOf({ frequency: 184e3, preload: 2.43 })),
  ],
  fig12: [motor({ amplitude: 1e-7, preload_acceleration: 0.5 }), motor({ amplitude: 1e-8, preload_acceleration: 1 })],
  fig13: [
    motor({}),
    motor({ friction: 0.2 }),
    motor({ restitution: 0.3 }),
    motor({ restitution: 0.7 }),
    motor({ phase_lag: PI / 4 }),
    motor({ amplitude: 1e-7 }),
    motor(motorOf({ speed: 15 })),
  ],
  fig14: [bouncing(0.48, { impact_phase: 0.7, normalised_speed: 1.35 })],
  table1: [toss({})],
  table2: [
    toss(tossOf({ stroke: 0.3 })),
    toss({ angular_frequency: 20 }),
    toss(tossOf({ contact_radius: 0.15 })),
    toss({ gyration_radius: 0.12 }),
    toss({ friction: 0.7 }),
    toss(tossOf({ angle: 0.69 })),
  ],
  table3: [motor({}), motor({ preload_acceleration: 70 })],
};

export const PRESETS: readonly Preset[] = (Object.keys(PANELS) as Id[]).map((id) => {
  const { panels: labels, ...words } = WORDS.presets[id];
  return { id, ...words, panels: PANELS[id].map((change, index) => ({ label: labels[index] ?? "", change })) };
});

/** Fig. 10(a) is the exception of its figure. */
export const openingPanel = ({ id, panels }: Preset): Panel => panels[id === "fig10" ? 1 : 0] as Panel;

/** The state that a panel opens. What it does not name has its default. */
export const stateOf = ({ change }: Pick<Panel, "change">): State => changed(DEFAULT_STATE, change);
