/** Every text of `words.json` is used, and the build takes others; the compiler says where one is missing. */

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { file, partsOf, WORDS } from "./module.mjs";

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

/** Builds the page with other texts and options; what it says where these are refused, else its HTML. */
function built(change, ...options) {
  const folder = mkdtempSync(join(tmpdir(), "words-"));
  const words = structuredClone(WORDS);
  change(words);
  const { script: glue, wasm } = partsOf(readFileSync(file, "utf8"));
  const inputs = Object.entries({ glue, wasm, words: JSON.stringify(words) }).flatMap(([name, content]) => {
    writeFileSync(join(folder, name), content);
    return [`--${name}`, join(folder, name)];
  });
  const build = fileURLToPath(new URL("../build.mjs", import.meta.url));
  const run = [build, ...inputs, "--out", folder, ...options];
  const { status, stderr } = spawnSync(process.execPath, run, { encoding: "utf8" });
  const html = status === 0 && readFileSync(join(folder, "explorer.html"), "utf8");
  rmSync(folder, { recursive: true });
  return html || stderr;
}

test("a translation is built with all its letters, and refused where it lacks a text or a value", () => {
  const odd = 'a <!-- "b" </script> & c';
  const html = built((own) => Object.assign(own.page, { title: odd, export_title: odd }));
  assert.equal(JSON.parse(/id="words">([^<]*)</.exec(html)[1]).page.title, odd);
  assert.ok(html.includes('title="a &#60;!-- &#34;b&#34; &#60;/script&#62; &#38; c"'));
  assert.match(built((own) => delete own.page.title), /page/);
  assert.match(built((own) => (own.page.title = null)), /page\.title/);
  assert.match(built((own) => (own.page.saved = "saved")), /page\.saved has to have \{name\}/);
});

test("the build writes the address that it is given, and none where there is none", () => {
  const same = () => {};
  const link = '<link rel="canonical" href="https://example.org/?a&amp;b" />';
  assert.ok(built(same, "--address", "https://example.org?a&b").includes(link));
  assert.equal(built(same, "--address", "").includes("<link rel=\"canonical\""), false);
  assert.match(built(same, "--address", "nowhere"), /Invalid URL/);
});
