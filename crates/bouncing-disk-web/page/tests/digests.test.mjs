/** The module has the bits of every other machine: the digests that x86-64 stores, computed here in Node. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { runInThisContext } from "node:vm";

const here = dirname(fileURLToPath(import.meta.url));

/** The folder with the module and its glue that `cargo xtask explorer` leaves beside the page. */
const folder = process.env.EXPLORER_MODULE;

const skip = folder ? false : "EXPLORER_MODULE is not set";

let module;
before(() => {
  if (!folder) return;
  const glue = readFileSync(join(folder, "bouncing_disk_web.js"), "utf8");
  module = runInThisContext(`(() => { ${glue}; return wasm_bindgen; })()`);
  module.initSync({ module: readFileSync(join(folder, "bouncing_disk_web_bg.wasm")) });
});

test("flights, orbits, chattering and basins are the golden ones", { skip }, () => {
  assert.deepEqual(module.golden_differences(), []);
});

test("diagrams, basins, branches, tosses and motors have the stored digests", { skip }, () => {
  const stored = readFileSync(join(here, "../../../bouncing-disk-python/tests/digests.json"), "utf8");
  assert.equal(module.digests(), stored);
});
