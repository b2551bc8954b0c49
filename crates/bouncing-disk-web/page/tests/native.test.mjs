/** The answers in the browser have the bits of the native library: the same requests, put to both. */

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";
import { isFake, launch, opened, settled } from "./browser.mjs";

/** The program `respond` of the crate, compiled for this machine. */
const native = process.env.NATIVE_RESPOND;

/** Keeps what every worker is asked and what it answers, before the page begins. */
function listen() {
  const heard = [];
  window.heard = heard;
  const Original = window.Worker;
  window.Worker = class extends Original {
    constructor(...given) {
      super(...given);
      const asked = new Map();
      const post = this.postMessage.bind(this);
      this.postMessage = (message, ...rest) => {
        if (message.kind === "ask") asked.set(message.id, message.request);
        post(message, ...rest);
      };
      this.addEventListener("message", ({ data }) => {
        if (data.kind !== "answer" && data.kind !== "refused") return;
        heard.push({ request: asked.get(data.id), kind: data.kind, digest: data.digest ?? null, json: data.json });
      });
    }
  };
}

/** What is asked in each view, and by each preset, as far as it is answered in some seconds. */
async function conversation(browser) {
  const { page, context, errors } = await opened(browser, { init: listen });
  const ids = await page.evaluate(() => window.explorer.presets());
  for (const id of ids) {
    await page.evaluate((preset) => window.explorer.open(preset), id);
    await settled(page);
  }
  const heard = await page.evaluate(() => window.heard);
  assert.deepEqual(errors, []);
  await context.close();
  return { heard, ids };
}

test("every answer of every preset has the digest of the native library", { skip: isFake || !native }, async () => {
  const browser = await launch();
  try {
    const { heard, ids } = await conversation(browser);
    assert.ok(ids.length >= 17, `${ids.length} presets`);
    assert.ok(heard.length > 100, `${heard.length} answers`);
    const input = heard.map(({ request }) => request).join("\n") + "\n";
    const { stdout, status } = spawnSync(native, { input, encoding: "utf8", maxBuffer: 1 << 30 });
    assert.equal(status, 0);
    const lines = stdout.trimEnd().split("\n");
    assert.equal(lines.length, heard.length);
    const calls = new Set();
    for (const [index, { request, kind, digest, json }] of heard.entries()) {
      calls.add(JSON.parse(request).call);
      const [word, own] = lines[index].split(" ", 2);
      if (kind === "refused") {
        assert.equal(word, "refused", request);
        assert.ok(lines[index].endsWith(json), request);
      } else {
        assert.equal(`${word} ${own}`, `answered ${digest}`, request);
      }
    }
    for (const call of ["check", "motion", "diagram", "branches", "attractors", "basins", "motor_report", "motor_loads"]) {
      assert.ok(calls.has(call), `${call} was not asked`);
    }
  } finally {
    await browser.close();
  }
});
