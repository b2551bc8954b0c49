/** A preset for every figure and table of the paper, and the guided tour: states, and what to see in each. */

import type { Change, Quantity, State } from "./contract";
import type { Range, SystemParameters } from "./protocol";
import { amplitudeOf, changed, DEFAULT_STATE, DEFAULT_SYSTEM, systemOf } from "./state";
import tables from "./tables.json";

export interface Panel {
  /** "(a)", or what the panel varies. */
  readonly label: string;
  readonly change: Change;
}

export interface Preset {
  readonly id: string;
  /** "Fig. 6" */
  readonly place: string;
  readonly title: string;
  /** Two sentences on what to see. */
  readonly text: string;
  readonly panels: readonly [Panel, ...Panel[]];
  /** The panel that the preset opens; without it the first one. */
  readonly opens?: number;
}

const { PI } = Math;

const { table_one: HAND, table_three: SHEET } = tables;

/** The hand of Table I with other numbers (m, rad); A and a_e Phi are the sides of the stroke, Eq. (13). */
function tossOf({
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
const multipleToss: Readonly<SystemParameters> = {
  ...DEFAULT_SYSTEM,
  ...withTwist({ ...DEFAULT_SYSTEM, phase_lag: -0.26 * PI }, 1),
};

/** The same system with the amplitude of this axial forcing, Gamma = A omega²/(pi g). */
const withForcing = (system: SystemParameters, forcing: number): SystemParameters => ({
  ...system,
  amplitude: amplitudeOf(forcing, system),
});

/** The same system with the twist of this angular forcing, Gamma_T = a_g² Phi omega²/(a_e pi g mu). */
function withTwist(system: SystemParameters, forcing: number): SystemParameters {
  const { contact_radius, gyration_radius, friction, preload_acceleration, angular_frequency } = system;
  const unit = (contact_radius * PI * preload_acceleration * friction) / (gyration_radius * angular_frequency) ** 2;
  return { ...system, twist_amplitude: forcing * unit };
}

/** At rest on the platform at its lowest point, where a single toss begins: an impact without speed. */
const REST: State["start"] = { impact_phase: 1.5 * PI, normalised_speed: 0, angular_speed: 0 };

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
const toss = (label: string, change: Change["system"]): Panel => ({
  label,
  change: { view: "toss", system: { ...TABLE_ONE, ...change }, start: REST },
});

/** The orbit diagram of Fig. 6, whose columns begin with this impact. */
const diagram = (
  label: string,
  quantity: Quantity,
  system: SystemParameters,
  axial_forcing: Range = [0.3, 0.65],
): Panel => ({
  label,
  change: { view: "diagram", system, diagram: { ...DEFAULT_STATE.diagram, axial_forcing, quantity } },
});

/** A panel of Fig. 7; the paper does not print its window, and speeds up to 5 give its two shares. */
const basins = (label: string, forcing: number): Panel => ({
  label: `${label} Γ = ${forcing}`,
  change: { view: "basins", system: withForcing(multipleToss, forcing) },
});

const motor = (label: string, change: Change["system"]): Panel => ({
  label,
  change: { view: "motor", system: { ...MOTOR, ...change }, mass: MASS, start: { angular_speed: 0 } },
});

/** Fig. 9 in slow motion: a platform that all but stands still. */
const braking = (label: string, preload: number): Panel => ({
  label,
  change: {
    ...motor("", { amplitude: 1e-6, twist_amplitude: 0, angular_frequency: 20 * PI, preload_acceleration: preload })
      .change,
    view: "toss",
    start: { impact_phase: 0, normalised_speed: 0.02, angular_speed: 30 },
  },
});

/** A disk that is tossed again and again, at this forcing. */
const bouncing = (label: string, forcing: number, start: Change["start"] = DEFAULT_STATE.start): Panel => ({
  label,
  change: { view: "toss", system: withForcing(multipleToss, forcing), start },
});

/** "fig06" of "Fig. 6", and "table3" of "Table III", whose numerals are as long as they are large. */
function idOf(place: string): string {
  const [kind, number = ""] = place.split(" ");
  return kind === "Fig." ? `fig${number.padStart(2, "0")}` : `table${number.length}`;
}

/** In the order of the paper. */
export const PRESETS: readonly Preset[] = (
  [
    {
      place: "Fig. 1",
      title: "Disk, platform and the toss",
      text:
        "Height and angle of the disk follow those of the platform as long as friction holds it, and part from " +
        "them where it is thrown. Every point of the platform runs along a closed curve on a cylinder.",
      panels: [toss("Table I", {})],
    },
    {
      place: "Fig. 2",
      title: "Paths of the hand, or of a stator",
      text:
        "The phase lag θ opens the path of a point of the hand from a line to an ellipse: in (c) the hand " +
        "turns fastest where it rises fastest, in (a) a quarter of a period apart. The larger φ_L, the more " +
        "it turns and the less it lifts, and at (f) it moves too gently to throw; the lag of (b) and the " +
        "angles of (d) and (f) are not in the text and chosen here.",
      panels: [
        toss("(a) θ = −π/2", tossOf({ angle: 0.25 * PI, lag: -PI / 2 })),
        toss("(b), (e) θ = −π/4", tossOf({ angle: 0.25 * PI, lag: -PI / 4 })),
        toss("(c) θ = 0", tossOf({ angle: 0.25 * PI, lag: 0 })),
        toss("(d) φ_L = 0.05π", tossOf({ angle: 0.05 * PI, lag: -PI / 4 })),
        toss("(f) φ_L = 0.45π", tossOf({ angle: 0.45 * PI, lag: -PI / 4 })),
      ],
    },
    {
      place: "Fig. 3",
      title: "Modes and events",
      text:
        "The flow chart is the engine behind every picture here, and its inset is this motion: a flight, impacts " +
        "that come ever faster, attachment, a ride on the platform, and separation. Watch the mode change " +
        "between flight, sticking and sliding.",
      panels: [bouncing("chattering", 0.4, REST)],
    },
    {
      place: "Fig. 4",
      title: "Best hand motion of a single toss",
      text:
        "The figure plots the airborne speed against φ_L and θ; each panel here is one point of it, and the " +
        "speed after the first separation is the one to read. A linear motion (θ = 0) is best; the fastest " +
        "toss has the printed 22 rad/s, but at φ_L = 0.301π: at the printed 0.323π it is 20.8 rad/s.",
      panels: [
        toss("φ_L = 0.301π", tossOf({ angle: 0.301 * PI })),
        toss("φ_L = 0.323π", tossOf({ angle: 0.323 * PI })),
        toss("φ_L = 0.55", {}),
        toss("θ = π/4", tossOf({ angle: 0.323 * PI, lag: PI / 4 })),
        toss("θ = π/2", tossOf({ angle: 0.323 * PI, lag: PI / 2 })),
        toss("μ = 0.5", { ...tossOf({ angle: 0.323 * PI }), friction: 0.5 }),
        toss("μ = 0.7", { ...tossOf({ angle: 0.323 * PI }), friction: 0.7 }),
      ],
    },
    {
      place: "Fig. 5",
      title: "Hand and dough, six tosses",
      text:
        "At a small φ_L the toss is high and the dough follows a hand that hardly turns; at a large one the hand " +
        "turns fast, the toss is low and the hand slips away. With θ = π/2 the hand has turned back before the " +
        "dough leaves it.",
      panels: [
        toss("(a) θ = 0", tossOf({ angle: 0.132 * PI })),
        toss("(a) θ = π/2", tossOf({ angle: 0.132 * PI, lag: PI / 2 })),
        toss("(b) θ = 0", tossOf({ angle: 0.323 * PI })),
        toss("(b) θ = π/2", tossOf({ angle: 0.323 * PI, lag: PI / 2 })),
        toss("(c) θ = 0", tossOf({ angle: 0.426 * PI })),
        toss("(c) θ = π/2", tossOf({ angle: 0.426 * PI, lag: PI / 2 })),
      ],
    },
    {
      place: "Fig. 6",
      title: "Orbit diagram",
      text:
        "From Γ = 1/3 on the disk can bounce once in every period; that orbit doubles its period at Γ = " +
        "0.486, 0.531, 0.540 and so on to chaos, which ends in a crisis near 0.561. Every column starts with " +
        "the same impact, inside the basin of that orbit; the chattering orbits of Fig. 6 show where a start " +
        "with a small speed is chosen instead.",
      panels: [
        diagram("(a) phase", "impact_phase", withForcing(multipleToss, 0.486)),
        diagram("(b) speed", "normalised_speed", withForcing(multipleToss, 0.486)),
        diagram("(c) Γ_T = 100, θ = 0", "angular_speed", {
          ...withTwist({ ...withForcing(multipleToss, 0.486), friction: 0.006 }, 100),
          phase_lag: 0,
        }),
        diagram("(d) Γ_T = 1, θ = −0.26π", "angular_speed", withTwist(withForcing(multipleToss, 0.486), 1)),
      ],
    },
    {
      place: "Fig. 7",
      title: "Basins of attraction",
      text:
        "The basin of the period-1 orbit grows from Γ = 0.34 to its doubling at 0.486, where it is easiest to " +
        "keep, but never reaches the axis of speed zero: a disk at rest cannot be tossed into it. At 0.55 the " +
        "boundary is fractal, and at 0.60, beyond the crisis, every start chatters in the end.",
      panels: [basins("(a)", 0.34), basins("(b)", 0.486), basins("(c)", 0.5), basins("(d)", 0.55), basins("(e)", 0.6)],
    },
    {
      place: "Fig. 8",
      title: "The ultrasonic motor",
      text:
        "A steel ball of 20 mm on the tip of a twisted beam: stretching untwists the beam, so that its tip moves " +
        "up and down and to and fro at once. There is no drawing of it here; the data sheet has its numbers, and " +
        "the run-up is that of its default parameters.",
      panels: [motor("Table III", {})],
    },
    {
      place: "Fig. 9",
      title: "Braking, the coefficient of friction",
      text:
        "With the power off the rotor slides until it stops, its speed falls on a straight line, and the " +
        "slope gives μ by Eq. (17). No view is made for this: the rotor of Table III turns here at 30 rad/s " +
        "on a platform that all but stands still (at 10 Hz and 1 µm, so that the 1.0, 1.9 and 4.0 s that it " +
        "takes can be watched).",
      panels: [braking("g = 9.8 m/s²", 9.8), braking("g = 5 m/s²", 5), braking("g = 2.4 m/s²", 2.4)],
    },
    {
      place: "Fig. 10",
      title: "Run-up of the motor",
      text:
        "Impacts drag the rotor along to its steady speed, nearly exponentially, and more roughly where a larger " +
        "amplitude makes them fewer and harder; (a), at exactly 1 nm and 9.8 m/s², repeats a short cycle: its rise " +
        "bends from 12 to 5 rad/s² and then breaks off, after which the speed stays at 16.6 rad/s. No motor could be " +
        "set to it: less than 0.05 % of the preload undoes it. The measured " +
        "runs (d) to (f) are not in the paper's text, so they are not here either.",
      opens: 1,
      panels: [
        motor("(a) A = 1 nm", { amplitude: 1e-9 }),
        motor("(b) A = 10 nm", { amplitude: 1e-8 }),
        motor("(c) A = 100 nm", { amplitude: 1e-7 }),
      ],
    },
    {
      place: "Fig. 11",
      title: "Effect of the preload",
      text:
        "The figure plots steady speed and stall torque over the preload; each panel here is one motor of it, at " +
        "the ends of the measured range of 80 to 280 mN. Between these the preload grows 3.5 times, the stall " +
        "torque 3.4 to 3.5 times, and the steady speed stays at some 22 rad/s.",
      panels: [
        motor("280 mN, 70 kHz", { preload_acceleration: 8.51 }),
        motor("80 mN, 70 kHz", { preload_acceleration: 2.43 }),
        motor("280 mN, 184 kHz", motorOf({ frequency: 184e3, preload: 8.51 })),
        motor("80 mN, 184 kHz", motorOf({ frequency: 184e3, preload: 2.43 })),
      ],
    },
    {
      place: "Fig. 12",
      title: "Long and short chattering",
      text:
        "A long chattering cycle averages over many impacts, and the speed approaches its limit exponentially; a " +
        "short one adds the same impulses again and again, and the speed rises on straight lines and stops " +
        "abruptly. The printed amplitude of the second case gives a long cycle; short ones stand next to it, " +
        "each narrower than 0.05 % of the preload.",
      panels: [
        motor("(a) long", { amplitude: 1e-7, preload_acceleration: 0.5 }),
        motor("(d) short, as printed", { amplitude: 1e-8, preload_acceleration: 1 }),
      ],
    },
    {
      place: "Fig. 13",
      title: "What the motor is sensitive to",
      text:
        "Friction sets the stall torque and leaves the steady speed alone; ωΦ sets the speed and leaves the " +
        "torque alone; the lag and the restitution change both. The figure sweeps each of them; a panel here is " +
        "one value, to be compared with the default.",
      panels: [
        motor("default", {}),
        motor("(a) μ = 0.2", { friction: 0.2 }),
        motor("(b) ε = 0.3", { restitution: 0.3 }),
        motor("(b) ε = 0.7", { restitution: 0.7 }),
        motor("(c) θ = π/4", { phase_lag: PI / 4 }),
        motor("(d) A = 100 nm", { amplitude: 1e-7 }),
        motor("(e) ωΦ = 15 rad/s", motorOf({ speed: 15 })),
      ],
    },
    {
      place: "Fig. 14",
      title: "Growth of the dough",
      text:
        "The figure measures the diameter of a dough in a video; it grows by 3 % with each toss, which is why " +
        "the model leaves deformation out. Nothing of it can be computed, so this shows what the video shows: " +
        "multiple tosses, with the semielliptical motion of the hand that makes them easy.",
      panels: [bouncing("multiple tosses", 0.48, { impact_phase: 0.7, normalised_speed: 1.35 })],
    },
    {
      place: "Table I",
      title: "Specification of a single toss",
      text:
        "The dough begins at rest on the hand at its lowest point and leaves it with 14 rad/s, as measured in " +
        "the video. Table I has no restitution, on which a single toss does not depend; 0.5 is that of Sec. IV.",
      panels: [toss("Table I", {})],
    },
    {
      place: "Table II",
      title: "Effects of the uncertainties",
      text:
        "Each panel is Table I with one input at the upper end of its uncertainty: read the speed of the dough " +
        "after it has left the hand. Stroke, frequency and angle matter, the contact radius a little, friction " +
        "and the radius of gyration hardly at all.",
      panels: [
        toss("c + 0.05 m", tossOf({ stroke: 0.3 })),
        toss("ω + 5 rad/s", { angular_frequency: 20 }),
        toss("a_e + 15 mm", tossOf({ contact_radius: 0.15 })),
        toss("a_g + 10 mm", { gyration_radius: 0.12 }),
        toss("μ + 0.1", { friction: 0.7 }),
        toss("φ_L + 0.14", tossOf({ angle: 0.69 })),
      ],
    },
    {
      place: "Table III",
      title: "Default values of the motor",
      text:
        "The table prints g = 70 m/s² and no frequency; read as a drive frequency of 70 kHz under gravity, that " +
        "number fits everything else in the paper. Both readings are here; their steady " +
        "speeds differ by some 6 %.",
      panels: [motor("70 kHz, gravity", {}), motor("g = 70 m/s²", { preload_acceleration: 70 })],
    },
  ] as const
).map((preset) => ({ ...preset, id: idOf(preset.place) }));

export const openingPanel = ({ panels, opens = 0 }: Preset): Panel => panels[opens] ?? panels[0];

/** The state that a panel opens. What it does not name has its default. */
export const stateOf = (panel: Panel): State => changed(DEFAULT_STATE, panel.change);

export interface Step {
  readonly title: string;
  readonly text: string;
  /** From the defaults. */
  readonly change: Change;
}

export const STEPS: readonly Step[] = [
  {
    title: "A toss",
    text:
      "A hand rises and twists; the dough on it is carried along by friction until the hand falls away from " +
      "under it. Both motions together throw it up and spin it: with the numbers of Table I it leaves the hand " +
      "with 14 rad/s.",
    change: toss("", {}).change,
  },
  {
    title: "One bounce in every period",
    text:
      "With Γ = Aω²/(πg) = 0.45 the disk can land once in every period of the platform, always at the same " +
      "phase. Each impact takes it nearer to the speed at which the platform turns at that phase, and then " +
      "nothing slips any more.",
    change: bouncing("", 0.45).change,
  },
  {
    title: "The road to chaos",
    text:
      "Here the forcing runs along the axis, and each column shows at which phases the disk lands in the long " +
      "run. One line becomes two, four, eight: the period doubles at 0.486, 0.531, 0.540, and beyond about " +
      "0.543 bands of chaos follow.",
    change: diagram("", "impact_phase", withForcing(multipleToss, 0.45), [0.32, 0.58]).change,
  },
  {
    title: "Chaos, bounce by bounce",
    text:
      "The same disk at Γ = 0.55: no two bounces are alike, though every one follows from the last. Two starts " +
      "that differ in the last digit of a double part within some hundred impacts, so a program has to fix " +
      "every bit to show the same picture twice.",
    change: bouncing("", 0.55).change,
  },
  {
    title: "Where a start leads",
    text:
      "Every point of this plane is an impact, by its phase and its speed; its colour says where the disk " +
      "ends. At Γ = 0.486 the orbit with one bounce a period has its widest basin, which is why this motion is " +
      "easy to keep up; along the axis of speed zero lies nothing of it.",
    change: basins("", 0.486).change,
  },
  {
    title: "What falls asleep",
    text:
      "Begin at rest and the other attractor shows: impacts come faster and faster, infinitely many in a " +
      "finite time, until the disk lies on the platform, rides it and is thrown again. The sum of that " +
      "sequence is computed, not cut off.",
    change: bouncing("", 0.45, REST).change,
  },
  {
    title: "A motor",
    text:
      "The same equations, 30,000 times faster: the rotor of an ultrasonic motor on a stator that moves by 10 " +
      "nm at 70 kHz. Thousands of impacts drag it to its steady speed; that speed is an average over motors " +
      "that differ by less than anybody can set, and carries an error.",
    change: motor("", {}).change,
  },
  {
    title: "Which lag is best?",
    text:
      "Back to the disk: over the forcing, its angular speed in units of the platform's largest one. With θ = " +
      "−0.26π it is at its fastest where the period doubles; set θ to 0 in the form and the fastest place " +
      "moves to Γ = 1/3, where the orbit is born.",
    change: diagram("", "angular_speed", withTwist(withForcing(multipleToss, 0.486), 1), [0.32, 0.58]).change,
  },
];
