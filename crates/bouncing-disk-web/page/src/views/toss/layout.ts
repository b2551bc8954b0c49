/** Where the parts of the first view stand. */

import { element } from "../../drawing/elements";

export interface TossParts {
  readonly scene: readonly HTMLElement[];
  readonly traces: readonly HTMLElement[];
  readonly readings: readonly HTMLElement[];
  readonly portrait: HTMLElement;
}

export function tossLayout({ scene, traces, readings, portrait }: TossParts): HTMLElement {
  const key =
    "Each impact so far; the ring is the last one, the plus the shared start. A click starts the motion there.";
  return element(
    "div",
    { class: "toss" },
    element(
      "div",
      { class: "toss-left" },
      element("div", {}, ...scene),
      element("section", { "aria-label": "Time traces" }, ...traces),
    ),
    element(
      "div",
      { class: "toss-right" },
      element("section", { class: "panel", "aria-label": "Readings" }, ...readings),
      element(
        "section",
        { "aria-label": "Phase portrait" },
        element("h3", {}, "Impacts"),
        portrait,
        element("p", { class: "remark" }, key),
      ),
    ),
  );
}
