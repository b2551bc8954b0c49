/** The readings beside the scene: the present state, also in a sentence, and the energy balance of the motion. */

import { element, Facts, setText } from "../../elements";
import { plain, quantity } from "../../numbers";
import { ROUNDING, type Moment, type Recording } from "./recording";

const READOUTS = [
  "Mode", "Time", "Height above the platform", "Angular speed", "Impacts so far",
  "Kinetic, axial", "Kinetic, rotary", "Potential",
] as const; // prettier-ignore
const LEDGER = {
  "Work of the platform": "platform_work",
  "Lost in restitution": "restitution_loss",
  "Lost in friction": "friction_loss",
  "Work against the load": "load_work",
  "Stored in the disk": "stored",
} as const;

export class Readings {
  private readonly facts = new Facts(READOUTS, "Present state; energies per mass of the disk");
  private readonly ledger = new Facts(Object.keys(LEDGER), "Energy balance per mass of the disk");
  private readonly ledgerTitle = element("h3", {}, "Energy balance");
  readonly elements = [element("h3", {}, "Now"), this.facts.root, this.ledgerTitle, this.ledger.root];

  show(moment: Moment, periods: number, impacts: number, recording: Recording): void {
    const { preload_acceleration: g, gyration_radius } = recording.system;
    const gap = recording.settled(moment.height - moment.platform_height, "height", "platform_height");
    const spin = recording.settled(moment.angular_speed, "angular_speed", "platform_angular_speed");
    const velocity = recording.settled(moment.axial_velocity, "axial_velocity", "platform_velocity");
    const height = recording.settled(moment.height, "height", "platform_height");
    const texts = [
      moment.mode,
      `${periods.toFixed(2)} periods, ${quantity(moment.time, "s")}`,
      quantity(recording.system.contact_time > 0 ? gap : Math.max(gap, 0), "m"),
      `${plain(spin, 3)} rad/s`,
      String(impacts),
      quantity(velocity ** 2 / 2, "J/kg"),
      quantity((gyration_radius * spin) ** 2 / 2, "J/kg"),
      quantity(g * height, "J/kg"),
    ];
    READOUTS.forEach((name, index) => this.facts.set(name, texts[index] ?? ""));
  }

  balance({ energy, periods }: Recording): void {
    setText(this.ledgerTitle, `Energy balance of ${periods} periods`);
    // What is below the rounding of the largest of them is nothing.
    const largest = Math.max(...Object.values(energy).map(Math.abs));
    for (const [name, part] of Object.entries(LEDGER)) {
      const value = energy[part];
      this.ledger.set(name, quantity(Math.abs(value) <= ROUNDING * largest ? 0 : value, "J/kg"));
    }
  }
}

const WORDS: Readonly<Record<string, string>> = {
  flight: "is in flight",
  sticking: "sticks to the platform",
  "sliding forward": "slides forward on the platform",
  "sliding backward": "slides backward on the platform",
  held: "is held",
};

export function describeMoment(moment: Moment, periods: number, impacts: number, recording: Recording): string {
  const gap = recording.settled(moment.height - moment.platform_height, "height", "platform_height");
  const speed = (value: number) => plain(recording.settled(value, "angular_speed", "platform_angular_speed"), 3);
  const indented = gap < 0 && recording.system.contact_time > 0;
  const place =
    gap > 0 || indented ? `, ${quantity(Math.abs(gap), "m")} ${indented ? "into the contact" : "above the platform"},` : "";
  return (
    `After ${periods.toFixed(2)} periods and ${impacts} impacts the disk ${WORDS[moment.mode] ?? moment.mode}${place} ` +
    `and turns at ${speed(moment.angular_speed)} rad/s; the platform at ${speed(moment.platform_angular_speed)} rad/s.`
  );
}
