/** The page's module and sources without a browser. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { runInThisContext } from "node:vm";
import { build } from "esbuild";

/** The page that is tested: that of `cargo xtask explorer`, if EXPLORER_HTML names no other one. */
export const file =
  process.env.EXPLORER_HTML ?? fileURLToPath(new URL("../../../../target/explorer/explorer.html", import.meta.url));

/** All texts of the page. */
export const WORDS = JSON.parse(readFileSync(new URL("../src/words.json", import.meta.url), "utf8"));

/** A text as the source of a pattern, with patterns for some of its values, and `.*` for the others. */
export const patternOf = (text, values = {}) =>
  text.replace(/[.*+?^$()|[\]\\]/g, "\\$&").replace(/\{(\w+)\}/g, (_, name) => values[name] ?? ".*");

export async function sourceOf(path) {
  const entryPoints = [fileURLToPath(new URL(`../src/${path}`, import.meta.url))];
  const { outputFiles } = await build({ entryPoints, write: false, bundle: true, format: "esm", logLevel: "warning" });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

/** The module, with what its glue makes of it, in this process. */
export function moduleOf(glue, wasm) {
  const module = runInThisContext(`(() => { ${readFileSync(glue, "utf8")}; return wasm_bindgen; })()`);
  module.initSync({ module: readFileSync(wasm) });
  return module;
}

/** Gives the JSON and the arrays of answers by the module of the page. */
export function asker() {
  const site = join(dirname(file), "site");
  const explorer = new (moduleOf(join(site, "worker.js"), join(site, "module.wasm")).Explorer)();
  return async (request) => {
    const { json, refused, numbers, bytes } = explorer.respond(JSON.stringify(request));
    assert.equal(refused, false, `${JSON.stringify(request)}: ${json}`);
    return { json: JSON.parse(json), numbers, bytes };
  };
}
