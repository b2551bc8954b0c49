/** Every field at and beyond its limits: refused where it is typed, or taken; the page goes on in both cases. */

import assert from "node:assert/strict";
import { isCalm, onPage, settled, stateOf, type, valueOf, whenAddress, whenValue } from "./browser.mjs";

const NO_NUMBER = /is not a number\. Write it like 0\.5/;
const TAKEN = null;
/** What each field does with a text; those that are no numbers are tried in one number and one angle. */
const POSITIVE = { 0: /must be more than 0\.$/, "-0": /must be more than 0\.$/, "-1": /must be more than 0\.$/ };
const ATLEAST0 = { 0: TAKEN, "-0": TAKEN, "1e-310": TAKEN, "-1e-310": /must be 0 or more\.$/, "-1": /must be 0 or more\.$/ };
const ANY = { 0: TAKEN, "-0": TAKEN, "1e-310": TAKEN, "-1e-310": TAKEN, "-1": TAKEN };
const FORCING = /is not possible: the axial forcing must be from 0 to 3\.18e7 \(A omega/;
const FIELDS = {
  axial_forcing: { "0": TAKEN, "-0": TAKEN, "1e-310": TAKEN, "-1": FORCING, "3e7": TAKEN, "4e7": FORCING },
  restitution: {
    "0": TAKEN, "-0": TAKEN, "1e-310": TAKEN, "0.9999999999999999": TAKEN, "1": /at least 0 and less than 1\./, "-1e-310": /less than 1\./,
    "1e400": /^"1e400" is too large/, "1e-400": /too small to distinguish from 0/, "1e-323 %": /too small/,
  },
  friction: { ...ATLEAST0, "1e90": TAKEN, "1e101": /must be from 0 to 1e100 \(dimensionless\)/ },
  amplitude: { ...ATLEAST0, "4e6": TAKEN, "5e6": /\[0, 1e8\]/ },
  twist_amplitude: { ...ATLEAST0, "1e90": TAKEN, "1e300": /1e100\]/ },
  stroke: { "1e-3": TAKEN, "-1": /the stroke must be 0 or more/, "1e9": /legal range/ },
  amplitude_angle: { "0": TAKEN, "30°": TAKEN, "2": /the angle of the stroke must be from 0 to pi\/2 \(rad\)/ },
  angular_frequency: { ...POSITIVE, "1e-310": /legal range/, "1e-3": TAKEN, "1e5": TAKEN, "1e6": /\[0, 1e8\]/ },
  phase_lag: { ...ANY, "1e300": TAKEN, "-1e300": TAKEN },
  contact_time: {
    "0": TAKEN, "-0": TAKEN, "1e-310": TAKEN, "1e3": TAKEN, "2e3": /the contact time must be from 0 to 1590\./, "-1": /from 0 to 1590/,
  },
  contact_radius: { ...POSITIVE, "1e-310": /1e100\]/, "1e-12": TAKEN, "1e8": TAKEN },
  gyration_radius: { ...POSITIVE, "1e-310": /legal range/, "1e-6": TAKEN, "1e8": TAKEN, "1e300": /1e100\]/ },
  preload_acceleration: { ...POSITIVE, "1e-310": /\[0, 1e8\]/, "1e-6": TAKEN, "1e8": TAKEN, "1e300": /legal range/ },
  load_acceleration: { ...ANY, "1e8": TAKEN, "1e300": /1e100\]/, "-1e300": /1e100\]/ },
  mass: { ...POSITIVE, "1e-310": /legal range/, "1e-300": TAKEN, "1e300": TAKEN },
  impact_phase: { ...ANY, "1e300": TAKEN, "-1e300": TAKEN },
  normalised_speed: { ...ATLEAST0, "1e8": TAKEN, "1e300": /more than the limit/ },
  angular_speed: { ...ANY, "1e8": TAKEN, "1e300": /1e100/, "-1e300": /1e100/ },
}; // prettier-ignore
for (const t of ["", "inf", "1,5,1", "1 5", "0x1p3", "0.5 mm"]) FIELDS.restitution[t] = FIELDS.phase_lag[t] = NO_NUMBER;
for (const expected of Object.values(FIELDS)) expected.NaN = NO_NUMBER;

onPage("the list of fields is that of the page", "#view=toss", async (page) => {
  const names = await page.evaluate(() => [...document.querySelectorAll(".field")].map((one) => one.dataset.name));
  assert.deepEqual(names, Object.keys(FIELDS));
});

onPage("numbers are understood with a decimal comma, a true minus sign, multiples of pi and a unit", "#view=toss", async (page) => {
  const understood = {
    amplitude: { "62 mm": "0.062", "6,2cm": "0.062", "62.5e3 µm": "0.0625", "1,250 m": null },
    restitution: { "0,25": "0.25", "35 %": "0.35" },
    angular_frequency: { "2 Hz": String(Number((4 * Math.PI).toPrecision(15))), "15 rad/s": "15" },
    phase_lag: { "−0.25π": String(-Math.PI / 4), "-90°": Number((-Math.PI / 2).toPrecision(15)).toString(), "-π/2": String(-Math.PI / 2) },
    mass: { "400 g": "0.4", "0,5 kg": "0.5", "5 mm": null },
    axial_forcing: { "0.5": "0.5" },
  };
  for (const [name, texts] of Object.entries(understood))
    for (const [text, value] of Object.entries(texts)) {
      await type(page, name, text);
      if (value !== null) await whenValue(page, name, value);
      else assert.match(await page.textContent(`#error-${name}`), /thousands or decimals|not a number/, text);
    }
  await whenAddress(page, "amplitude", String((0.5 * Math.PI * 9.8) / 225));
});

onPage("a metre for a hand is questioned, and 62 mm are not", "#view=toss", async (page) => {
  const told = () => page.locator(".field[data-name='amplitude'] .caution");
  await type(page, "amplitude", "62");
  await told().waitFor({ state: "visible" });
  assert.match(await told().textContent(), /^62 m is large.*type “62 mm”/);
  assert.equal((await whenValue(page, "amplitude", "62"), await page.isVisible("#error-amplitude")), false);
  await type(page, "amplitude", "62 mm");
  await whenValue(page, "amplitude", "0.062");
  await told().waitFor({ state: "hidden" });
});

/** What has become of what was typed: the sentence of its refusal, or null once the state has this number. */
async function outcome(page, name, text) {
  const answer = await page.waitForFunction(
    ([field, wanted]) => {
      const error = document.getElementById(`error-${field}`);
      if (!error.hidden) return { refused: error.textContent };
      const value = Number(document.getElementById(`field-${field}`).title);
      // The forcing is computed back from the amplitude that it sets.
      return Math.abs(value - wanted) <= Math.max(1e-12 * Math.abs(wanted), 1e-300) && { refused: null };
    },
    [name, text.endsWith("°") ? (parseFloat(text) * Math.PI) / 180 : Number(text)],
    { timeout: 5000 },
  );
  return (await answer.jsonValue()).refused;
}

for (const [name, expected] of Object.entries(FIELDS))
  onPage(`${name}: every limit is kept, and the field goes on after each`, "#view=toss", async (page) => {
    const first = await valueOf(page, name);
    for (const [text, wanted] of Object.entries(expected)) {
      const [before, state] = [await valueOf(page, name), await stateOf(page)];
      await type(page, name, text);
      const refused = await outcome(page, name, text);
      if (wanted === TAKEN) assert.equal(refused, null, `${name} = ${text}`);
      else {
        assert.match(String(refused), wanted, `${name} = ${text}`);
        assert.equal(await page.getAttribute(`#field-${name}`, "aria-invalid"), "true");
        assert.equal(await page.inputValue(`#field-${name}`), text, "what was typed stays");
        assert.equal(await valueOf(page, name), before, "what is refused changes nothing");
        assert.deepEqual(await stateOf(page), state);
      }
      await page.focus(`#field-${name}`);
      await page.keyboard.press("Escape");
      assert.equal(await page.isVisible(`#error-${name}`), false);
      await type(page, name, first);
      assert.equal(await outcome(page, name, first), null, `${name} after ${text}`);
      // The address follows a little later.
      await page.waitForTimeout(300);
    }
  });

for (const view of ["diagram", "basins", "motor"])
  onPage(`extreme numbers that are taken leave the view ${view} answering`, `#view=${view}`, async (page) => {
    const extremes = { amplitude: "1e-310", restitution: "0", friction: "0", twist_amplitude: "0", mass: "1e300" };
    for (const [name, text] of Object.entries(extremes)) {
      const first = await valueOf(page, name);
      await type(page, name, text);
      assert.equal(await outcome(page, name, text), null, `${name} = ${text}`);
      await settled(page);
      await type(page, name, first);
      assert.equal(await outcome(page, name, first), null);
      await page.waitForFunction(() => document.getElementById("status").dataset.kind !== "error");
      await settled(page);
      await isCalm(page);
    }
  });
