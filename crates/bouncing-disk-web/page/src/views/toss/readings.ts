/** The readings beside the scene: the present state, and the energy balance of the motion. */

import { element, Facts, setText } from "../../drawing/elements";
import { plain, quantity } from "../../drawing/numbers";
import type { SystemParameters } from "../../protocol";
import type { Moment, Recording } from "./recording";

const READOUTS = [
  "Mode", "Time", "Height above the platform", "Angular speed", "Impacts so far",
  "Kinetic, axial", "Kinetic, rotary", "Potential",
] as const; // prettier-ignore
const LEDGER = ["Work of the platform", "Lost in restitution", "Lost in friction", "Stored in the disk"] as const;

export class Readings {
  private readonly facts = new Facts(READOUTS, "Present state; energies per mass of the disk");
  private readonly ledger = new Facts(LEDGER, "Energy balance per mass of the disk");
  private readonly ledgerTitle = element("h3", {}, "Energy balance");
  readonly elements = [element("h3", {}, "Now"), this.facts.root, this.ledgerTitle, this.ledger.root];

  show(moment: Moment, periods: number, impacts: number, system: Readonly<SystemParameters>): void {
    const { facts } = this;
    facts.set("Mode", moment.mode);
    facts.set("Time", `${periods.toFixed(2)} periods, ${quantity(moment.time, "s")}`);
    facts.set("Height above the platform", quantity(Math.max(moment.height - moment.platform_height, 0), "m"));
    facts.set("Angular speed", `${plain(moment.angular_speed, 3)} rad/s`);
    facts.set("Impacts so far", String(impacts));
    facts.set("Kinetic, axial", quantity(moment.axial_velocity ** 2 / 2, "J/kg"));
    facts.set("Kinetic, rotary", quantity((system.gyration_radius * moment.angular_speed) ** 2 / 2, "J/kg"));
    facts.set("Potential", quantity(system.preload_acceleration * moment.height, "J/kg"));
  }

  balance({ energy, periods }: Recording): void {
    setText(this.ledgerTitle, `Energy balance of ${periods} periods`);
    this.ledger.set("Work of the platform", quantity(energy.platform_work, "J/kg"));
    this.ledger.set("Lost in restitution", quantity(energy.restitution_loss, "J/kg"));
    this.ledger.set("Lost in friction", quantity(energy.friction_loss, "J/kg"));
    this.ledger.set("Stored in the disk", quantity(energy.stored, "J/kg"));
  }
}
