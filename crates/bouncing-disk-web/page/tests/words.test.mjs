/** Every text of `words.json` is used; that none is missing is for the compiler to say. */

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { WORDS } from "./module.mjs";

const FOLDER = new URL("../src/", import.meta.url);
const FILES = readdirSync(FOLDER, { recursive: true }).filter((name) => name.endsWith(".ts"));
/** `WORDS.a.b`, under this name or another one that a file gives to a part. */
const CHAIN = (name) => new RegExp(`(const (\\w+) = |const \\{([^}]*)\\} = |\\b)${name}((?:\\.\\w+)*)(;?)`, "g");
const DECLARED = /const (\{[^}]*\}|\w+) = WORDS[^;]*;/g;

const leaves = (part, path) =>
  typeof part === "string" ? [path] : Object.entries(part).flatMap(([name, one]) => leaves(one, `${path}.${name}`));

/** Adds to `used` the paths of all texts that a source reaches by this name of the part at `path`. */
function follow(source, name, path, used) {
  for (const [, , alias, parts, rest, end] of source.matchAll(CHAIN(name))) {
    const names = (path + rest).split(".").slice(1);
    let [part, found] = [WORDS, "WORDS"];
    for (const one of names) {
      if (typeof part === "string" || !Object.hasOwn(part, one)) break;
      [part, found] = [part[one], `${found}.${one}`];
    }
    const others = source.replace(DECLARED, "");
    if (alias && end && typeof part !== "string") follow(others, alias, found, used);
    else if (parts) {
      for (const one of parts.split(",").map((text) => text.trim().split(/: ?/)))
        if (one[1] && typeof part[one[0]] !== "string") follow(others, one[1], `${found}.${one[0]}`, used);
        else if (!one[0].startsWith("...")) used.push(`${found}.${one[0]}`);
    } else if (names.length > 0) used.push(found);
  }
}

test("no text is left over", () => {
  const used = [];
  for (const file of FILES) {
    const source = readFileSync(new URL(file, FOLDER), "utf8").replace(/^import .*$/gm, "");
    follow(source, "WORDS", "WORDS", used);
  }
  const reached = (leaf) => used.some((path) => leaf === path || leaf.startsWith(`${path}.`));
  const known = leaves(WORDS, "WORDS").filter((leaf) => leaf !== "WORDS.language");
  assert.deepEqual(known.filter((leaf) => !reached(leaf)), []);
});
