/** The motor view: nothing of one motor stands under another one, and one steady speed stands on the page. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { fact, hashOf, preset, stateOf, svgOf, textOf, type, whenAddress, whenText, within as open } from "./browser.mjs";
import { sourceOf } from "./module.mjs";

const words = await sourceOf("views/motor/words.ts");
const numbers = await sourceOf("numbers.ts");

const onPage = (title, hash, act) => test(title, () => open({ hash, settle: false }, act));

/** Fig. 10(c), whose impacts are few: its curves are there in a second or two. */
const MOTOR =
  "#view=motor&amplitude=1e-7&twist_amplitude=6.820926132509799e-5&angular_frequency=439822.9715025711&phase_lag=0" +
  "&contact_radius=0.00125&gyration_radius=0.0063&friction=0.1&restitution=0.5&preload_acceleration=9.8&mass=0.0329";
/** With a load, as an angular deceleration, of so many N m. */
const loaded = (torque) => `&load_acceleration=${torque / (0.0329 * 0.0063 ** 2)}`;

const onMotor = (title, changes, act) =>
  onPage(title, MOTOR + changes, async (page) => {
    await whenText(page, "#status", /^Run-up and \d+ loads are computed/, 60_000);
    await act(page);
  });
const captions = (page) => page.locator("#view-motor .chart figcaption").allTextContents();
const isFact = async (page, name, told) => assert.match(await fact(page, "motor", name), told);

onMotor("the curves of a motor are gone as soon as there is another one", "", async (page) => {
  for (const caption of await captions(page)) assert.match(caption, /\d/);
  const shown = await page.evaluate(async () => {
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    location.hash = location.hash.replace(/&amplitude=[^&]*/, "&amplitude=1e-9");
    while (Number(document.querySelector("#field-amplitude").value) === 1e-7) await frame();
    await frame();
    await frame();
    const texts = (selector) => [...document.querySelectorAll(selector)].map((one) => one.textContent);
    document.getElementById("export-button").click();
    await frame();
    return {
      captions: texts("#view-motor .chart figcaption"),
      words: texts("#view-motor .chart-word:not([hidden])").filter((word) => /is being computed\.$/.test(word)).length,
      canvases: document.querySelectorAll("#view-motor .chart canvas").length,
      facts: texts("#view-motor .facts dd").filter((one) => /\d/.test(one)),
      offers: texts("dialog.export .card").filter((one) => /motor/i.test(one)),
    };
  });
  assert.deepEqual(shown, { captions: ["", "", "", ""], words: 4, canvases: 0, facts: [], offers: [] });
});

onMotor("the steady speed of the report is that of the run-up and of the curve without load", "", async (page) => {
  const [, speed] = /^(.* ± .*) rad\/s without load$/.exec(await fact(page, "motor", "Steady speed"));
  const [runUp, curve] = await captions(page);
  assert.ok(runUp.startsWith(`Steady speed: ${speed} rad/s without load.`), runUp);
  assert.ok(curve.startsWith(`From ${speed} rad/s at 0 N m`), curve);
  await isFact(page, "Stall load", /^\([\d.]+ ± [\d.]+\) .?N m$/);
});

onMotor("a steady speed says under which load it is", loaded(10e-6), (page) =>
  isFact(page, "Steady speed", /^15\.\d+ ± [\d.]+ rad\/s under the load of the sheet, 10\.0 µN m$/),
);

onMotor("a load that drives the rotor has no steady speed", loaded(60e-6), async (page) => {
  await isFact(page, "Steady speed", /^none: the load of the sheet, 60\.0 µN m, is more than the 40\.3 µN m/);
  assert.match((await captions(page))[0], /^Steady speed: none: the load/);
});

onPage("a motor that nothing turns is said to be one, and keeps no curves of another", "#view=motor", async (page) => {
  const chart = page.locator("#view-motor .chart").first();
  await chart.waitFor();
  const needed = [["friction", "0.6", /^Without friction/], ["twist_amplitude", "0.9", /^Without a twist/]];
  for (const [name, value, said] of needed) {
    await type(page, name, "0");
    await whenText(page, "#status", said);
    await chart.waitFor({ state: "hidden" });
    await type(page, name, value);
    await chart.waitFor();
  }
}); // prettier-ignore

const operation = (row) => ({
  load_torque: 0, speed: 20, speed_error: 0.1, mechanical_power: 0, mechanical_power_error: 1e-9, input_power: 1e-3,
  input_power_error: 1e-6, efficiency: NaN, efficiency_error: NaN, status: 0, shortfall: null, wanted: 0.1,
  motion: null, others: [], ...row,
}); // prettier-ignore
const curves = (...rows) => words.describeCurves(rows.map(operation), null);

test("a load that puts power in is not said to take it, and what has not settled has no error", () => {
  const [, power, efficiency] = curves({ load_torque: -2e-5, mechanical_power: -4.04 }, {});
  assert.equal(power, "None of the loads computed takes power from the motor.");
  assert.doesNotMatch(efficiency, /best/);
  const drifts = { status: 1, load_torque: 1e-5, mechanical_power: 4e-5, efficiency: 0.06, efficiency_error: 1e-4 };
  for (const sentence of curves(drifts)) {
    assert.match(sentence, /so far, not settled/);
    assert.doesNotMatch(sentence, /±/);
  }
});

test("motions that coexist are curves, sentences and lines of their own", async () => {
  const { loadCharts, motorOffers } = await sourceOf("views/motor/charts.ts");
  const irregular = { Irregular: { life: { Mean: 0.25 } } };
  const other = operation({ speed: 12, status: 1, shortfall: "it drifts", motion: irregular });
  const rows = [operation({ motion: "Contact", others: [other] }), operation({ load_torque: 1e-5 })];
  const [speed, power] = loadCharts(rows, 1e-5, null);
  assert.deepEqual(speed.curves.map(({ label, y }) => [label, [...y]]), [
    ["speed", [20, 20]],
    ["coexisting motion 2", [12, NaN]],
  ]);
  assert.deepEqual(speed.marks.map(({ x, y, form }) => [x, y, form]), [[0, 12, "circle"]]);
  assert.equal(power.curves.length, 2);
  assert.match(words.describeCurves(rows, null)[0], / Under 1 of 2 loads motions with different speeds coexist/);
  assert.doesNotMatch(curves({}, {})[0], /coexist/);
  const told = [
    ["Contact", "the rotor stays on the stator"],
    [{ Periodic: { periods: 3, impacts: 2 } }, "periodic: 2 impacts in 3 periods of the drive"],
    [{ Periodic: { periods: 1, impacts: 1 } }, "periodic: 1 impact per period of the drive"],
    [irregular, "irregular, for 250 ms on average until another motion follows"],
    [{ Irregular: { life: { NoneEndedIn: 4 } } }, "irregular; no such motion ended within 4.00 s"],
  ];
  for (const [motion, said] of told) assert.equal(words.describeMotion(motion), said);
  const known = { sheet: {}, text: "", transient: null, operations: rows };
  const table = motorOffers(known, null, [], {}).find(({ kind }) => kind === "csv");
  const lines = (await (await table.make()).text()).trim().split("\n");
  assert.deepEqual(
    lines.slice(-3).map((line) => line.split(",").slice(0, 4)),
    [["0", "1", "contact", ""], ["0", "2", "irregular", "0.25"], ["0.00001", "1", "", ""]],
  );
});

onPage("no curve runs through the words beside a line", "", async (page) => {
  await preset(page, "table3");
  await whenText(page, "#view-motor", /Time constant: 8\d\d ms/);
  const svg = await svgOf(page, "motor run-up");
  const text = /<text x="([\d.]+)" y="([\d.]+)" text-anchor="start" fill="[^"]*" font-size="([\d.]+)" xml[^>]*><tspan>time constant/;
  const [, x, y, size] = text.exec(svg).map(Number);
  const places = [...svg.matchAll(/[ML]([\d.]+) ([\d.]+)/g)].map(([, ...at]) => at.map(Number));
  assert.ok(places.length > 150);
  assert.deepEqual(places.filter((at) => at[0] > x && at[0] < x + 6 * size && at[1] > y - size && at[1] < y), []);
});

test("points at zero stand inside the frame where there is nothing but zero", async () => {
  const { loadCharts } = await sourceOf("views/motor/charts.ts");
  const still = [operation({ efficiency: 0 }), operation({ load_torque: 1e-5 })];
  const [, , efficiency] = loadCharts(still, 1e-5, null);
  assert.ok(efficiency.y.range[0] < 0, `${efficiency.y.range}`);
});

test("numbers that the error hides have no digits and no sign, others no more than are known", () => {
  assert.equal(numbers.withError(-8.1e-10, 4.2e-6), "0 ± 4.2 × 10⁻⁶");
  assert.equal(numbers.withError(-0.04, 0.012), "−0.040 ± 0.012");
  const stall = { torque: null, torque_error: null, bracket: null };
  const still = words.describeStall({ ...stall, no_load_speed: 0.024535763201715438, no_load_speed_error: 0.0118 });
  assert.match(still, /0\.025 ± 0\.012 rad\/s/);
  const rise = { form: "exponential", constant: { value: 0.83503, low: 0.83479, high: 0.83528 }, residual: 0.2 };
  const constant = words.timeConstant({ points: 9, rise, refusal: null }, null);
  assert.equal(constant, "835.03 ms (95 % interval 834.79 to 835.28 ms)");
  const lost = operation({ status: 1, speed: 16.0763, speed_error: 8e-4, shortfall: "it drifts" });
  assert.match(words.steadySpeed(lost, 1), /^not settled, 16\.1 rad\/s so far without load; it drifts$/);
});

test("a trap is told with digits enough to find it", () => {
  const near = { preload_acceleration: 1.00000002, relative_distance: 2e-8 };
  assert.match(
    words.describeTrap({ ...near, forcing_from_to: [615.7521, 615.75212] }),
    /2\.0 × 10⁻⁶ % away: .* 1\.00000002 m\/s² .* Γ from 615\.7521 to 615\.75212\.$/,
  );
});

onMotor("a contact time is stated, and what it rules out is said", "&contact_time=1e-6", async (page) => {
  await isFact(page, "Contact time over the period", /^0\.07 \(contacts are compliant\)$/);
  await isFact(page, "Regime", /^of rigid impacts: /);
  await isFact(page, "Stall load", /^\([\d.]+ ± [\d.]+\) .?N m$/);
  await page.click("#tab-basins");
  await whenText(page, "#status", /set the contact time to 0$/);
  await type(page, "contact_time", "0.25");
  await whenAddress(page, "contact_time", String((0.25 * 2 * Math.PI) / 439822.9715025711));
  assert.equal(await page.inputValue("#field-contact_time"), "0.25");
});

/** The sheet's stator is this one, in JSON. */
const hasStator = (page, stator) => {
  const isIt = (wanted) => {
    const { value } = document.querySelector(".sheet-text");
    return value !== "" && JSON.stringify(JSON.parse(value).stator ?? null) === wanted;
  };
  return page.waitForFunction(isIt, JSON.stringify(stator));
};

onMotor("a stator that yields stays with the motor until its mass is zero, also in a link", "", async (page) => {
  const set = async (name, text, stator) => {
    await page.getByLabel(name).fill(text);
    await page.getByLabel(name).press("Enter");
    await hasStator(page, stator);
  };
  const yields = /^Regimewithout a rotor: /;
  await set("effective mass", "5 g", { kind: "axial", mass: 0.005, quality: 300 });
  await whenText(page, "#view-motor .facts", yields);
  await page.getByLabel("Its mode also twists").check();
  await hasStator(page, { kind: "axial_twist", mass: 0.005, quality: 300 });
  await set("quality factor", "120", { kind: "axial_twist", mass: 0.005, quality: 120 });
  await type(page, "friction", "0.2");
  await whenAddress(page, "friction", "0.2");
  await open({ hash: await hashOf(page), settle: false }, async (copy) => {
    await hasStator(copy, { kind: "axial_twist", mass: 0.005, quality: 120 });
    await whenText(copy, "#view-motor .facts", yields);
    await type(copy, "phase_lag", "0.3");
    await whenText(copy, "#error-phase_lag", /^The stator of the motor does not allow this: .*data sheet/);
    await copy.click("#tab-scan");
    await copy.click("text=Basin share over forcing");
    await whenAddress(copy, "motor_stator", "none");
  });
  await set("effective mass", "0", null);
  await whenText(page, "#view-motor .facts", /^Regime(?!without|…)/);
});

onPage("the view of the motor starts with a motor, and the disk comes back", "#view=toss&friction=0.37", async (page) => {
  await page.click("#tab-motor");
  await whenAddress(page, "amplitude", "1e-8");
  assert.match(await page.textContent("#note"), /ultrasonic motor/);
  await page.click("#tab-diagram");
  await whenAddress(page, "friction", "0.37");
  assert.equal((await stateOf(page)).angular_frequency, "15");
  // Somebody who changes the motor goes on with it.
  await page.click("#tab-motor");
  await whenAddress(page, "amplitude", "1e-8");
  await type(page, "friction", "0.2");
  await page.click("#tab-toss");
  await whenAddress(page, "view", "toss");
  assert.equal((await stateOf(page)).amplitude, "1e-8");
});

/** Bounces once in every period from the shared start, and chatters from rest. */
const BISTABLE = "#view=motor&amplitude=0.0616&phase_lag=-0.8168&impact_phase=0.4&normalised_speed=1.4";
onPage("where the run-up and the other views end on two attractors, the page says so", BISTABLE, async (page) => {
  const said = /starts from rest, and ends with: rest after .*end with: 1 impact per period of the platform\./;
  await whenText(page, "#view-motor .caution:not([hidden])", said);
  await type(page, "normalised_speed", "0.1");
  await page.waitForFunction(() => document.querySelector("#view-motor .caution").hidden);
});

onMotor("a run-up goes on until it is steady", "&motor_rise_times=0.5", async (page) => {
  assert.doesNotMatch((await captions(page))[0], /ends before/);
  // It was asked for half a rise time, in which no motor gets there.
  const last = (await textOf(page, "motor run-up", "CSV")).trim().split("\n").at(-1).split(",").map(Number);
  assert.ok(Math.abs(last[1] - parseFloat(await fact(page, "motor", "Steady speed"))) < 1.5, `${last}`);
});
