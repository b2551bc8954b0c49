/** The page's module and sources without a browser. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { runInThisContext } from "node:vm";
import { gunzipSync } from "node:zlib";
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

/** The script of the page's workers, and the module that it runs. */
export function partsOf(page) {
  const part = (id) => new RegExp(`id="${id}">(.*?)</script>`, "s").exec(page)[1];
  return { script: part("worker-script"), wasm: gunzipSync(Buffer.from(part("module-base64"), "base64")) };
}

/** Asks the module of the page: for the JSON and the arrays of an answer, and for a motion. */
export function asker() {
  const { script, wasm } = partsOf(readFileSync(file, "utf8"));
  const module = runInThisContext(`(() => { ${script}; return wasm_bindgen; })()`);
  module.initSync({ module: wasm });
  const explorer = new module.Explorer();
  const ask = async (request) => {
    const { json, digest, refused, numbers, bytes } = explorer.respond(JSON.stringify(request));
    assert.equal(refused, false, `${JSON.stringify(request)}: ${json}`);
    return { json: JSON.parse(json), digest, numbers, bytes };
  };
  /** Samples and events of a motion from an impact, by the names of their columns, and the first separation. */
  async function motion({ system, start }, periods = 20) {
    const { MOTION_COLUMNS, EVENT_COLUMNS } = await sourceOf("protocol.ts");
    const request = { call: "motion", system, start: { kind: "impact", ...start }, periods, samples_per_period: 64 };
    const { json, numbers, bytes } = await ask(request);
    const width = MOTION_COLUMNS.length;
    const row = (columns, first) => Object.fromEntries(columns.map((name, column) => [name, numbers[first + column]]));
    const samples = Array.from({ length: json.samples }, (_, index) => row(MOTION_COLUMNS, index * width));
    const events = Array.from({ length: json.events }, (_, index) => ({
      ...row(EVENT_COLUMNS, json.samples * width + index * EVENT_COLUMNS.length),
      kind: json.event_kinds[bytes[json.samples + index]],
    }));
    return { samples, events, separation: events.find(({ kind }) => /separation/i.test(kind)) };
  }
  return { ask, motion };
}
