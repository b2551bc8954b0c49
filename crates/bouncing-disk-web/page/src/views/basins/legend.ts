/** The attractors in words, with the shares of the starts that end on them: on the screen and in print. */

import { ONE_COLUMN, PRINT_SIZE } from "../../drawing/files";
import { wrapped, type Pen } from "../../drawing/pen";
import { element, section, setText } from "../../elements";
import { brief, grouped, percent } from "../../numbers";
import type { AttractorJson, AttractorsJson } from "../../protocol";
import { say, WORDS } from "../../words";
import { categoryColour } from "./cells";

type Shares = ReadonlyMap<number, number>;

const TEXTS = WORDS.basins;

export class Legend {
  readonly root: HTMLElement;
  private readonly list = element("ol", { class: "attractors" });
  private readonly pointed = element("p", { class: "pointed", "aria-live": "polite" }, TEXTS.point);
  private readonly note = element("p", { class: "remark" });

  /** `caution` stands below the list. */
  constructor(caution: HTMLElement) {
    const parts = [element("h3", {}, TEXTS.attractors), this.pointed, this.list, caution, this.note];
    this.root = section(TEXTS.attractors, "panel", ...parts);
  }

  /** Nothing, where no attractors are known. */
  clear(): void {
    this.list.replaceChildren();
    this.note.textContent = "";
    this.point(TEXTS.point);
    this.dim(false);
  }

  /** Those of another map are being looked for. */
  dim(stale: boolean): void {
    this.root.classList.toggle("stale", stale);
    if (stale) this.point(TEXTS.point);
  }

  /** `shares` are those of the cells of the window; null as long as they are not computed. */
  show(found: AttractorsJson, shares: Shares | null): void {
    this.dim(false);
    const starts = grouped(String(found.starts));
    this.note.textContent = say(TEXTS.note, { starts, fastest: brief(found.fastest_start, 3) });
    const items = found.attractors.map((attractor, index) => {
      const style = `background:var(${categoryColour(index)})`;
      const [share = "", low = "", high = ""] = [attractor.share, ...attractor.interval].map((one) => percent(one));
      const all = say(TEXTS.all, { share, low, high });
      return item({ class: "swatch", style }, describe(attractor, found), windowShare(attractor, shares), all);
    });
    const share = undecidedShare(found, shares);
    const all = say(TEXTS.all_undecided, { share: percent(found.undecided) });
    items.push(item({ class: "swatch undecided" }, TEXTS.undecided, share, all));
    this.list.replaceChildren(...items);
  }

  point(text: string): void {
    setText(this.pointed, text);
  }
}

/** The share of what is seen, as soon as it is known, is the answer; that of all starts has a line of its own. */
function item(swatch: Record<string, string>, words: string, share: number | null, all: string): HTMLElement {
  const [before = "", after = ""] = TEXTS.window.split("{share}");
  const own = share === null ? [] : [" ", before, element("b", {}, percent(share)), after];
  const text = element("span", {}, words, ...own, element("small", {}, all));
  return element("li", {}, element("span", { ...swatch, "aria-hidden": "true" }), text);
}

/** The labels of cells that are decided. */
export function labelsOf(found: AttractorsJson): number[] {
  return found.attractors.flatMap(({ label }) => (label === null ? [] : [label]));
}

export function describe(attractor: AttractorJson, found: AttractorsJson): string {
  const text = attractor.text.replace(/\.$/, "");
  if (attractor.lasts) return say(TEXTS.lasts, { text });
  if (attractor.leads_to === null) return say(TEXTS.ends, { text });
  const target = found.attractors[attractor.leads_to]?.text.replace(/\.$/, "") ?? TEXTS.another;
  return say(TEXTS.leads, { text, target });
}

/** The share of the cells of the window; null where it is not known. An attractor that has none of them has 0. */
function windowShare({ label }: AttractorJson, shares: Shares | null): number | null {
  return shares === null || label === null ? null : (shares.get(label) ?? 0);
}

export function undecidedShare(found: AttractorsJson, shares: Shares | null): number | null {
  if (shares === null) return null;
  const known = labelsOf(found);
  return [...shares].reduce((sum, [label, share]) => sum + (known.includes(label) ? 0 : share), 0);
}

const LEFT = PRINT_SIZE;
const INDENT = 0.5 * PRINT_SIZE;
const LINE = 1.3 * PRINT_SIZE;
const GAP = 0.3 * LINE;
const SWATCH = 1.2 * PRINT_SIZE;
const SWATCH_HEIGHT = 0.8 * PRINT_SIZE;
/** Of the words beside a swatch. */
const ROOM = ONE_COLUMN - 2 * LEFT - SWATCH - INDENT;
/** More attractors than this are counted and not listed. */
const MOST = 12;

/** Below the plot: attractors by their shares of the window, those with the largest first. */
export function printedLegend(found: AttractorsJson, shares: Shares) {
  const entry = (swatch: string | null, words: string, share: number | null) => ({
    swatch,
    lines: wrapped(say(TEXTS.printed_share, { share: percent(share ?? 0), text: words }), PRINT_SIZE, ROOM),
  });
  const known = found.attractors.map((attractor, index) => ({
    share: windowShare(attractor, shares) ?? 0,
    swatch: categoryColour(index),
    words: describe(attractor, found),
  }));
  const sorted = known.sort((one, other) => other.share - one.share);
  const entries = sorted.slice(0, MOST).map(({ share, swatch, words }) => entry(swatch, words, share));
  const rest = sorted.slice(MOST);
  if (rest.length > 0) {
    const together = rest.reduce((sum, { share }) => sum + share, 0);
    entries.push(entry(null, say(TEXTS.others, { count: rest.length }), together));
  }
  entries.push(entry("--undecided", TEXTS.undecided_here, undecidedShare(found, shares)));
  const lines = entries.reduce((sum, { lines: { length } }) => sum + length, 0);
  return {
    height: (lines + 2) * LINE + GAP * entries.length,
    paint(pen: Pen, top: number): void {
      const ink = { colour: "--picture-text", size: PRINT_SIZE, baseline: "top" } as const;
      let y = top + GAP;
      pen.text(TEXTS.printed, LEFT, y, ink);
      y += 1.3 * LINE;
      for (const { swatch, lines } of entries) {
        const frame = { fill: swatch ?? "", stroke: "--picture-frame", width: 0.6 };
        if (swatch !== null) pen.rect(LEFT, y, SWATCH, SWATCH_HEIGHT, frame);
        if (swatch === "--undecided") stripes(pen, y);
        for (const line of lines) {
          pen.text(line, LEFT + SWATCH + INDENT, y, ink);
          y += LINE;
        }
        y += GAP;
      }
    },
  };
}

/** The pattern by which undecided cells are told from others. */
function stripes(pen: Pen, y: number): void {
  const points: number[] = [];
  for (let x = LEFT; x < LEFT + SWATCH - SWATCH_HEIGHT / 2; x += 3)
    points.push(x, y + SWATCH_HEIGHT, x + SWATCH_HEIGHT / 2, y, NaN, NaN);
  pen.path(points, { stroke: "--undecided-line", width: 1 });
}
