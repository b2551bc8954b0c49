/** What the notes of the presets say, computed by the module of the page. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { asker, sourceOf } from "./module.mjs";

const { PRESETS, stateOf } = await sourceOf("presets.ts");
const presets = new Map(PRESETS.map((preset) => [preset.id, preset]));
const { ask, motion } = asker();

/** The note of a preset, and the states of its panels by the beginnings of their labels. */
function preset(id) {
  const { text, panels } = presets.get(id);
  const state = (label) => {
    const panel = panels.find((one) => one.label.startsWith(label));
    assert.ok(panel, `${id} has no panel ${label}`);
    return stateOf(panel);
  };
  const says = (words) => assert.ok(text.includes(words), `${words}: ${text}`);
  return { state, states: () => panels.map(stateOf), says };
}

const thrown = async (state) => (await motion(state)).separation.angular_speed;

/** The number of the sample with the largest size of a quantity. */
const fastest = (samples, column) => {
  const sizes = samples.map((sample) => Math.abs(sample[column]));
  return sizes.indexOf(Math.max(...sizes));
};

const largest = (samples, column) => Math.max(...samples.map((sample) => sample[column]));

test("Fig. 2: the lag parts turning from rising, and (f) does not throw", async () => {
  const { state } = preset("fig02");
  const apart = async (label) => {
    const { samples } = await motion(state(label), 1);
    // Both are fastest twice in a period of 64 samples.
    const steps = Math.abs(fastest(samples, "platform_angular_speed") - fastest(samples, "platform_velocity")) % 32;
    return Math.min(steps, 32 - steps);
  };
  assert.ok((await apart("(c)")) <= 1);
  assert.ok((await apart("(a)")) >= 15);
  assert.equal((await motion(state("(f)"))).separation, undefined);
  for (const label of ["(a)", "(b)", "(c)", "(d)"]) assert.ok((await motion(state(label))).separation, label);
});

test("Fig. 3: the events of the inset, in this order", async () => {
  const { events } = await motion(preset("fig03").state("chattering"));
  const kinds = events.map(({ kind }) => kind).join(" ");
  assert.match(kinds, /separation( impact)+ .*attach.*separation/i, kinds.slice(0, 300));
});

test("Fig. 4: the fastest toss, and θ = 0 is best", async () => {
  const { state, says } = preset("fig04");
  const best = await thrown(state("φ_L = 0.301π"));
  says(`printed ${best.toFixed(0)} rad/s`);
  const printed = await thrown(state("φ_L = 0.323π"));
  says(`${printed.toFixed(1)} rad/s`);
  for (const label of ["θ = π/4", "θ = π/2"]) assert.ok((await thrown(state(label))) < printed, label);
  for (const angle of [0.29, 0.296, 0.306, 0.312]) {
    const { system, start } = state("φ_L = 0.301π");
    const other = { ...system, set: [["amplitude_angle", angle * Math.PI]] };
    assert.ok((await thrown({ system: other, start })) < best, `${angle}`);
  }
});

test("Fig. 5: high and hardly turning, low and fast, turned back", async () => {
  const { state } = preset("fig05");
  const tosses = {};
  for (const panel of ["(a)", "(b)", "(c)"]) {
    for (const lag of ["0", "π/2"]) tosses[panel + lag] = await motion(state(`${panel} θ = ${lag}`));
  }
  const height = (name) => largest(tosses[name].samples, "height");
  const twist = (name) => largest(tosses[name].samples, "platform_angle");
  assert.ok(height("(a)0") > height("(b)0") && height("(b)0") > height("(c)0"));
  assert.ok(twist("(a)0") < twist("(b)0") && twist("(b)0") < twist("(c)0"));
  // With the lag of a quarter period the hand is past the end of its turn when the dough leaves it.
  for (const panel of ["(a)", "(b)", "(c)"]) {
    const { separation, samples } = tosses[`${panel}π/2`];
    if (separation === undefined) continue;
    const at = samples.findIndex(({ time }) => time >= separation.time);
    assert.ok(samples[at].platform_angular_speed < 0, panel);
  }
});

test("Fig. 6: doublings and the crisis", async () => {
  const { says } = preset("fig06");
  const { json } = await ask({ call: "branches", restitution: 0.5, axial_forcing: [0.3, 0.65] });
  const doublings = json.bifurcations.filter(({ kind }) => kind === "doubling").slice(0, 3);
  says(doublings.map(({ axial_forcing }) => axial_forcing.toFixed(3)).join(", "));
  // The last attractor beside rest, chaotic by then, is lost between these.
  const lasting = async (axial_forcing) => {
    const found = await ask({ call: "attractors", map: { axial_forcing, restitution: 0.5 } });
    return found.json.attractors.filter(({ lasts, kind }) => lasts && kind === "chaotic").length;
  };
  says("near 0.561");
  assert.deepEqual([await lasting(0.5605), await lasting(0.5615)], [1, 0]);
});

test("Fig. 7: the basin grows to the doubling, and is gone beyond the crisis", async () => {
  const { states } = preset("fig07");
  const shares = [];
  for (const { system } of states()) {
    const { json } = await ask({ call: "attractors", map: system });
    const resting = json.attractors.filter(({ kind, lasts }) => kind === "rest" && lasts);
    shares.push(1 - resting.reduce((sum, { share }) => sum + share, 0));
  }
  const [first, doubling, , , last] = shares;
  assert.ok(first < doubling, `${shares}`);
  assert.ok(Math.abs(last) < 1e-12, `${shares}`);
});

test("Fig. 9: how long the rotor takes to stop", async () => {
  const { states, says } = preset("fig09");
  const stops = async (state) => (await motion(state, 60)).samples.find((one) => Math.abs(one.angular_speed) < 1e-3).time;
  const [first, second, third] = (await Promise.all(states().map(stops))).map((time) => time.toFixed(1));
  says(`${first}, ${second} and ${third} s`);
});

const sheetOf = async ({ system, mass }) => (await ask({ call: "sheet_of_system", system, mass })).json.sheet;

const report = async (state) => (await ask({ call: "motor_report", sheet: await sheetOf(state) })).json;

/** Stall torque and speed without load of a motor, to some percent; several notes speak of the same motor. */
const stalls = new Map();
async function stall(state) {
  const sheet = await sheetOf(state);
  const request = { call: "motor_stall", sheet, relative_error: 0.05, seed: 1 };
  const key = JSON.stringify(request);
  if (!stalls.has(key)) stalls.set(key, (await ask(request)).json);
  return stalls.get(key);
}

test("Figs. 10 and 12: no trap that a preload can meet", async () => {
  const fig10 = preset("fig10").state;
  for (const label of ["(a)", "(b)", "(c)"]) assert.notEqual((await report(fig10(label))).trap?.relative_distance, 0, label);
  // Of the short cycles that stand next to the printed amplitude none is wide enough to be shown.
  assert.equal((await report(preset("fig12").state("(d)"))).trap, null);
});

test("Fig. 10: (a) does not rise on a straight line, and stops abruptly", async () => {
  const { state, says } = preset("fig10");
  const [sheet, points] = [await sheetOf(state("(a)")), 160];
  const request = { call: "motor_transient", sheet, members: 4, rise_times: 6, points, seed: 1 };
  const { numbers } = await ask(request);
  const at = (row) => ({ time: numbers[3 * row], speed: numbers[3 * row + 1] });
  const slope = (from, to) => (at(to).speed - at(from).speed) / (at(to).time - at(from).time);
  const last = at(points - 1).speed;
  let kink = 0;
  while (at(kink).speed < 0.99 * last) kink += 1;
  says(`from ${slope(0, 8).toFixed(0)} to ${slope(kink - 8, kink).toFixed(0)} rad/s²`);
  says(`stays at ${last.toFixed(1)} rad/s`);
  assert.ok(Math.abs(slope(kink + 8, kink + 16)) < 0.1, "it stays there at once");
});

test("Fig. 11: the torque follows the preload, the speed does not", async () => {
  const { state, says } = preset("fig11");
  const ratios = [];
  for (const frequency of ["184 kHz", "70 kHz"]) {
    const high = await stall(state(`280 mN, ${frequency}`));
    const low = await stall(state(`80 mN, ${frequency}`));
    ratios.push((high.torque / low.torque).toFixed(1));
    for (const { no_load_speed } of [high, low]) says(`about ${no_load_speed.toFixed(0)} rad/s`);
  }
  says(`by a factor of ${(280 / 80).toFixed(1)} and the stall torque by ${ratios[0]} to ${ratios[1]},`);
});

test("Fig. 13: what moves the torque and what the speed", async () => {
  const { state } = preset("fig13");
  const of = (label) => stall(state(label));
  const base = await of("default");
  const same = (a, b, error) => Math.abs(a / b - 1) < Math.max(0.03, (3 * error) / b);
  const friction = await of("(a)");
  assert.ok(friction.torque > 1.8 * base.torque, "friction sets the torque");
  assert.ok(same(friction.no_load_speed, base.no_load_speed, base.no_load_speed_error), "and not the speed");
  const speed = await of("(e)");
  assert.ok(speed.no_load_speed < 0.55 * base.no_load_speed, "the platform's speed sets the rotor's");
  assert.ok(same(speed.torque, base.torque, base.torque_error), "and not the torque");
  for (const label of ["(b) ε = 0.7", "(c)"]) {
    const { torque, no_load_speed } = await of(label);
    assert.ok(!same(torque, base.torque, base.torque_error), `${label}: torque`);
    assert.ok(!same(no_load_speed, base.no_load_speed, base.no_load_speed_error), `${label}: speed`);
  }
});

test("Tables I and II: the speed of the toss, and what it depends on", async () => {
  const base = await thrown(preset("table1").state("Table I"));
  preset("table1").says(`${base.toFixed(0)} rad/s`);
  const { state } = preset("table2");
  const change = async (label) => Math.abs((await thrown(state(label))) - base);
  const large = [await change("c +"), await change("ω +"), await change("φ_L +")];
  const little = await change("a_e +");
  const hardly = [await change("a_g +"), await change("μ +")];
  assert.ok(Math.min(...large) > 1.5 * little, `${large} ${little}`);
  assert.ok(Math.max(...hardly) < 0.05 * little, `${hardly} ${little}`);
});

test("Table III: both readings", async () => {
  const { state, says } = preset("table3");
  const [gravity, printed] = [await stall(state("70 kHz")), await stall(state("g ="))];
  says(`${(100 * (printed.no_load_speed / gravity.no_load_speed - 1)).toFixed(0)} %`);
});
