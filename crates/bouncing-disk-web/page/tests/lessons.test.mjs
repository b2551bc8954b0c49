/** What the lessons and the tour say, computed by the module of the page. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { asker, sourceOf, WORDS } from "./module.mjs";

const { COURSES } = await sourceOf("courses.ts");
const { told } = await sourceOf("words.ts");
const { ask, motion } = asker();

/** A step by the order in which it comes: its state, and what it says, of which all `words` have to be a part. */
function step(id, number) {
  const { state, text, answer = "" } = COURSES.find((one) => one.id === id).steps[number - 1];
  const says = (...words) => {
    for (const one of words) assert.ok(`${text} ${answer}`.includes(one), `${one}: ${text} ${answer}`);
  };
  return { state, says };
}

/** The map of a state, or of its platform at another forcing. */
const mapOf = ({ system }, axial_forcing) => (axial_forcing ? { axial_forcing, restitution: system.restitution } : system);

const orbitOf = async (state, forcing, { impact_phase, normalised_speed } = state.start) =>
  (await ask({ call: "orbit", map: mapOf(state, forcing), start: { impact_phase, normalised_speed } })).json;

const attractorsOf = async (state) => (await ask({ call: "attractors", map: state.system })).json.attractors;

/** The labels of the cells of a window. */
async function cellsOf(state) {
  const [phases, speeds] = [200, 100];
  return (await ask({ call: "basins", map: state.system, ...state.basins, phases, speeds, rows: [0, speeds] })).bytes;
}

/** The first separation of a motion. */
const thrown = async ({ system, start }, change = {}) =>
  (await motion({ system: { ...system, ...change }, start }, 3)).separation;

test("what a lesson names stands on the page", () => {
  const strings = (one) => (typeof one === "string" ? [one] : Object.values(one).flatMap(strings));
  const { courses, ...others } = WORDS;
  const page = readFileSync(new URL("../index.html", import.meta.url), "utf8");
  const known = new Set([...strings(others), ...[...page.matchAll(/>([^<>]+)<\/button>/g)].map(([, name]) => name)]);
  for (const [, name] of strings(courses).join().matchAll(/“(.*?)”/g)) assert.ok(known.has(name), name);
});

test("tour: the third attractor of the plane of starts", async () => {
  const { state, says } = step("tour", 5);
  const third = (await attractorsOf(state))[2];
  assert.equal(told(third.text), "periodic orbit: 4 impacts in 2 periods");
  const cells = await cellsOf(state);
  const share = cells.filter((label) => label === third.label).length / cells.length;
  says(`a third attractor of 4 impacts in 2 periods, which attracts ${(100 * share).toFixed(0)} % of these starts`);
});

test("doubling: period one, period two, and the multiplier between them", async () => {
  const { state, says } = step("doubling", 3);
  for (const [number, impacts] of [[1, 1], [2, 1], [4, 2]])
    assert.equal((await orbitOf(step("doubling", number).state)).impacts, impacts, `${number}`);
  assert.equal((await orbitOf(step("doubling", 2).state, 0.5)).impacts, 2);
  const { json } = await ask({ call: "branches", restitution: 0.5, axial_forcing: state.diagram.axial_forcing });
  const [{ axial_forcing }] = json.bifurcations.filter(({ kind }) => kind === "doubling");
  says(`At Γ = ${axial_forcing.toFixed(3)}.`, "−1 there");
  for (const [forcing, words] of [[0.484, "1 impact per period"], [0.488, "2 impacts in 2 periods"]]) {
    assert.ok(told((await orbitOf(state, forcing)).text).startsWith(words), words);
    says(words);
  }
  for (const forcing of [0.48, 0.485]) {
    const [[least]] = (await orbitOf(state, forcing)).multipliers;
    says(`−${(-least).toFixed(2)} at Γ = ${forcing}`);
    if (forcing === 0.48) step("doubling", 4).says(`−${(-least).toFixed(2)}`, `${(100 * (1 + least)).toFixed(0)} %`);
  }
}); // prettier-ignore

test("Feigenbaum: five doublings, their ratios, and where they lead", async () => {
  const doublings = async (number) => {
    const { axial_forcing } = step("feigenbaum", number).state.diagram;
    const { json } = await ask({ call: "branches", restitution: 0.5, axial_forcing });
    return json.bifurcations.filter(({ kind }) => kind === "doubling").map((one) => one.axial_forcing);
  };
  const found = await doublings(1);
  assert.equal(found.length, 5, "the page follows the first five");
  assert.deepEqual(await doublings(2), found.slice(3));
  const name = (index) => `Γ${"₁₂₃₄₅"[index]}`;
  found.forEach((one, index) => step("feigenbaum", 1).says(`${name(index)} = ${one.toFixed(4)}`));
  found.slice(2).forEach((one, index) => step("feigenbaum", 2).says(`${name(index + 2)} = ${one.toFixed(6)}`));
  // As a reader has them, with six digits.
  const read = found.map((one) => Number(one.toFixed(6)));
  const steps = read.slice(1).map((one, index) => one - read[index]);
  const ratios = steps.slice(1).map((one, index) => steps[index] / one);
  const [first, second, third] = ratios.map((one) => one.toFixed(2));
  step("feigenbaum", 2).says(`ratio is ${third}`, `before it are ${first} and ${second}`);
  const limit = read[4] + steps[3] / 3.669;
  const { state, says } = step("feigenbaum", 3);
  says(`Our ${third} is below it by less than 1 %`);
  // Six digits leave the last ratio open by so much.
  const slack = ratios[2] * (1e-6 / steps[3] + 1e-6 / steps[2]);
  const [least, most] = [-slack, slack].map((error) => (ratios[2] + error) / 4.669);
  assert.ok(least > 0.99 && most < 1, `${least} to ${most}`);
  says(`${read[4].toFixed(6)} + ${steps[3].toFixed(6)}/3.669 = ${limit.toFixed(6)}`);
  assert.equal((await orbitOf(state, 0.5426)).impacts, 32);
  assert.equal((await orbitOf(state)).kind, "chaotic");
});

test("rest: two attractors, and slow starts of only one of them", async () => {
  const { state } = step("rest", 1);
  const [rest, orbit, ...others] = await attractorsOf(state);
  assert.deepEqual([rest.kind, orbit.kind, others], ["rest", "periodic", []]);
  const share = (cells) => cells.filter((label) => label === rest.label).length / cells.length;
  assert.ok(Math.abs(share(await cellsOf(state)) - 2 / 3) < 0.03);
  assert.equal(share(await cellsOf(step("rest", 2).state)), 1);
  const flight = step("rest", 3);
  const { phase } = await thrown(flight.state);
  assert.ok(Math.abs(Math.sin(phase) - 1 / (0.45 * Math.PI)) < 1e-9);
  flight.says(Math.sin(phase).toFixed(3));
  const pushed = await orbitOf(step("rest", 4).state, 0.45, { impact_phase: 0.4, normalised_speed: 1.4 });
  assert.equal(pushed.impacts, 1);
});

test("hand: the speeds of the tosses", async () => {
  const spin = async (state, change) => `${(await thrown(state, change)).angular_speed.toFixed(1)} rad/s`;
  step("hand", 1).says(await spin(step("hand", 1).state));
  const [lag, angle] = [2, 3].map((number) => step("hand", number));
  const fastest = async ({ system, start, scan: { range, points } }, change) => {
    let most = { angular_speed: -Infinity };
    for (let point = 0; point < points; point += 1) {
      const at = range[0] + (point * (range[1] - range[0])) / (points - 1);
      // A hand that only twists does not throw.
      const { angular_speed = NaN } = (await thrown({ system, start }, change(at))) ?? {};
      if (angular_speed > most.angular_speed) most = { angular_speed, at };
    }
    return { ...most, points, text: `${most.angular_speed.toFixed(2)} rad/s` };
  };
  const printed = await fastest(lag.state, (phase_lag) => ({ phase_lag }));
  const { angular_speed } = await thrown(lag.state, { phase_lag: 0.04 * Math.PI });
  assert.ok(Math.abs(angular_speed - printed.angular_speed) < 1e-9, `${angular_speed}`);
  lag.says(`for ${printed.points} lags`, `Of these ${printed.points} lags θ = ${Number(printed.at.toFixed(9))} is`, `with ${printed.text}`);
  const at = (phase_lag) => (own) => ({ phase_lag, set: [["amplitude_angle", own]] });
  const lags = angle.state.scan.values;
  const found = await Promise.all(lags.map((phase_lag) => fastest(angle.state, at(phase_lag))));
  const [best] = [...found].sort((one, other) => other.angular_speed - one.angular_speed);
  assert.equal(lags[found.indexOf(best)], 0);
  angle.says(`${best.text} at φ_L = ${best.at.toFixed(3)} (${(best.at / Math.PI).toFixed(3)}π)`);
  const { amplitude_angle } = (await ask({ call: "check", system: angle.state.system, mass: 1 })).json;
  angle.says(`Table I has φ_L = ${(amplitude_angle / Math.PI).toFixed(3)}π`);
  angle.says(`0.323π = ${(0.323 * Math.PI).toFixed(3)}`, `than the ${printed.text}`);
}); // prettier-ignore

test("motor: what the sheet, the run-up and the curve say", async () => {
  const reads = async (number) => {
    const { system, mass } = step("motor", number).state;
    const { sheet } = (await ask({ call: "sheet_of_system", system, mass })).json;
    const report = (await ask({ call: "motor_report", sheet })).json;
    const stall = (await ask({ call: "motor_stall", sheet, relative_error: 0.02, seed: 1 })).json;
    const run = { call: "motor_transient", sheet, members: 16, rise_times: 6, points: 160, seed: 1 };
    const { value } = (await ask(run)).json.rise.constant;
    return { sheet, report, stall, value, steady: stall.no_load_speed };
  };
  const { sheet, report, stall, value, steady } = await reads(1);
  const largest = report.largest_torque;
  assert.ok(Math.abs(0.1 * 0.0329 * 9.8 * 1.25e-3 - largest) < 1e-3 * largest);
  const micro = (torque, digits = 0) => `${(1e6 * torque).toFixed(digits)} µN m`;
  step("motor", 1).says(micro(largest, 1));
  assert.ok(report.trap.preload_acceleration > sheet.preload_acceleration, "the trap is that of a greater preload");
  const percent = (share) => `${(100 * share).toFixed(0)} %`;
  step("motor", 2).says(`${steady.toFixed(1)} rad/s`, percent(steady / 30), `${value.toFixed(2)} s`);
  step("motor", 3).says(micro(stall.torque), percent(stall.torque / largest));
  // The loads of the page: nine from none to the largest.
  const load_torques = Array.from({ length: 9 }, (_, index) => (index * largest) / 8);
  const request = { call: "motor_loads", sheet, load_torques, relative_error: 0.02, most_impacts: 20e6, seed: 1 };
  const { json } = await ask(request);
  const powers = json.flatMap(({ branches: [{ Steady, Unsettled }] }) => (Steady ?? Unsettled?.[0])?.mechanical_power.value ?? []);
  const best = powers.indexOf(Math.max(...powers));
  step("motor", 3).says(`near ${micro(load_torques[best])}`, `${(1e6 * powers[best]).toFixed(0)} µW`);
  assert.ok(Math.abs(load_torques[best] / stall.torque - 0.5) < 0.06);
  const double = await reads(4);
  step("motor", 4).says(micro(double.stall.torque), `${double.steady.toFixed(1)} rad/s`, `${double.value.toFixed(2)} s`);
});

test("sensitivity: the exponents, and how many impacts they leave", async () => {
  assert.equal((await orbitOf(step("sensitivity", 1).state)).kind, "chaotic");
  const { state, says } = step("sensitivity", 2);
  const [low, high] = state.diagram.axial_forcing;
  const read = (await orbitOf(state, 0.55)).exponent.toFixed(3);
  // Wherever somebody points.
  for (const share of [0, 0.3, 0.5, 0.8, 1]) {
    const { exponent } = await orbitOf(state, low + share * (high - low));
    assert.ok(Math.abs(exponent - read) < 0.004, `${exponent}`);
  }
  says(`about ${read}`, `${Math.log(1e16).toFixed(1)}/${read} = ${(Math.log(1e16) / read).toFixed(0)}:`);
  const compared = step("sensitivity", 3);
  const { system, start, compare } = compared.state;
  const heights = async (change) => {
    const motion = { system: { ...system, ...change }, start: { kind: "impact", ...start }, periods: compare.periods };
    const { json, numbers } = await ask({ call: "motion", ...motion, samples_per_period: 48 });
    return Float64Array.from({ length: json.samples }, (_, row) => numbers[9 * row + 1]);
  };
  const [own, other] = [await heights({}), await heights({ [compare.parameter]: compare.value })];
  const apart = own.map((height, row) => Math.abs(height - other[row]) / system.amplitude);
  const first = apart.findIndex((share) => share > 0.01) / 48;
  compared.says(`about ${first.toFixed(0)} periods`, `= ${(Math.log(1e14) / read).toFixed(0)} impacts`);
  const { exponent } = await orbitOf(step("sensitivity", 4).state);
  assert.ok(Math.abs(exponent + Math.LN2) < 1e-9);
  step("sensitivity", 4).says(`−${Math.LN2.toFixed(3)}`);
});
