/** The attractors in words, with the shares of the starts that end on them: on the screen and in print. */

import { element, section, setText } from "../../elements";
import { brief, grouped, percent } from "../../numbers";
import type { AttractorJson, AttractorsJson } from "../../protocol";
import { say, told, WORDS } from "../../words";
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

  /** Those of another map are being looked for. */
  dim(stale: boolean): void {
    this.root.classList.toggle("stale", stale);
    if (stale) this.point(TEXTS.point);
  }

  /** Nothing where no attractors are known; `shares` are null as long as the window is not computed. */
  show(found: AttractorsJson | null, shares: Shares | null): void {
    this.dim(false);
    this.list.replaceChildren(...(found === null ? [] : entriesOf(found, shares).map(itemOf)));
    const about = found && { starts: grouped(String(found.starts)), fastest: brief(found.fastest_start, 3) };
    setText(this.note, about === null ? "" : say(TEXTS.note, about));
  }

  point(text: string): void {
    setText(this.pointed, text);
  }
}

/** What a colour means: an attractor, with its share of the window, where that is known, and that of all starts. */
interface Entry {
  readonly colour: string;
  readonly words: string;
  readonly share: number | null;
  readonly all: string;
}

const UNDECIDED = "--undecided";

/** The attractors in the order of their colours, numbered as their texts name each other, and what is undecided. */
function entriesOf(found: AttractorsJson, shares: Shares | null): Entry[] {
  const fastest = brief(found.fastest_start, 3);
  const known = found.attractors.map((attractor, index) => {
    const [share = "", low = "", high = ""] = [attractor.share, ...attractor.interval].map((one) => percent(one));
    const own = shares === null || attractor.label === null ? null : (shares.get(attractor.label) ?? 0);
    const all = say(TEXTS.all, { share, low, high, fastest });
    const words = say(TEXTS.numbered, { number: String(index + 1), text: describe(attractor, found) });
    return { colour: categoryColour(index), words, share: own, all };
  });
  const all = say(TEXTS.all_undecided, { share: percent(found.undecided), fastest });
  return [...known, { colour: UNDECIDED, words: TEXTS.undecided, share: undecidedShare(found, shares), all }];
}

/** The share of what is seen, as soon as it is known, is the answer; that of all starts has a line of its own. */
function itemOf({ colour, words, share, all }: Entry): HTMLElement {
  const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
  if (colour === UNDECIDED) swatch.classList.add("undecided");
  else swatch.style.background = `var(${colour})`;
  const [before = "", after = ""] = TEXTS.window.split("{share}");
  const own = share === null ? [] : [" ", before, element("b", {}, percent(share)), after];
  const text = element("span", {}, words, ...own, element("small", {}, all));
  return element("li", {}, swatch, text);
}

/** The labels of cells that are decided. */
export const labelsOf = (found: AttractorsJson): number[] =>
  found.attractors.flatMap(({ label }) => (label === null ? [] : [label]));

export function describe(attractor: AttractorJson, found: AttractorsJson): string {
  const text = told(attractor.text).replace(/\.$/, "");
  if (attractor.lasts) return say(TEXTS.lasts, { text });
  if (attractor.leads_to === null) return say(TEXTS.ends, { text });
  const target = told(found.attractors[attractor.leads_to]?.text ?? TEXTS.another).replace(/\.$/, "");
  return say(TEXTS.leads, { text, target });
}

function undecidedShare(found: AttractorsJson, shares: Shares | null): number | null {
  if (shares === null) return null;
  const known = labelsOf(found);
  return [...shares].reduce((sum, [label, share]) => sum + (known.includes(label) ? 0 : share), 0);
}

/** For print: the attractors that are seen, and what is undecided. */
export const printedLegend = (found: AttractorsJson, shares: Shares) =>
  entriesOf(found, shares)
    .filter(({ colour, share }) => share !== 0 || colour === UNDECIDED)
    .map(({ colour, words: text, share }) => ({
      colour,
      text: say(TEXTS.printed_share, { share: percent(share ?? 0), text }),
    }));
