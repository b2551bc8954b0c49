/** The guided tour: eight states, and what to see in each. */

import type { Change } from "./contract";
import { MOTOR, multipleToss, REST, TABLE_ONE, withForcing, withTwist } from "./systems";

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
    change: { view: "toss", system: TABLE_ONE, start: REST },
  },
  {
    title: "One bounce in every period",
    text:
      "With Γ = Aω²/(πg) = 0.45 the disk can land once in every period of the platform, always at the same " +
      "phase. Each impact takes it nearer to the speed at which the platform turns at that phase, and then " +
      "nothing slips any more.",
    change: {
      view: "toss",
      system: withForcing(multipleToss, 0.45),
      start: { impact_phase: 0.4, normalised_speed: 1.4, angular_speed: 0 },
    },
  },
  {
    title: "The road to chaos",
    text:
      "Here the forcing runs along the axis, and each column shows at which phases the disk lands in the long " +
      "run. One line becomes two, four, eight: the period doubles at 0.486, 0.531, 0.540, and beyond about " +
      "0.543 bands of chaos follow.",
    change: {
      view: "diagram",
      system: withForcing(multipleToss, 0.45),
      diagram: { axial_forcing: [0.32, 0.58], quantity: "impact_phase", range: null, branches: true },
    },
  },
  {
    title: "Chaos, bounce by bounce",
    text:
      "The same disk at Γ = 0.55: no two bounces are alike, though every one follows from the last. Two starts " +
      "that differ in the last digit of a double part within some hundred impacts, so a program has to fix " +
      "every bit to show the same picture twice.",
    change: {
      view: "toss",
      system: withForcing(multipleToss, 0.55),
      start: { impact_phase: 0.4, normalised_speed: 1.4, angular_speed: 0 },
    },
  },
  {
    title: "Where a start leads",
    text:
      "Every point of this plane is an impact, by its phase and its speed; its colour says where the disk " +
      "ends. At Γ = 0.486 the orbit with one bounce a period has its widest basin, which is why this motion is " +
      "easy to keep up; along the axis of speed zero lies nothing of it.",
    change: { view: "basins", system: withForcing(multipleToss, 0.486) },
  },
  {
    title: "What falls asleep",
    text:
      "Begin at rest and the other attractor shows: impacts come faster and faster, infinitely many in a " +
      "finite time, until the disk lies on the platform, rides it and is thrown again. The sum of that " +
      "sequence is computed, not cut off.",
    change: { view: "toss", system: withForcing(multipleToss, 0.45), start: REST },
  },
  {
    title: "A motor",
    text:
      "The same equations, 30,000 times faster: the rotor of an ultrasonic motor on a stator that moves by 10 " +
      "nm at 70 kHz. Thousands of impacts drag it to its steady speed; that speed is an average over motors " +
      "that differ by less than anybody can set, and carries an error.",
    change: { view: "motor", system: MOTOR, mass: 0.0329, start: { angular_speed: 0 } },
  },
  {
    title: "Which lag is best?",
    text:
      "Back to the disk: over the forcing, its angular speed in units of the platform's largest one. With θ = " +
      "−0.26π it is at its fastest where the period doubles; set θ to 0 in the form and the fastest place " +
      "moves to Γ = 1/3, where the orbit is born.",
    change: {
      view: "diagram",
      system: withTwist(withForcing(multipleToss, 0.486), 1),
      diagram: { axial_forcing: [0.32, 0.58], quantity: "angular_speed", range: null, branches: true },
    },
  },
];
