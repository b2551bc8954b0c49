/** Scans and comparisons: what they compute, what they say of it, and what they open. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { onPage, settled, stateOf, svgOf, textOf, whenAddress, whenText } from "./browser.mjs";
import { sourceOf, WORDS } from "./module.mjs";

const scan = (title, hash, act) =>
  onPage(title, { hash: `#view=scan&${hash}` }, async (page) => {
    await whenText(page, "#status", /points computed in/, 60_000);
    await act(page);
  });
const optima = (page) => page.locator("#view-scan .optima li").allTextContents();
const remark = (page) => page.textContent("#view-scan > .remark:last-child");
const select = (page, index, value) => page.selectOption(`#view-scan select >> nth=${index}`, value);
const saved = async (page, name) => JSON.parse(await textOf(page, name, "JSON"));

async function enter(page, field, text) {
  await page.fill(field, text);
  await page.press(field, "Enter");
}

scan("the best hand motion: its optima are those of Fig. 4, and a point opens its toss", "", async (page) => {
  await page.click("text=Best hand motion");
  await whenAddress(page, "friction", "0.6");
  const largest = /θ = 0: The largest of 40 computed points is 2[12]\.\d+ rad\/s at φL = 0\.945 rad/;
  await whenText(page, "#view-scan .optima", largest, 60_000);
  assert.equal((await optima(page)).length, 5);
  assert.match(await remark(page), /^Points without a settled value: 5 of 205, the first because the disk never leaves/);
  const { columns, rows } = await saved(page, "scan");
  assert.deepEqual(columns.slice(0, 3), ["phase_lag", "amplitude_angle", "toss_speed"]);
  assert.equal(rows.length, 205);
  const linear = rows.filter(([lag, , speed]) => lag === 0 && speed !== null).map(([, , speed]) => speed);
  const [told] = (await optima(page))[2].match(/[\d.]+(?= rad\/s)/);
  assert.equal(Number(Math.max(...linear).toPrecision(4)), Number(told));
  assert.match(await svgOf(page, "scan"), /spin after a single toss/);
  await page.focus("#view-scan .chart canvas[tabindex='0']");
  for (const key of ["Home", "ArrowDown", "ArrowDown", "ArrowRight"]) await page.keyboard.press(key);
  assert.match(await page.textContent("#view-scan .reading"), /0\.035.*open the point of “θ = 0”/);
  await page.keyboard.press("Enter");
  await whenAddress(page, "view", "toss");
  const { phase_lag, amplitude, normalised_speed } = await stateOf(page);
  assert.deepEqual([phase_lag, normalised_speed], ["0", "0"]);
  assert.equal(Number(amplitude).toPrecision(12), (0.25 * Math.cos(0.035)).toPrecision(12));
});

scan("a click opens the nearest point of the nearest curve", "scan_family=none", async (page) => {
  const box = await page.locator("#view-scan .chart canvas").last().boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await whenAddress(page, "view", "toss");
  const { amplitude, twist_amplitude } = await stateOf(page);
  const angle = Math.atan2(0.135 * Number(twist_amplitude), Number(amplitude));
  assert.ok(Math.abs(angle / 0.03 - Math.round(angle / 0.03)) < 1e-9 && Math.abs(angle - 0.6) < 0.1, `${angle}`);
});

const SHARES = "scan_over=axial_forcing&scan_range=0.3,0.51&scan_points=4&scan_result=share_periodic&scan_family=none";
scan("shares have intervals, and another kind of the same starts comes without computing", SHARES, async (page) => {
  assert.match((await optima(page))[0], /is 0\.97\d \(95 %: 0\.9\d+ to 0\.9\d+\) at Γ = 0\.51\..* end of the range/);
  assert.match(await remark(page), /^At 1 of 4 points \(the first is Γ = 0\.51\) a disk that comes to rest/);
  assert.match(await svgOf(page, "scan"), /rest leads elsewhere/);
  await select(page, 0, "share_rest");
  await whenText(page, "#view-scan .optima", /^The largest of 4 computed points is 1\.00 .* at Γ = 0\.3\./, 1000);
});

const SPEEDS = "scan_over=friction&scan_range=0.2,0.8&scan_points=2&scan_result=motor_speed&scan_family=none";
scan("a motor has errors, and another parameter a range of its own", SPEEDS, async (page) => {
  assert.match((await optima(page))[0], / ± /);
  await select(page, 1, "phase_lag");
  await whenAddress(page, "scan_range", "-3.14,3.14");
  await select(page, 2, "restitution");
  await whenAddress(page, "scan_values", "0.158,0.317,0.475,0.633,0.792");
});

test("an optimum says from how many points it is, and which of them its error does not tell apart", async () => {
  const { bestOf, describeOptima, planOf } = await sourceOf("views/scan/curves.ts");
  const { changed, DEFAULT_STATE } = await sourceOf("state.ts");
  const wanted = { over: "friction", range: [0, 4], points: 5, result: "motor_speed", family: null };
  const plan = planOf(changed(DEFAULT_STATE, { scan: wanted }));
  const of = (value, error = 0) => ({ value, error });
  const unsettled = { ...of(9, 0.1), lacks: "it drifts" };
  for (const [line, said] of [
    [
      [of(1, 0.1), of(4.8, 0.1), of(5, 0.1), of(4.5, 0.1), unsettled],
      /largest of 4 .* is \(5\.00 ± 0\.10\) rad\/s at μ = 2\. Points .* distinguished from it: 1, from 1 to 1\./,
    ],
    [[1, 2, 5, 4, 3].map((value) => of(value)), /is 5\.000 rad\/s at μ = 2\.$/],
    [[5, 2, 5, 5, 3].map((value) => of(value)), /it: 2, from 2 to 3\. .* at the end of the range/],
    [[unsettled, unsettled], /^No point has a value/],
  ])
    assert.match(describeOptima(plan, [line])[0], said);
  assert.deepEqual([[of(1), of(2), null], [of(3), of(3 + 4e-16)], [null]].map(bestOf), [1, 0, -1]);
});

const compared = (page) => page.locator("#view-compare .optima li").allTextContents();
const FROM = '#view-compare input[aria-label="Show from period"]';
const OTHER = '#view-compare input[aria-label="value of B"]';

onPage("the periods that are asked for are shown, or refused", "#view=compare&compare_from=155", async (page) => {
  assert.equal(await page.inputValue(FROM), "155");
  await enter(page, FROM, "160");
  await whenText(page, "#status", /must be from 0 to 159/);
  await enter(page, FROM, "150");
  await whenAddress(page, "compare_from", "150");
  assert.equal(await page.inputValue(FROM), "150");
});

onPage("a disk at rest and one that is thrown end differently, by the library", "#view=compare", async (page) => {
  assert.match(await page.textContent("#view-compare .differs"), /wA: 0 πg\/ω instead of 1\.4 πg\/ω/);
  const told = [/A: period 1; B: a rest every \d+ impacts/, /from the start/];
  (await compared(page)).forEach((line, index) => assert.match(line, told[index]));
});

onPage("the sixteenth digit: chaos shows it, the same number does nothing, another is refused", "#view=compare", async (page) => {
  await page.click("text=The sixteenth digit");
  await whenText(page, "#view-compare .differs", /ε: 0\.5000000000000001 instead of 0\.5\./);
  assert.equal(await page.inputValue("#view-compare input[aria-label^='value of B']"), "0.5000000000000001");
  await whenText(page, "#view-compare .optima", /for the first time after/);
  // The window is that of the parting, which one sees.
  const [, parting] = /From period (\d+) on this is visible/.exec((await compared(page))[1]);
  assert.equal(await page.inputValue(FROM), String(parting - 3));
  const { columns, rows } = await saved(page, "comparison");
  const apart = rows.map((row) => row[columns.indexOf("difference_over_A")]);
  const first = apart.findIndex((value) => value > 0.01);
  assert.match((await compared(page))[1], new RegExp(`after ${(first / 48).toFixed(1)} periods`));
  const amplitude = Number((await stateOf(page)).amplitude);
  const most = (period) => Math.max(...apart.slice(period * 48, (period + 1) * 48));
  const seen = Array.from({ length: 160 }, (_, period) => most(period) > 0.1);
  assert.equal(seen.lastIndexOf(false) + 1, Number(parting));
  for (const row of [0, first, 3000]) assert.equal(Math.abs(rows[row][1] - rows[row][2]) / amplitude, apart[row]);
  await enter(page, OTHER, "0.5");
  await whenText(page, "#view-compare .optima", /^Not one bit of the heights differs in 160 periods/);
  await page.click("text=One unit in the last place");
  await whenAddress(page, "compare_value", "0.5000000000000001");
  await settled(page);
  // No chart of another B stands there.
  await enter(page, OTHER, "1.5");
  await whenText(page, "#status", /restitution = 1\.5/);
  assert.equal(await page.locator("#view-compare .chart canvas").count(), 0);
});

test("the next double is one unit in the last place away", async () => {
  const { nextDouble } = await sourceOf("numbers.ts");
  const next = [0.5000000000000001, -0.49999999999999994, 5e-324, 1.0000000000000002];
  assert.deepEqual([0.5, -0.5, 0, 1].map(nextDouble), next);
});

onPage("a range is typed number by number, and what is refused stays to be read", "#view=scan&scan_points=3", async (page) => {
  await settled(page);
  const field = (name) => page.locator(`#view-scan input[aria-label^="${name}"]`);
  for (const [name, text, said] of [
    ["points", "1000", /from 2 to 200/], ["points", "3", null], ["from", "1.3", /lower to a higher/],
    ["to", "1.5", null], ["to", "5 constructor", /not a number/],
  ]) {
    await field(WORDS.scan[name]).fill(text);
    await field(WORDS.scan[name]).press("Enter");
    // What is computed then has its word in the same line.
    await (said === null ? settled(page) : whenText(page, "#status", said));
    assert.equal(await field(WORDS.scan[name]).getAttribute("aria-invalid"), said && "true");
    assert.equal(await field(WORDS.scan[name]).inputValue(), text);
  } // prettier-ignore
  await whenAddress(page, "scan_range", "1.3,1.5");
});

const THROWN = "#view=compare&throw=1,0.1,0.5,2&compare_parameter=normalised_speed";
onPage("a disk that was thrown is not compared with one that begins with an impact", THROWN, async (page) => {
  await whenText(page, "#view-compare .chart-word", /was thrown/);
  assert.doesNotMatch(await page.textContent("#view-compare .differs"), /instead of/);
});
