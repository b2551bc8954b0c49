/** Three numbers and a button: a throw without a pointer. */

import type { Throw } from "../../contract";
import { button, element } from "../../drawing/elements";
import { quantity } from "../../drawing/numbers";
import type { SystemParameters } from "../../protocol";
import { typed } from "../../numbers";
import { bounded } from "./throwing";

/** Angular speeds beyond this are refused by the library. */
const FASTEST = 1e6;

export class ThrowForm {
  readonly root: HTMLElement;
  private readonly gap = new Entry("Height above the platform (mm)", "100");
  private readonly velocity = new Entry("Relative velocity upwards (mm/s)", "500");
  private readonly spin = new Entry("Angular speed (rad/s)", "5");
  private readonly problem = element("p", { class: "error", role: "alert", hidden: true });

  constructor(
    private readonly system: () => Readonly<SystemParameters>,
    private readonly phase: () => number,
    private readonly start: (thrown: Throw) => void,
  ) {
    const throwIt = () => this.throwIt();
    const rows = [this.gap, this.velocity, this.spin].map(({ row }) => row);
    this.root = element(
      "details",
      { class: "throw" },
      element("summary", {}, "Throw by numbers"),
      element("div", { class: "fields" }, ...rows, this.problem, button("Throw", throwIt)),
    );
  }

  /** A number that no throw can have is refused with the range of those that one can. */
  private throwIt(): void {
    const thrown: Throw = {
      phase: this.phase(),
      gap: this.gap.value / 1000,
      relative_velocity: this.velocity.value / 1000,
      angular_speed: this.spin.value,
    };
    const system = this.system();
    const highest = bounded(system, { ...thrown, gap: Infinity }).gap;
    const fastest = bounded(system, { ...thrown, relative_velocity: Infinity }).relative_velocity;
    // From the platform itself the disk can only leave upwards.
    const slowest = thrown.gap > 0 ? -fastest : 0;
    const wrong = [
      this.gap.refuse(0, highest * 1000, `0 to ${quantity(highest, "m")}`),
      this.velocity.refuse(
        slowest * 1000,
        fastest * 1000,
        `${quantity(slowest, "m/s")} to ${quantity(fastest, "m/s")}`,
      ),
      this.spin.refuse(-FASTEST, FASTEST, `−${FASTEST} to ${FASTEST} rad/s`),
    ].filter((text) => text !== null);
    this.problem.textContent = wrong.join(" ");
    this.problem.hidden = wrong.length === 0;
    if (wrong.length === 0) this.start(bounded(system, thrown));
  }
}

class Entry {
  readonly row: HTMLElement;
  private readonly input: HTMLInputElement;

  constructor(
    private readonly label: string,
    value: string,
  ) {
    this.input = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", value });
    this.row = element("label", {}, label, this.input);
  }

  get value(): number {
    return typed(this.input.value, false) ?? NaN;
  }

  /** What is wrong with the number, or null. */
  refuse(low: number, high: number, range: string): string | null {
    const legal = this.value >= low && this.value <= high;
    this.input.setAttribute("aria-invalid", String(!legal));
    return legal ? null : `${this.label}: "${this.input.value.slice(0, 24)}" is refused, it has to be from ${range}.`;
  }
}
