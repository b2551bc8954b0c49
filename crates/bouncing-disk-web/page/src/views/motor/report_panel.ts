/** What is known of the motor in words: regime, warnings, traps, steady speed and stall. */

import { element, Facts, setText } from "../../drawing/elements";
import { plain, quantity, quantityWithError, withError } from "../../drawing/numbers";
import type { ReportJson, StallJson, TransientJson } from "../../protocol";

const NAMES = [
  "Regime", "Forcing Γ", "Largest torque of friction", "Steady speed without load", "Time constant", "Stall load",
  "Speed of the curve at no load",
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

  report(report: ReportJson): void {
    this.facts.set("Regime", report.regime);
    this.facts.set("Forcing Γ", plain(report.axial_forcing, 5));
    this.facts.set("Largest torque of friction", quantity(report.largest_torque, "N m"));
    for (const name of NAMES.slice(3)) this.facts.set(name, "…");
    this.trap.hidden = report.trap === null;
    if (report.trap !== null) {
      const { caught, preload_acceleration, text } = report.trap;
      const where = `at a preload acceleration of ${plain(preload_acceleration, 4)} m/s²`;
      setText(this.trap, `${caught ? "Trap: this motor is caught" : "A trap is near"}, ${where}. ${text}`);
    }
    const { length } = report.warnings;
    this.warningsBox.hidden = length === 0;
    setText(this.warned, length === 1 ? "1 warning" : `${length} warnings`);
    this.warnings.replaceChildren(...report.warnings.map((warning) => element("li", {}, warning)));
    setText(this.text, report.text);
  }

  transient({ steady_speed, steady_speed_error, time_constant }: TransientJson): void {
    this.facts.set("Steady speed without load", `${withError(steady_speed, steady_speed_error)} rad/s`);
    this.facts.set("Time constant", quantity(time_constant, "s"));
  }

  stall(stall: StallJson | null, problem = ""): void {
    const none = problem === "" ? "–" : problem;
    this.facts.set("Stall load", stall === null ? none : quantityWithError(stall.torque, stall.torque_error, "N m"));
    const speed = stall === null ? "–" : `${withError(stall.no_load_speed, stall.no_load_speed_error)} rad/s`;
    this.facts.set("Speed of the curve at no load", speed);
  }
}
