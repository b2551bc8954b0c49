/** The figures and tables of the disk that a hand tosses and that goes on bouncing: all but those of the motor. */

import type { Change, State } from "../contract";
import { multipleToss, REST, TABLE_ONE, tossOf, withForcing, withTwist } from "../systems";
import type { Panel, Preset } from "./preset";

const { PI } = Math;

/** A single toss: the dough lies on the hand at its lowest point. */
const toss = (label: string, change: Change["system"]): Panel => ({
  label,
  change: { view: "toss", system: { ...TABLE_ONE, ...change }, start: REST },
});

/** The orbit diagram of Fig. 6, whose columns begin with this impact. */
const diagram = (label: string, quantity: State["diagram"]["quantity"], change: Change["system"]): Panel => ({
  label,
  change: {
    view: "diagram",
    system: change,
    start: { impact_phase: 0.4, normalised_speed: 1.4, angular_speed: 0 },
    diagram: { axial_forcing: [0.3, 0.65], quantity, range: null, branches: true },
  },
});

/** A panel of Fig. 7; the paper does not print its window, and speeds up to 5 give its two shares. */
const basins = (label: string, forcing: number): Panel => ({
  label: `${label} Γ = ${forcing}`,
  change: {
    view: "basins",
    system: withForcing(multipleToss, forcing),
    basins: { phase_periods: [0, 1], normalised_speed: [0, 5] },
  },
});

export const DISK_FIGURES: readonly Preset[] = [
  {
    id: "fig01",
    place: "Fig. 1",
    title: "Disk, platform and the toss",
    text:
      "Height and angle of the disk follow those of the platform as long as friction holds it, and part from " +
      "them where it is thrown. Every point of the platform runs along a closed curve on a cylinder.",
    panels: [toss("Table I", {})],
  },
  {
    id: "fig02",
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
    id: "fig03",
    place: "Fig. 3",
    title: "Modes and events",
    text:
      "The flow chart is the engine behind every picture here, and its inset is this motion: a flight, impacts " +
      "that come ever faster, attachment, a ride on the platform, and separation. Watch the mode change " +
      "between flight, sticking and sliding.",
    panels: [
      {
        label: "chattering",
        change: { view: "toss", system: withForcing(multipleToss, 0.4), start: REST },
      },
    ],
  },
  {
    id: "fig04",
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
    id: "fig05",
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
    id: "fig06",
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
    id: "fig07",
    place: "Fig. 7",
    title: "Basins of attraction",
    text:
      "The basin of the period-1 orbit grows from Γ = 0.34 to its doubling at 0.486, where it is easiest to " +
      "keep, but never reaches the axis of speed zero: a disk at rest cannot be tossed into it. At 0.55 the " +
      "boundary is fractal, and at 0.60, beyond the crisis, every start chatters in the end.",
    panels: [basins("(a)", 0.34), basins("(b)", 0.486), basins("(c)", 0.5), basins("(d)", 0.55), basins("(e)", 0.6)],
  },
];

export const DOUGH: Preset = {
  id: "fig14",
  place: "Fig. 14",
  title: "Growth of the dough",
  text:
    "The figure measures the diameter of a dough in a video; it grows by 3 % with each toss, which is why " +
    "the model leaves deformation out. Nothing of it can be computed, so this shows what the video shows: " +
    "multiple tosses, with the semielliptical motion of the hand that makes them easy.",
  panels: [
    {
      label: "multiple tosses",
      change: {
        view: "toss",
        system: withForcing(multipleToss, 0.48),
        start: { impact_phase: 0.7, normalised_speed: 1.35, angular_speed: 0 },
      },
    },
  ],
};

export const TOSS_TABLES: readonly Preset[] = [
  {
    id: "table1",
    place: "Table I",
    title: "Specification of a single toss",
    text:
      "The dough begins at rest on the hand at its lowest point and leaves it with 14 rad/s, as measured in " +
      "the video. Table I has no restitution, on which a single toss does not depend; 0.5 is that of Sec. IV.",
    panels: [toss("Table I", {})],
  },
  {
    id: "table2",
    place: "Table II",
    title: "Effects of the uncertainties",
    text:
      "Each panel is Table I with one input at the upper end of its uncertainty: read the speed of the dough " +
      "after it has left the hand. Stroke, frequency and angle matter, the contact radius a little, friction " +
      "and the radius of gyration hardly at all.",
    panels: [
      toss("c + 0.05 m", tossOf({ stroke: 0.3 })),
      toss("ω + 5 rad/s", { angular_frequency: 20 }),
      toss("a_e + 15 mm", tossOf({ contact: 0.15 })),
      toss("a_g + 10 mm", { gyration_radius: 0.12 }),
      toss("μ + 0.1", { friction: 0.7 }),
      toss("φ_L + 0.14", tossOf({ angle: 0.69 })),
    ],
  },
];
