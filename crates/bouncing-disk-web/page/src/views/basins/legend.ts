/** The attractors in words, with the shares of the starts that end on them. */

import { element } from "../../drawing/elements";
import { percent } from "../../drawing/numbers";
import type { AttractorsJson } from "../../protocol";
import { categoryColour, isUndecided } from "./cells";

type Attractor = AttractorsJson["attractors"][number];

export class Legend {
  readonly root = element("section", { class: "panel", "aria-label": "Attractors" });
  private readonly list = element("ol", { class: "attractors" });
  private readonly pointed = element(
    "p",
    { class: "pointed", "aria-live": "polite" },
    "Point at a start to read where it ends.",
  );

  /** `caution` stands below the list. */
  constructor(caution: HTMLElement) {
    const note = element(
      "p",
      { class: "remark" },
      "Shares with 95 % intervals are of the library's own sample of starts; those of the window are of its cells.",
    );
    this.root.append(element("h3", {}, "Attractors"), this.pointed, this.list, caution, note);
  }

  show(found: AttractorsJson, shares: ReadonlyMap<number, number>): void {
    const known = labelsOf(found);
    const items = found.attractors.map((attractor, index) => {
      const inWindow = attractor.label === null ? undefined : shares.get(attractor.label);
      const item = element(
        "li",
        {},
        element("span", { class: "swatch", style: `background:var(${categoryColour(index)})`, "aria-hidden": "true" }),
        element(
          "span",
          {},
          describe(attractor, found),
          " ",
          element("b", {}, shareOf(attractor)),
          windowShare(inWindow),
        ),
      );
      return item;
    });
    let undecided = 0;
    for (const [label, share] of shares) if (isUndecided(label, known)) undecided += share;
    items.push(
      element(
        "li",
        {},
        element("span", { class: "swatch undecided", "aria-hidden": "true" }),
        element(
          "span",
          {},
          "Undecided: not on any of these after the allowed number of impacts ",
          element("b", {}, percent(found.undecided)),
          windowShare(shares.size === 0 ? undefined : undecided),
        ),
      ),
    );
    this.list.replaceChildren(...items);
  }

  /** What is under the pointer. */
  point(text: string): void {
    if (this.pointed.textContent !== text) this.pointed.textContent = text;
  }
}

export function labelsOf(found: AttractorsJson | null): number[] {
  return found?.attractors.flatMap(({ label }) => (label === null ? [] : [label])) ?? [];
}

export function describe(attractor: Attractor, found: AttractorsJson): string {
  const text = attractor.text.replace(/\.$/, "");
  if (attractor.lasts || attractor.leads_to === null)
    return attractor.lasts ? `${text}.` : `${text}; it does not last.`;
  const target = found.attractors[attractor.leads_to]?.text.replace(/\.$/, "") ?? "another attractor";
  return `${text}; it does not last, and leads to: ${target}.`;
}

function shareOf({ share, interval: [low, high] }: Attractor): string {
  return `${percent(share)} (95 %: ${percent(low)} to ${percent(high)})`;
}

function windowShare(share: number | undefined): string {
  return share === undefined ? "" : `; ${percent(share)} of this window`;
}
