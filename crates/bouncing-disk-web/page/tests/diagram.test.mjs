/** The orbit diagram: what is said and drawn of a window, and how fast it is there. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { isCalm, onPage, type, whenText, whenValue, within as open } from "./browser.mjs";
import { sourceOf } from "./module.mjs";

const within = (hash, act) => open({ hash: `#view=diagram&${hash}` }, act);

/** The words come after what the line below the view says first. */
const isSaid = (page, pattern) => whenText(page, "#view-diagram .alternative", pattern);

test("a window of any place is answered: what its orbits do for good, and its bifurcations", async () => {
  for (const [hash, ...said] of [
    [
      "0.484,0.487",
      /In the long run: period 1 at 0\.484\d+, period 1 at .* period 2 at 0\.486\d+\./,
      /orbits have not settled after 3,000 impacts.*The lines show where they end\./,
      /On the branches: doubling at 0\.48600/,
    ],
    ["0.54,0.62", /doubling at 0\.5401, doubling at 0\.5421, doubling at 0\.5426/],
    ["0.45,0.450000000001", /for Γ from 0\.45 to 0\.450000000001,/],
    ["99,100", /for Γ from 99 to 100,/],
    ["0.9,1.2&restitution=0", /for Γ from/],
    ["0.3,0.62&restitution=0.999999", /for Γ from/],
  ])
    await within(`diagram_forcing=${hash}`, async (page) => {
      await isCalm(page);
      for (const pattern of said) await isSaid(page, pattern);
    });
});

test("another motion of the platform is drawn and said, without the branches and orbits of the sine", async () => {
  await within("diagram_drive=triangle", async (page) => {
    await isCalm(page);
    await isSaid(page, /The platform moves as triangle\.($| .*still on their way\.)/);
    assert.ok(await page.isDisabled("#view-diagram input[type=checkbox]"));
    await page.selectOption("#view-diagram label:has-text('Platform') select", "sine");
    await page.waitForFunction(() => /In the long run/.test(document.querySelector("#view-diagram .alternative").textContent));
  });
});

test("a disk that takes up no spin has a sentence and a range instead of rounding", async () => {
  for (const nothing of ["friction=0", "twist_amplitude=0"])
    await within(`diagram_quantity=angular_speed&${nothing}`, async (page) => {
      await isSaid(page, /the platform cannot turn the disk/);
    });
});

onPage("a forcing is shown as it was typed", "#view=diagram", async (page) => {
  for (const forcing of ["0.49", "0.34", "0.55", "0.7"]) {
    await type(page, "axial_forcing", forcing);
    await whenValue(page, "axial_forcing", forcing);
  }
});

test("a zoom that reaches the limit stays where it is", async () => {
  const { confined } = await sourceOf("drawing/window.ts");
  const limits = [[1e-9, 100], [1e-3, 1e3]]; // prettier-ignore
  const about = ([low, high], centre, factor) => [centre + (low - centre) * factor, centre + (high - centre) * factor];
  let window = [0.3, 0.62];
  for (let turn = 0; turn < 60; turn++) window = confined(about(window, window[0], 1.4), ...limits, window);
  assert.equal(window[1] - window[0], 100);
  assert.deepEqual(confined(about(window, window[1], 1.4), ...limits, window), window);
  assert.deepEqual(confined([0.4, 0.5], ...limits, [0.4, 0.6]), [0.4, 0.5]);
});

test("the ticks of the narrowest windows differ", async () => {
  const { ticks } = await sourceOf("drawing/axes.ts");
  for (const width of [1e-9, 1e-12, 1e-13]) {
    const labels = ticks([0.45, 0.45 + width], 5).map((tick) => tick.label);
    assert.ok(labels.length > 1 && new Set(labels).size === labels.length, labels.join(" "));
  }
});
