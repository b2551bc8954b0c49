/**
 * All texts of the page: `words.json`, which the build puts into the page by itself, so that it can be edited there, too.
 * Values stand in braces, as in "{count} forcings".
 */

import words from "./words.json";

export const WORDS = words;

/** A text with its values. */
export const say = (text: string, values: Readonly<Record<string, string | number>>): string =>
  text.replace(/\{(\w+)\}/g, (hole, name: string) => String(values[name] ?? hole));

/** A number with its noun, in the form that goes with it. */
export const counted = (forms: Readonly<Record<"one" | "many", string>>, count: number): string =>
  say(count === 1 ? forms.one : forms.many, { count });

/** "1 impact per period", "4 impacts in 2 periods". */
export function roundOf(impacts: number, periods: number): string {
  const { one, many } = WORDS.diagram.periods;
  return say(periods === 1 ? one : many, { count: counted(WORDS.diagram.impacts, impacts), periods });
}

/** A sentence of the library, which writes for terminals, too. */
export const told = (text: string): string =>
  text
    .replaceAll("+-", "±")
    .replaceAll(" -", " −")
    .replace(" in 1 period", " per period")
    .replace(/impacts (\d+), platform periods (\d+)/, (_, impacts, periods) => roundOf(Number(impacts), Number(periods)))
    .replace(/platform periods (\d+)/, (_, periods) => counted(WORDS.diagram.every, Number(periods)));
