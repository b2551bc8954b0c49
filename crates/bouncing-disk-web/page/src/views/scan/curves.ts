/** The curves of a scan: their points, their chart, and their optima in words. */

import type { State } from "../../contract";
import { evenly, padded, prefixed } from "../../drawing/axes";
import { spanOf, type Chart, type Stretch } from "../../drawing/chart";
import { plain, shown, withError } from "../../numbers";
import type { Range } from "../../protocol";
import { say, WORDS } from "../../words";
import { axisOf, valueText, varied, withValue } from "../varied";
import { RESULT, type Outcome, type Reading } from "./results";

const COLOURS = ["--curve-speed", "--curve-power", "--curve-efficiency", "--stall", "--curve-input"] as const;
const DASHES: readonly (readonly number[])[] = [[], [7, 3], [2, 2], [9, 3, 2, 3], [4, 4]];

interface Line {
  readonly label: string;
  /** Of the second parameter; null where there is none. */
  readonly value: number | null;
  /** The states of its points, and their requests as JSON, by which answers are known. */
  readonly states: readonly State[];
  readonly keys: readonly string[];
}

export interface Plan {
  readonly scan: State["scan"];
  readonly at: readonly number[];
  readonly lines: readonly Line[];
}

export function planOf(state: State): Plan {
  const { scan } = state;
  const at = evenly(scan.range, scan.points);
  const over = varied(scan.over);
  const lineOf = (base: State, label: string, value: number | null): Line => {
    const states = at.map((place) => withValue(over, place, base));
    return { label, value, states, keys: states.map((one) => JSON.stringify(RESULT[scan.result].request(one))) };
  };
  const { family: name } = scan;
  if (name === null) return { scan, at, lines: [lineOf(state, WORDS.scan.results[scan.result], null)] };
  const family = varied(name);
  const lines = scan.values.map((value) => lineOf(withValue(family, value, state), valueText(family, value), value));
  return { scan, at, lines };
}

/** The numbers of the curves, in the order of the plan's lines and places; null where there is no answer yet. */
export function readingsOf({ scan, lines }: Plan, known: ReadonlyMap<string, Outcome>): (Reading | null)[][] {
  const { read } = RESULT[scan.result];
  const readingOf = (outcome: Outcome | undefined): Reading | null =>
    outcome === undefined ? null : typeof outcome === "string" ? { value: NaN, lacks: outcome } : read(outcome);
  return lines.map(({ keys }) => keys.map((key) => readingOf(known.get(key))));
}

export function chartOf({ scan, at, lines }: Plan, readings: readonly (readonly (Reading | null)[])[]): Chart {
  const { unit } = RESULT[scan.result];
  const words = WORDS.scan.results[scan.result];
  const curves = readings.map((line, index) => {
    const column = (of: (reading: Reading) => number | undefined) =>
      line.map((reading) => (reading === null ? NaN : (of(reading) ?? NaN)));
    return {
      label: (lines[index]?.label ?? "").replace(/_(\w+)/, "_{$1}"),
      y: column(({ value }) => value),
      ...(line.some((reading) => reading?.between) && {
        between: [column(({ between }) => between?.[0]), column(({ between }) => between?.[1])] as const,
      }),
      ...(line.some((reading) => reading?.error) && { error: column(({ error }) => error) }),
      colour: COLOURS[index] ?? COLOURS[0],
      dash: DASHES[index] ?? [],
      points: scan.result === "orbit_period" ? ("alone" as const) : true,
    };
  });
  const range = spanOf(curves, [], 0.06);
  const label = unit === "" ? words : `${words} (${unit})`;
  return {
    title: words,
    x: { label: axisOf(varied(scan.over)), range: padded(scan.range, 0.02) },
    y: unit === "W" ? prefixed(`${words} ({prefix}W)`, range) : { label, range },
    at,
    curves,
    stretches: readings.flatMap((line) => jumpsOf(at, line)),
    marks: readings.flatMap((line, index) => {
      const best = bestOf(line);
      const colour = COLOURS[index] ?? COLOURS[0];
      return line.flatMap((reading, place) => {
        const form = place === best ? "circle" : reading?.lacks !== undefined ? "cross" : null;
        const [x, y] = [at[place] ?? NaN, reading?.value ?? NaN];
        return form === null || Number.isNaN(y) ? [] : [{ x, y, form, colour } as const];
      });
    }),
  };
}

/** Where a share jumps, because a disk at rest is thrown onto another attractor: each run of such points, with its neighbours. */
const jumpsOf = (at: readonly number[], line: readonly (Reading | null)[]): Stretch[] =>
  line.flatMap((reading, place) => {
    if (!reading?.moved || line[place - 1]?.moved) return [];
    let last = place;
    while (line[last + 1]?.moved) last += 1;
    const [first, end] = [at[place] as number, at[last] as number];
    const range: Range = [at[place - 1] ?? first, at[last + 1] ?? end];
    return [{ range, at: (first + end) / 2, label: WORDS.scan.jump, colour: "--picture-muted" }];
  });

/** What rounding may change of a number, as a share of it. */
const ROUNDING = 1e-12;

/** Where a value lies by its error, two standard errors wide, or its interval. */
function endsOf({ value, error = 0, between }: Reading): readonly number[] {
  const by = 2 * error + ROUNDING * Math.abs(value);
  return between ?? [value - by, value + by];
}

/** Whether a reading counts: there is one, and the library stands by it. */
const counts = (reading: Reading | null | undefined): reading is Reading =>
  reading != null && reading.lacks === undefined && Number.isFinite(reading.value);

/** The first place of the largest reading, whichever of equal ones rounding has made the largest; -1 if none counts. */
export function bestOf(line: readonly (Reading | null)[]): number {
  const values = line.map((reading) => (counts(reading) ? reading.value : -Infinity));
  const best = Math.max(...values);
  return values.findIndex((value) => value > -Infinity && value >= best - ROUNDING * Math.abs(best));
}

/** A sentence on the optimum of each curve, which says what it was chosen from and what it cannot tell. */
export function describeOptima({ scan, at, lines }: Plan, readings: readonly (readonly (Reading | null)[])[]): string[] {
  const [over, { unit }] = [varied(scan.over), RESULT[scan.result]];
  return readings.map((line, index) => {
    const name = scan.family === null ? "" : `${lines[index]?.label ?? ""}: `;
    const best = bestOf(line);
    const top = line[best];
    if (!counts(top)) return `${name}${WORDS.scan.none}`;
    const found = say(WORDS.scan.best, {
      count: line.filter(counts).length,
      value: numberOf(top, unit),
      at: valueText(over, at[best] ?? NaN),
    });
    return [`${name}${found}`, ...caveats(scan.range, at, line, best)].join(" ");
  });
}

function numberOf({ value, error, between }: Reading, unit: string): string {
  const [own = "", low = "", high = ""] = [value, ...(between ?? [])].map((one) => plain(one, 3));
  if (between) return say(WORDS.scan.interval, { value: own, low, high });
  const number = error === undefined ? shown(value, 4) : withError(value, error);
  return `${unit !== "" && number.includes("±") ? `(${number})` : number} ${unit}`.trim();
}

/** Which points cannot be told from the best one, and where a better one may lie that was not computed. */
function caveats(range: Range, at: readonly number[], line: readonly (Reading | null)[], best: number): string[] {
  const [least = NaN, most = NaN] = endsOf(line[best] as Reading);
  const alike = line.flatMap((reading, place) => {
    if (place === best || !counts(reading)) return [];
    const [low = NaN, high = NaN] = endsOf(reading);
    return low <= most && high >= least ? [at[place] as number] : [];
  });
  const end = at[best] === range[0] || at[best] === range[1];
  const among = { count: alike.length, low: shown(alike[0] ?? NaN, 4), high: shown(alike.at(-1) ?? NaN, 4) };
  return [...(alike.length > 0 ? [say(WORDS.scan.alike, among)] : []), ...(end ? [WORDS.scan.atEnd] : [])];
}

/** "11 of 205 points are left out, the first since ...", and where a disk at rest is moved. */
export function describeGaps({ scan, at }: Plan, readings: readonly (readonly (Reading | null)[])[]): string {
  const all = readings.flat();
  const moved = all.flatMap((reading, place) => (reading?.moved ? [at[place % at.length] as number] : []));
  const first = valueText(varied(scan.over), Math.min(...moved));
  const lacking = all.flatMap((reading) => reading?.lacks ?? []);
  // The library writes all digits of a number.
  const text = (lacking[0] ?? "").replace(/\d+\.\d{5,}/g, (number) => shown(Number(number), 4));
  const gaps = lacking.length > 0 ? [say(WORDS.scan.gaps, { count: lacking.length, all: all.length, text })] : [];
  if (moved.length > 0) gaps.push(say(WORDS.scan.moved, { count: moved.length, all: all.length, at: first }));
  return gaps.join(" ");
}
