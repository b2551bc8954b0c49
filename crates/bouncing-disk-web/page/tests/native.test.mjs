/** The answers in the browser have the bits of the native library: the same requests, put to both. */

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { test } from "node:test";
import { promisify } from "node:util";
import { isCalm, within } from "./browser.mjs";
import { asker, sourceOf } from "./module.mjs";

/** The program `respond` of the crate, compiled for this machine. */
const native = process.env.NATIVE_RESPOND;
/** How long (ms) a state may take until all that its view asks for is answered. */
const PATIENCE = 180_000;

/** Keeps what every worker is asked and what it answers, before the page begins. */
function listen() {
  Object.assign(window, { heard: [], open: new Map(), shown: false, quiet: 0 });
  const Original = window.Worker;
  window.Worker = class extends Original {
    postMessage(message, ...rest) {
      super.postMessage(message, ...rest);
      if (message.request === undefined) return;
      window.open.set(this, message.request);
      const hear = ({ data }) => {
        window.open.delete(this);
        const answer = `${data.refused ? "refused" : "answered"} ${data.digest}`;
        window.heard.push({ request: message.request, answer });
        window.quiet = performance.now();
        // What the page asks last of a state before it shows it.
        if (message.request.includes('"samples_per_period":2}')) window.shown = true;
      };
      this.addEventListener("message", hear, { once: true });
    }

    terminate() {
      window.open.delete(this);
      super.terminate();
    }
  };
}

/**
 * Whether the state of the address is shown and its view has all that it asks for: for longer than views wait before they
 * begin. Of a motor the run-up and the rough curve, where not `all` is waited for.
 */
function isAnswered(all) {
  const motor = document.querySelector("#view-motor:not([hidden]) .facts");
  const rough = !all && /Steady speed[^…]/.test(motor?.textContent ?? "");
  if (!window.shown || window.open.size > 0 || document.getElementById("status").dataset.kind === "busy") {
    window.quiet = performance.now();
  }
  return window.shown && (rough || performance.now() - window.quiet > 500);
}

/** Every panel of every figure and table, and each view as the page begins with it, by their hashes. */
async function statesToShow() {
  const { PRESETS, stateOf } = await sourceOf("presets.ts");
  const { changed, DEFAULT_STATE, toHash, VIEW_NAMES } = await sourceOf("state.ts");
  assert.equal(PRESETS.length, 17);
  const rotation = { view: "diagram", diagram: { quantity: "angular_speed" } };
  const soft = ["toss", "diagram"].map((view) => ({ view, system: { contact_time: 0.03 } }));
  const views = [...VIEW_NAMES.map((view) => ({ view })), rotation, ...soft];
  const panels = PRESETS.flatMap(({ id, panels }) => panels.map((panel) => [`${id} ${panel.label}`, stateOf(panel)]));
  const states = [...views.map((change) => [change.view, changed(DEFAULT_STATE, change)]), ...panels];
  return states.map(([name, state]) => ({ name, hash: toHash(state) }));
}

/** What no figure asks for: every regime of flights, drives, contacts and stators, up to the limits of the page. */
async function requestsBeyond(ask) {
  const { PRESETS, stateOf } = await sourceOf("presets.ts");
  const { system: rotor } = stateOf(PRESETS.find(({ id }) => id === "table3").panels[0]);
  const { sheet } = (await ask({ call: "sheet_of_system", system: rotor, mass: 1e-3 })).json;
  const { system } = (await sourceOf("state.ts")).DEFAULT_STATE;
  const start = { impact_phase: 1.2, normalised_speed: 1.3 };
  const grid = { count: 200, columns: [0, 200], start, transient: 500, recorded: 20 };
  const diagram = (axial_forcing, changes, rest = {}) => {
    return { call: "diagram", system: { ...system, ...changes }, axial_forcing, ...grid, ...rest };
  };
  const spin = { kind: "impact", ...start, angular_speed: 3 };
  const turning = { call: "motion", start: spin, periods: 100, samples_per_period: 7 };
  const axes = { phase_periods: [0, 1], phases: 200, normalised_speed: [0, 3], speeds: 150, rows: [0, 150] };
  const modes = { mass: 0.05, quality: 300 };
  const two = { ...modes, kind: "axial_and_torsional", inertia: 1e-6, torsional_quality: 100, resonance: 70.1e3 };
  const stators = [
    { twist_amplitude: null, stator: { ...modes, kind: "axial_twist", twist_per_height: 700 } },
    { stator: two, contact: { time: 1e-5 } },
  ];
  const loads = { call: "motor_loads", load_torques: [0, 1e-5], relative_error: 0.3, most_impacts: 8000, seed: 1 };
  const forcings = Array.from({ length: 40 }, (_, index) => 0.2 + 0.0125 * index);
  return [
    ...[0, 0.3, 0.9, 0.999].map((restitution) => diagram([0.05, 100], { restitution })),
    ...["triangle", "parabolas", "cubics", { sawtooth: 0.3 }].map((drive) => diagram([0.3, 2], {}, { drive })),
    ...[1e-3, 0.3].map((contact_time) => diagram([0.3, 2], { contact_time })),
    diagram([0.3, 20], {}, { rotation: true }),
    ...[0.1, 0.5, 0.99].map((restitution) => ({ ...turning, system: { ...system, restitution } })),
    { ...turning, system: { ...system, contact_time: 0.03 } },
    ...forcings.map((axial_forcing) => ({ call: "orbit", map: { axial_forcing, restitution: 0.5 }, start })),
    ...[0.1, 0.9].map((restitution) => ({ call: "branches", restitution, axial_forcing: [0.03, 2] })),
    { call: "basins", map: { axial_forcing: 0.45, restitution: 0.5 }, ...axes },
    ...stators.map((own) => ({ ...loads, sheet: { ...sheet, amplitude: 1e-7, ...own } })),
  ];
}

const CALLS = [
  "attractors", "basins", "branches", "check", "diagram", "motion", "motor_loads", "motor_report", "motor_stall",
  "motor_transient", "orbit", "sheet_of_system", "toss",
]; // prettier-ignore
const TITLE = "every answer in every figure and table, and beyond, has the digest of the native library";

test(TITLE, { skip: !native }, async (t) => {
  const heard = new Map();
  // It answers each line while the page goes on.
  const answers = promisify(execFile)(native, { maxBuffer: 1e9 });
  t.after(() => answers.child.kill());
  const hear = (request, answer, name) => {
    assert.match(answer, /^answered/, `${name}: ${request}`);
    assert.equal(heard.get(request) ?? answer, answer, `two answers to ${request}`);
    if (!heard.has(request)) answers.child.stdin.write(`${request}\n`);
    heard.set(request, answer);
  };
  await within({ width: 900, height: 700, script: listen, settle: false }, async (page) => {
    for (const { name, hash } of await statesToShow()) {
      await page.evaluate((to) => {
        window.shown = location.hash === to;
        location.hash = to;
      }, hash);
      // A whole curve and its stall load take a motor of frequent impacts a minute; that of Fig. 10(c) has few.
      const all = name.startsWith("fig10 (c)");
      await page.waitForFunction(isAnswered, all, { timeout: PATIENCE }).catch(() => assert.fail(`${name} waits`));
      for (const { request, answer } of await page.evaluate(() => window.heard.splice(0))) hear(request, answer, name);
      await isCalm(page);
    }
  });
  const calls = new Set([...heard.keys()].map((request) => JSON.parse(request).call));
  assert.deepEqual([...calls].sort(), CALLS);
  const { ask } = asker();
  for (const request of await requestsBeyond(ask))
    hear(JSON.stringify(request), `answered ${(await ask(request)).digest}`, "beyond");
  answers.child.stdin.end();
  const own = (await answers).stdout.trim().split("\n");
  assert.equal(own.length, heard.size);
  [...heard].forEach(([request, answer], index) => assert.ok(own[index].startsWith(`${answer} `), request));
});
