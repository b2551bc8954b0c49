/** The answers in the browser have the bits of the native library: the same requests, put to both. */

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { test } from "node:test";
import { address, isFake, launch, ready, settled } from "./browser.mjs";

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

/** States that have every view ask for what it shows, of the system that the page begins with. */
const HASHES = [
  "#view=toss",
  "#view=diagram",
  "#view=diagram&diagram_quantity=angular_speed",
  "#view=basins",
  "#view=motor",
];

/** What is asked for, and what is answered. */
async function conversation(browser) {
  const all = [];
  for (const hash of HASHES) {
    const context = await browser.newContext({ viewport: { width: 900, height: 700 } });
    await context.addInitScript(listen);
    const page = await context.newPage();
    const errors = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    await page.goto(address + hash);
    await ready(page);
    await settled(page);
    // The motor's curve comes after its report, and the view is of use before it is whole.
    if (hash.endsWith("motor")) {
      await page.waitForFunction(() => window.heard.some(({ request }) => request.includes('"motor_loads"')));
    }
    assert.deepEqual(errors, []);
    all.push(...(await page.evaluate(() => window.heard)));
    await context.close();
  }
  return all;
}

test("every answer in every view has the digest of the native library", { skip: isFake || !native }, async () => {
  const browser = await launch();
  try {
    const heard = await conversation(browser);
    assert.ok(heard.length > 30, `${heard.length} answers`);
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
