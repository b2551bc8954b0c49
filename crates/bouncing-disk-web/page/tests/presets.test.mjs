/** Every figure and table of the paper, all their panels, whose answers `native.test.mjs` waits for, and the tour. */

import assert from "node:assert/strict";
import { isCalm, onPage, preset, settled, stateOf, type, whenText } from "./browser.mjs";
import { sourceOf } from "./module.mjs";

const { PRESETS } = await sourceOf("presets.ts");

for (const { id, panels } of PRESETS) {
  onPage(`${id} opens with all its panels, says what to see and is legal`, {}, async (page) => {
    await preset(page, id);
    const text = await page.textContent("#note > p");
    const sentences = text.split(/[.;:] /).length;
    assert.ok(text.length > 80 && sentences >= 2, text);
    const chips = await page.locator(".chip").all();
    assert.equal(chips.length, panels.length > 1 ? panels.length : 0);
    const states = new Set();
    for (let panel = 0; panel < panels.length; panel++) {
      await chips[panel]?.click();
      if (chips[panel]) await page.waitForSelector(`.chip:nth-child(${panel + 1})[aria-pressed="true"]`);
      await page.waitForTimeout(300);
      states.add(JSON.stringify(await stateOf(page)));
      await isCalm(page);
    }
    assert.equal(states.size, panels.length, "every panel is another state");
  });
}

onPage("the note goes with its state, and where another view or another system has come", {}, async (page) => {
  await preset(page, "fig07");
  await type(page, "restitution", "0.6");
  await page.waitForSelector("#note .changed");
  await page.waitForTimeout(400);
  await page.goBack();
  await page.waitForSelector("#note .changed", { state: "detached" });
  await page.click("#note .close");
  assert.equal(await page.isVisible("#note"), false);
  await preset(page, "fig10");
  await page.click("#tab-toss");
  await page.waitForSelector("#note", { state: "hidden" });
  await preset(page, "fig03");
  // The motor's sheet in the same view.
  await page.evaluate(() => {
    location.hash =
      "#view=toss&amplitude=1e-8&twist_amplitude=7e-5&angular_frequency=439823&phase_lag=0&contact_radius=0.00125" +
      "&gyration_radius=0.0063&friction=0.1";
  });
  await page.waitForSelector("#note", { state: "hidden" });
});

onPage("the tour has eight steps, each a state and two or three sentences", {}, async (page) => {
  await page.click("#tour-button");
  const states = new Set();
  for (let step = 1; step <= 8; step++) {
    await whenText(page, ".tour .place", new RegExp(`^Step ${step} of 8$`));
    await settled(page);
    await page.waitForTimeout(300);
    states.add(JSON.stringify(await stateOf(page)));
    const sentences = (await page.textContent(".tour .text")).split(/[.?!;:] /).length;
    assert.ok(sentences >= 2, await page.textContent(".tour .text"));
    await isCalm(page);
    await page.click(".tour .primary");
  }
  assert.equal(states.size, 8);
  assert.equal(await page.isVisible(".tour"), false);
  assert.equal(await page.evaluate(() => document.activeElement.id), "tour-button", "the focus goes back");
});
