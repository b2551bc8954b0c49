/** The answers in the browser have the bits of the native library: the same requests, put to both. */

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";
import { setTimeout as pause } from "node:timers/promises";
import { test } from "node:test";
import { within } from "./browser.mjs";
import { sourceOf } from "./module.mjs";

/** The program `respond` of the crate, compiled for this machine. */
const native = process.env.NATIVE_RESPOND;
/** How long (ms) a state may take until all that its view asks for is answered. */
const PATIENCE = 60_000;

/** Keeps what every worker is asked and what it answers, before the page begins. */
function listen() {
  window.heard = [];
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
        const answer = data.kind === "answer" ? `answered ${data.digest}` : `refused ${data.json}`;
        window.heard.push({ request: asked.get(data.id), answer, json: data.json });
      });
    }
  };
}

/** The native library, which answers each line while the page goes on. */
function library() {
  const child = spawn(native, { stdio: ["pipe", "pipe", "inherit"] });
  const ended = once(child, "close");
  const lines = [];
  createInterface({ input: child.stdout }).on("line", (line) => lines.push(line));
  return {
    ask: (request) => child.stdin.write(`${request}\n`),
    /** All answers, each as the page's are kept: the digest, or the sentence of a refusal. */
    async end() {
      child.stdin.end();
      assert.deepEqual(await ended, [0, null]);
      return lines.map((line) => {
        const [, word, digest, json] = /^(\w+) (\w+) (.*)$/.exec(line);
        return word === "answered" ? `answered ${digest}` : `refused ${json}`;
      });
    },
  };
}

/** Whether ranges such as `[0, 32)`, `[32, 40)` cover all of `[0, count)`. */
function covered(ranges, count) {
  let end = 0;
  const sorted = [...ranges].sort(([first], [second]) => first - second);
  for (const [from, to] of sorted) if (from <= end) end = Math.max(end, to);
  return end >= count;
}

/** Requests of one picture by their resolution, which the view makes from the size of its plot. */
function byResolution(requests, name) {
  const pictures = new Map();
  for (const request of requests) pictures.set(request[name], [...(pictures.get(request[name]) ?? []), request]);
  return [...pictures.values()];
}

const ranges = (requests, name) => requests.map((request) => request[name]);

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
const forcingOf = ({ amplitude, angular_frequency, preload_acceleration }) =>
  (amplitude * angular_frequency ** 2) / (Math.PI * preload_acceleration);

/** What a view asks for in this state and what is not among these answered requests, in words. */
const MISSING = {
  toss({ system, start }, of) {
    const impact = { kind: "impact", ...start };
    const motions = of("motion").filter((one) => same([one.system, one.start], [system, impact]) && one.periods >= 20);
    return [motions.length === 0 && "the motion", ...verdict(system, of)];
  },
  diagram({ system, start, diagram }, of) {
    const rotation = diagram.quantity === "angular_speed";
    const { angular_speed: _, ...impact } = start;
    const key = (one) => [one.start, one.axial_forcing, one.system.restitution, rotation && one.system];
    const wanted = key({ ...diagram, start: impact, system });
    const columns = of("diagram").filter((one) => (one.rotation || !rotation) && same(key(one), wanted));
    const pictures = byResolution(columns, "count");
    const whole = pictures.filter((picture) => covered(ranges(picture, "columns"), picture[0].count));
    const window = [system.restitution, diagram.axial_forcing];
    const branches = of("branches").some((one) => same([one.restitution, one.axial_forcing], window));
    return [
      // Rotating disks take longer, and have a coarse picture first.
      whole.length < (rotation ? 2 : 1) && `the columns (${whole.length} of ${pictures.length} pictures are whole)`,
      !rotation && diagram.branches && !branches && "the branches",
    ];
  },
  basins({ system, basins }, of) {
    const map = [forcingOf(system), system.restitution];
    const here = (one) => same([one.axial_forcing, one.restitution], map);
    const window = [basins.phase_periods, basins.normalised_speed];
    const cells = of("basins").filter((one) => here(one) && same([one.phase_periods, one.normalised_speed], window));
    const pictures = byResolution(cells, "speeds");
    const whole = pictures.filter((picture) => covered(ranges(picture, "rows"), picture[0].speeds));
    return [
      !of("attractors").some(here) && "the attractors",
      whole.length < 2 && "the coarse and the fine cells",
      ...verdict(system, of),
    ];
  },
  motor({ system, mass }, of, all) {
    const read = of("sheet_of_system").find((one) => same([one.system, one.mass], [system, mass]));
    if (read === undefined) return ["the sheet"];
    const asked = (call) => of(call).filter((one) => same(one.sheet, read.answered.sheet));
    const loads = asked("motor_loads").length;
    const wanted = all ? 2 : 1;
    return [
      ...["sheet_write", "motor_report", "motor_transient", ...(all ? ["motor_stall"] : [])].filter(
        (call) => asked(call).length === 0,
      ),
      loads < wanted && `${loads} of ${wanted} curves`,
    ];
  },
};

/** What a disk does after a rest: the toss and the basins say so where rounding decides it. */
function verdict(system, of) {
  const map = [forcingOf(system), system.restitution];
  const found = of("orbit").some((one) => same([one.axial_forcing, one.restitution], map));
  return [!found && "the verdict on a disk at rest"];
}

/** The words for what is missing; every state is checked, too. */
function missing(state, requests, all) {
  const of = (call) => requests.filter((one) => one.call === call);
  const checked = of("check").some((one) => same(one.system, state.system));
  return [!checked && "the check", ...MISSING[state.view](state, of, all)].filter(Boolean);
}

/** Every panel of every figure and table, and each view as the page begins with it. */
async function statesToShow() {
  const { PRESETS, stateOf } = await sourceOf("presets.ts");
  const { changed, DEFAULT_STATE, toHash, VIEW_NAMES } = await sourceOf("state.ts");
  const panels = PRESETS.flatMap((preset) =>
    preset.panels.map((panel) => ({ name: `${preset.id} ${panel.label}`, state: stateOf(panel) })),
  );
  const views = VIEW_NAMES.map((view) => ({ name: view, state: changed(DEFAULT_STATE, { view }) }));
  const rotation = changed(DEFAULT_STATE, { view: "diagram", diagram: { quantity: "angular_speed" } });
  const states = [...views, { name: "diagram of angular speeds", state: rotation }, ...panels];
  return { presets: PRESETS, states: states.map((one) => ({ ...one, hash: toHash(one.state) })) };
}

/** Shows a state and waits until all that its view asks for has been answered. */
async function show(page, { name, state, hash }, conversation, all) {
  await page.evaluate((to) => (location.hash = to), hash);
  const end = Date.now() + PATIENCE;
  let still;
  do {
    await pause(30);
    conversation.take(await page.evaluate(() => window.heard.splice(0)));
    still = missing(state, conversation.requests, all);
  } while (still.length > 0 && Date.now() < end);
  assert.deepEqual(still, [], `${name} waits for an answer`);
}

const TITLE = "every answer in every figure and table has the digest of the native library";

test(TITLE, { skip: !native }, async () => {
  const { presets, states } = await statesToShow();
  assert.equal(presets.length, 17);
  const heard = new Map();
  const requests = [];
  const answers = library();
  const take = (pairs) => {
    for (const { request, answer, json } of pairs) {
      assert.equal(heard.get(request) ?? answer, answer, `two answers to ${request}`);
      if (heard.has(request)) continue;
      heard.set(request, answer);
      requests.push({ ...JSON.parse(request), answered: JSON.parse(json) });
      answers.ask(request);
    }
  };
  await within({ width: 900, height: 700, script: listen }, async (page) => {
    // A whole curve and its stall load take a motor of frequent impacts a minute; that of Fig. 10(c) has few.
    for (const one of states) await show(page, one, { requests, take }, one.name.startsWith("fig10 (c)"));
  });
  const own = await answers.end();
  assert.equal(own.length, heard.size);
  [...heard].forEach(([request, answer], index) => assert.equal(own[index], answer, request));
});
