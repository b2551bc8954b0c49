/** The module has the bits of every other machine: the digests that x86-64 stores, computed here in Node. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { moduleOf } from "./module.mjs";

/** The folder with the module and its glue that `cargo xtask explorer` leaves beside the page. */
const folder = process.env.EXPLORER_MODULE;
const skip = folder ? false : "EXPLORER_MODULE is not set";
const module = folder && moduleOf(join(folder, "bouncing_disk_web.js"), join(folder, "bouncing_disk_web_bg.wasm"));

test("flights, orbits, chattering and basins are the golden ones", { skip }, () => {
  assert.deepEqual(module.golden_differences(), []);
});

test("diagrams, basins, branches, tosses and motors have the stored digests", { skip }, () => {
  const stored = new URL("../../../bouncing-disk-python/tests/digests.json", import.meta.url);
  assert.equal(module.digests(), readFileSync(stored, "utf8"));
});
