/** The attractors in words, with the shares of the starts that end on them. */

import { element } from "../../drawing/elements";
import { brief, grouped, percent } from "../../drawing/numbers";
import type { AttractorsJson } from "../../protocol";
import { categoryColour, isUndecided } from "./cells";

type Attractor = AttractorsJson["attractors"][number];

const HINT = "Point at a start to read where it ends.";

export class Legend {
  readonly root = element("section", { class: "panel", "aria-label": "Attractors" });
  private readonly list = element("ol", { class: "attractors" });
  private readonly pointed = element("p", { class: "pointed", "aria-live": "polite" }, HINT);
  private readonly note = element("p", { class: "remark" });

  /** `caution` stands below the list. */
  constructor(caution: HTMLElement) {
    this.root.append(element("h3", {}, "Attractors"), this.pointed, this.list, caution, this.note);
  }

  /** Nothing, where no attractors are known. */
  clear(): void {
    this.list.replaceChildren();
    this.note.textContent = "";
    this.point(HINT);
    this.dim(false);
  }

  /** Those of another map are being looked for. */
  dim(stale: boolean): void {
    this.root.classList.toggle("stale", stale);
    if (stale) this.point(HINT);
  }

  /** `shares` are those of the cells of the window; null as long as they are not computed. */
  show(found: AttractorsJson, shares: ReadonlyMap<number, number> | null): void {
    this.dim(false);
    this.note.textContent = describeSample(found);
    const items = found.attractors.map((attractor, index) => {
      const item = element(
        "li",
        {},
        element("span", { class: "swatch", style: `background:var(${categoryColour(index)})`, "aria-hidden": "true" }),
        element(
          "span",
          {},
          describe(attractor, found),
          " ",
          ...sharesOf(windowShare(attractor, shares), sampleShare(attractor)),
        ),
      );
      return item;
    });
    items.push(
      element(
        "li",
        {},
        element("span", { class: "swatch undecided", "aria-hidden": "true" }),
        element(
          "span",
          {},
          "Undecided: not on any of these after the allowed number of impacts. ",
          ...sharesOf(undecidedShare(found, shares), percent(found.undecided)),
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

/** The share of the cells of the window; null where it is not known. An attractor that has none of them has 0. */
export function windowShare({ label }: Attractor, shares: ReadonlyMap<number, number> | null): number | null {
  return shares === null || label === null ? null : (shares.get(label) ?? 0);
}

export function undecidedShare(found: AttractorsJson, shares: ReadonlyMap<number, number> | null): number | null {
  if (shares === null) return null;
  const known = labelsOf(found);
  let undecided = 0;
  for (const [label, share] of shares) if (isUndecided(label, known)) undecided += share;
  return undecided;
}

function sampleShare({ share, interval: [low, high] }: Attractor): string {
  return `${percent(share)} (95 %: ${percent(low)} to ${percent(high)})`;
}

/** First the share of what is seen, then that of the sample of the library. */
function sharesOf(inWindow: number | null, inSample: string): (HTMLElement | string)[] {
  const own = inWindow === null ? [] : [element("b", {}, percent(inWindow)), " of this window; "];
  return [...own, `${inSample} of the sample.`];
}

/** Of which starts the shares are. */
function describeSample({ starts, fastest_start }: AttractorsJson): string {
  return (
    "Shares of this window are of its cells. The sample is the library's own, whatever the window is: " +
    `${grouped(String(starts))} starts spread evenly over all phases and all normalised speeds up to the bound that no ` +
    `attractor exceeds at that phase (${brief(fastest_start, 3)} at most); the intervals are those of a random sample.`
  );
}
