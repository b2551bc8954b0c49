/** Every text of `words.json` is used; that none is missing is for the compiler to say. */

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { WORDS } from "./module.mjs";

const SOURCES = new URL("../src/", import.meta.url);

/** A source with `WORDS.a.b` in the place of each name that it gives to a part of the texts. */
function resolved(source) {
  const found = /const (?:(\w+)|\{ ([^}]*) \}) = (WORDS[.\w]+);/.exec(source);
  if (found === null) return source;
  const [declaration, name, parts = "", path] = found;
  const named = parts.split(", ").map((part) => part.split(": "));
  const names = name ? [[name, path]] : named.map(([key, own = key]) => [own, `${path}.${key}`]);
  const put = (text, [own, whole]) => text.replaceAll(new RegExp(`(?<![.\\w])${own}\\b(?!:)`, "g"), whole);
  return resolved(names.reduce(put, source.replace(declaration, "")));
}

const leaves = (part, path) =>
  typeof part === "string" || Array.isArray(part)
    ? [path]
    : Object.entries(part).flatMap(([name, one]) => leaves(one, `${path}.${name}`));

test("no text is left over", () => {
  const files = readdirSync(SOURCES, { recursive: true }).filter((name) => name.endsWith(".ts"));
  const all = files.map((name) => resolved(readFileSync(new URL(name, SOURCES), "utf8"))).join("\n");
  const page = readFileSync(new URL("../index.html", SOURCES), "utf8");
  const ofPage = [...page.matchAll(/\{\{([\w.]+)\}\}/g)].map(([, path]) => `WORDS.${path}`);
  const used = [...new Set(all.match(/WORDS(\.\w+)+/g)), ...ofPage].map((path) => `${path}.`);
  const isUsed = (leaf) => used.some((path) => `${leaf}.`.startsWith(path) || path.startsWith(`${leaf}.`));
  assert.deepEqual(leaves(WORDS, "WORDS").filter((leaf) => !isUsed(leaf)), []);
});
