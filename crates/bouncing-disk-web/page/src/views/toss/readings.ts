/** The readings beside the scene: the present state, and the energy balance of the motion. */

import { element, Facts, setText } from "../../drawing/elements";
import { plain, quantity } from "../../drawing/numbers";
import { ROUNDING } from "./recording";
import type { Moment, Recording } from "./recording";

const READOUTS = [
  "Mode", "Time", "Height above the platform", "Angular speed", "Impacts so far",
  "Kinetic, axial", "Kinetic, rotary", "Potential",
] as const; // prettier-ignore
const LEDGER = [
  "Work of the platform", "Lost in restitution", "Lost in friction", "Work against the load", "Stored in the disk",
] as const; // prettier-ignore

export class Readings {
  private readonly facts = new Facts(READOUTS, "Present state; energies per mass of the disk");
  private readonly ledger = new Facts(LEDGER, "Energy balance per mass of the disk");
  private readonly ledgerTitle = element("h3", {}, "Energy balance");
  readonly elements = [element("h3", {}, "Now"), this.facts.root, this.ledgerTitle, this.ledger.root];

  show(moment: Moment, periods: number, impacts: number, recording: Recording): void {
    const { facts } = this;
    const { preload_acceleration: g, gyration_radius } = recording.system;
    const gap = recording.settled(moment.height - moment.platform_height, "height", "platform_height");
    const spin = recording.settled(moment.angular_speed, "angular_speed", "platform_angular_speed");
    const velocity = recording.settled(moment.axial_velocity, "axial_velocity", "platform_velocity");
    const height = recording.settled(moment.height, "height", "platform_height");
    facts.set("Mode", moment.mode);
    facts.set("Time", `${periods.toFixed(2)} periods, ${quantity(moment.time, "s")}`);
    facts.set("Height above the platform", quantity(Math.max(gap, 0), "m"));
    facts.set("Angular speed", `${plain(spin, 3)} rad/s`);
    facts.set("Impacts so far", String(impacts));
    facts.set("Kinetic, axial", quantity(velocity ** 2 / 2, "J/kg"));
    facts.set("Kinetic, rotary", quantity((gyration_radius * spin) ** 2 / 2, "J/kg"));
    facts.set("Potential", quantity(g * height, "J/kg"));
  }

  balance({ energy, periods }: Recording): void {
    setText(this.ledgerTitle, `Energy balance of ${periods} periods`);
    // What is below the rounding of the largest of them is nothing.
    const largest = Math.max(...Object.values(energy).map(Math.abs));
    const told = (value: number) => quantity(Math.abs(value) <= ROUNDING * largest ? 0 : value, "J/kg");
    this.ledger.set("Work of the platform", told(energy.platform_work));
    this.ledger.set("Lost in restitution", told(energy.restitution_loss));
    this.ledger.set("Lost in friction", told(energy.friction_loss));
    this.ledger.set("Work against the load", told(energy.load_work));
    this.ledger.set("Stored in the disk", told(energy.stored));
  }
}
