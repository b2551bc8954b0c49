/** What stands above and below printed basins: the map, and the attractors with their colours and shares. */

import type { Colours } from "../../drawing/colours";
import { PRINT_SIZE, ONE_COLUMN } from "../../drawing/files";
import { brief, percent } from "../../drawing/numbers";
import { measureRuns, PRINT_FONT } from "../../drawing/pen";
import type { Pen } from "../../drawing/pen";
import type { AttractorsJson } from "../../protocol";
import { categoryColour } from "./cells";
import { describe, undecidedShare, windowShare } from "./legend";

export const TITLE_HEIGHT = 1.5 * PRINT_SIZE;
const LINE = 1.3 * PRINT_SIZE;
const SWATCH = 1.2 * PRINT_SIZE;
/** More attractors than this are counted and not listed. */
const MOST = 12;

/** Above the plot: with which numbers it was computed. */
export function paintTitle(pen: Pen, colour: Colours, width: number, forcing: number, restitution: number): void {
  pen.text(`Γ = ${brief(forcing)}, *ε* = ${brief(restitution)}`, width / 2, 0.3 * PRINT_SIZE, {
    colour: colour("--picture-text"),
    size: PRINT_SIZE,
    anchor: "middle",
    baseline: "top",
  });
}

interface Entry {
  readonly swatch: string | null;
  readonly lines: readonly string[];
}

/** Below the plot: attractors by their shares of the window, those with the largest first. */
export function printedLegend(found: AttractorsJson, shares: ReadonlyMap<number, number>) {
  const text = (words: string, share: number) => wrapped(`${percent(share)}: ${words}`);
  const known = found.attractors.map((attractor, index) => ({
    share: windowShare(attractor, shares) ?? 0,
    swatch: categoryColour(index),
    words: describe(attractor, found),
  }));
  const sorted = [...known].sort((one, other) => other.share - one.share);
  const entries: Entry[] = sorted
    .slice(0, MOST)
    .map(({ share, swatch, words }) => ({ swatch, lines: text(words, share) }));
  const rest = sorted.slice(MOST);
  if (rest.length > 0) {
    const together = rest.reduce((sum, { share }) => sum + share, 0);
    entries.push({ swatch: null, lines: text(`on ${rest.length} other attractors.`, together) });
  }
  entries.push({ swatch: "--undecided", lines: text("undecided.", undecidedShare(found, shares) ?? 0) });
  const lines = entries.reduce((sum, entry) => sum + entry.lines.length, 0);
  const gaps = 0.3 * LINE * entries.length;
  return {
    height: (lines + 2) * LINE + gaps,
    paint(pen: Pen, colour: Colours, top: number): void {
      const ink = { colour: colour("--picture-text"), size: PRINT_SIZE, baseline: "top" } as const;
      let y = top + 0.3 * LINE;
      pen.text("Shares of the starts in this window by what they end on:", LEFT, y, ink);
      y += 1.3 * LINE;
      for (const entry of entries) {
        if (entry.swatch !== null) {
          const frame = { fill: colour(entry.swatch), stroke: colour("--picture-frame"), width: 0.6 };
          pen.rect(LEFT, y, SWATCH, 0.8 * PRINT_SIZE, frame);
          if (entry.swatch === "--undecided") stripes(pen, colour, y);
        }
        for (const line of entry.lines) {
          pen.text(line, LEFT + SWATCH + INDENT, y, ink);
          y += LINE;
        }
        y += 0.3 * LINE;
      }
    },
  };
}

const LEFT = PRINT_SIZE;
const INDENT = 0.5 * PRINT_SIZE;

/** The pattern by which undecided cells are told from others. */
function stripes(pen: Pen, colour: Colours, y: number): void {
  const high = 0.8 * PRINT_SIZE;
  const points: number[] = [];
  for (let x = LEFT; x < LEFT + SWATCH - high / 2; x += 3) points.push(x, y + high, x + high / 2, y, NaN, NaN);
  pen.path(points, { stroke: colour("--undecided-line"), width: 1 });
}

/** Words in lines that are no longer than the column has room for. */
function wrapped(text: string): string[] {
  const room = ONE_COLUMN - 2 * LEFT - SWATCH - INDENT;
  const lines: string[] = [];
  let line = "";
  for (const word of text.split(" ")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && measureRuns(longer, PRINT_SIZE, PRINT_FONT) > room) {
      lines.push(line);
      line = word;
    } else line = longer;
  }
  return [...lines, line];
}
