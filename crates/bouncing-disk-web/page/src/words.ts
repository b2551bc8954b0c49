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
