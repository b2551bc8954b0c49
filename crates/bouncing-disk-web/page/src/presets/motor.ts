/** The figures and the table of the ultrasonic motor. */

import type { Change } from "../contract";
import { MOTOR, motorOf } from "../systems";
import type { Panel, Preset } from "./preset";

const { PI } = Math;

const motor = (label: string, change: Change["system"]): Panel => ({
  label,
  change: { view: "motor", system: { ...MOTOR, ...change }, mass: 0.0329, start: { angular_speed: 0 } },
});

/** Fig. 9 in slow motion: a platform that all but stands still. */
const braking = (label: string, preload: number): Panel => ({
  label,
  change: {
    view: "toss",
    system: {
      ...MOTOR,
      amplitude: 1e-6,
      twist_amplitude: 0,
      angular_frequency: 20 * PI,
      preload_acceleration: preload,
    },
    mass: 0.0329,
    start: { impact_phase: 0, normalised_speed: 0.02, angular_speed: 30 },
  },
});

export const MOTOR_FIGURES: readonly Preset[] = [
  {
    id: "fig08",
    place: "Fig. 8",
    title: "The ultrasonic motor",
    text:
      "A steel ball of 20 mm on the tip of a twisted beam: stretching untwists the beam, so that its tip moves " +
      "up and down and to and fro at once. There is no drawing of it here; the data sheet has its numbers, and " +
      "the run-up is that of its default parameters.",
    panels: [motor("Table III", {})],
  },
  {
    id: "fig09",
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
    id: "fig10",
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
    id: "fig11",
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
    id: "fig12",
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
    id: "fig13",
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
];

export const MOTOR_TABLE: Preset = {
  id: "table3",
  place: "Table III",
  title: "Default values of the motor",
  text:
    "The table prints g = 70 m/s² and no frequency; read as a drive frequency of 70 kHz under gravity, that " +
    "number fits everything else in the paper. Both readings are here; their steady " +
    "speeds differ by some 6 %.",
  panels: [motor("70 kHz, gravity", {}), motor("g = 70 m/s²", { preload_acceleration: 70 })],
};
