/** The readings beside the scene: the present state and the energy balance of the motion. */

import { element, Facts, setText } from "../../elements";
import { plain, quantity } from "../../numbers";
import { say, WORDS } from "../../words";
import { ROUNDING, type Moment, type Recording } from "./recording";

const TEXTS = WORDS.toss;
const MODES: Readonly<Record<string, string>> = TEXTS.modes;

export class Readings {
  readonly facts = new Facts(TEXTS.facts, TEXTS.now_label);
  private readonly ledger = new Facts(TEXTS.energy, TEXTS.balance_label);
  private readonly ledgerTitle = element("h3");
  readonly elements = [element("h3", {}, TEXTS.now), this.facts.root, this.ledgerTitle, this.ledger.root];

  show(moment: Moment, periods: number, impacts: number, recording: Recording): void {
    const { preload_acceleration: g, gyration_radius } = recording.system;
    const gap = recording.settled(moment.height - moment.platform_height, "height", "platform_height");
    const spin = recording.settled(moment.angular_speed, "angular_speed", "platform_angular_speed");
    const velocity = recording.settled(moment.axial_velocity, "axial_velocity", "platform_velocity");
    const height = recording.settled(moment.height, "height", "platform_height");
    this.facts.set({
      mode: MODES[moment.mode] ?? moment.mode,
      time: say(TEXTS.time, { periods: periods.toFixed(2), time: quantity(moment.time, "s") }),
      height: quantity(recording.system.contact_time > 0 ? gap : Math.max(gap, 0), "m"),
      angular_speed: `${plain(spin, 3)} rad/s`,
      impacts: String(impacts),
      axial: quantity(velocity ** 2 / 2, "J/kg"),
      rotary: quantity((gyration_radius * spin) ** 2 / 2, "J/kg"),
      potential: quantity(g * height, "J/kg"),
    });
  }

  balance({ energy, periods }: Recording): void {
    setText(this.ledgerTitle, say(TEXTS.balance, { periods }));
    // What is below the rounding of the largest of them is nothing.
    const largest = Math.max(...Object.values(energy).map(Math.abs));
    for (const [part, value] of Object.entries(energy))
      this.ledger.set({ [part]: quantity(Math.abs(value) <= ROUNDING * largest ? 0 : value, "J/kg") });
  }
}
