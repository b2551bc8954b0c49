/** What is known of the motor in words: regime, warnings, traps, steady speed and stall. */

import { element, Facts, setText } from "../../drawing/elements";
import { plain, quantity } from "../../drawing/numbers";
import type { ReportJson, StallJson } from "../../protocol";
import type { Operation, Transient } from "./computation";
import { describeStall, describeTrap, steadySpeed, timeConstant } from "./words";

const NAMES = [
  "Regime", "Forcing Γ", "Largest torque of friction", "Steady speed", "Time constant", "Stall load",
] as const; // prettier-ignore

export class ReportPanel {
  readonly root = element("section", { class: "panel", "aria-label": "Report" });
  private readonly facts = new Facts(NAMES, "The motor in numbers");
  /** Stands above the curves, which a trap makes those of another motion than one would expect. */
  readonly trap = element("p", { class: "caution trap", hidden: true });
  private readonly warnings = element("ul", { class: "warnings" });
  private readonly warned = element("summary", { class: "warned" });
  private readonly warningsBox = element("details", { hidden: true }, this.warned, this.warnings);
  private readonly text = element("pre", { class: "report", tabindex: 0, "aria-label": "Full report" });

  constructor() {
    const full = element("details", {}, element("summary", {}, "Full report"), this.text);
    this.root.append(element("h3", {}, "Report"), this.facts.root, this.warningsBox, full);
  }

  /** Forgets a motor. */
  clear(): void {
    for (const name of NAMES) this.facts.set(name, "…");
    this.trap.hidden = true;
    this.warningsBox.hidden = true;
    setText(this.text, "");
  }

  report(report: ReportJson): void {
    this.facts.set("Regime", report.regime);
    this.facts.set("Forcing Γ", plain(report.axial_forcing, 5));
    this.facts.set("Largest torque of friction", quantity(report.largest_torque, "N m"));
    this.trap.hidden = report.trap === null;
    if (report.trap !== null) setText(this.trap, describeTrap(report.trap, report));
    const { length } = report.warnings;
    this.warningsBox.hidden = length === 0;
    setText(this.warned, length === 1 ? "1 warning" : `${length} warnings`);
    this.warnings.replaceChildren(...report.warnings.map((warning) => element("li", {}, warning)));
    setText(this.text, report.text);
  }

  /** Of a motor that nothing turns. */
  still(): void {
    for (const name of ["Steady speed", "Time constant", "Stall load"]) this.facts.set(name, "–");
  }

  runUp(transient: Transient | null, own: Operation | null, problem = ""): void {
    const known = transient === null ? problem || "…" : timeConstant(transient.json, own);
    this.facts.set("Time constant", known);
  }

  operation(own: Operation, report: ReportJson): void {
    this.facts.set("Steady speed", steadySpeed(own, report.largest_torque));
  }

  stall(stall: StallJson | null, problem = ""): void {
    this.facts.set("Stall load", stall === null ? problem || "–" : describeStall(stall));
  }
}
