/** Every figure and table of the paper, all their panels, and the tour. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, opened, settled, stateOf } from "./browser.mjs";

const IDS = [
  ...Array.from({ length: 14 }, (_, index) => `fig${String(index + 1).padStart(2, "0")}`),
  "table1",
  "table2",
  "table3",
];

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

for (const id of IDS) {
  test(`${id} opens with all its panels, says what to see and is legal`, async () => {
    const { page, context, errors, requests } = await opened(browser);
    await page.click("#presets-button");
    await page.click(`[data-preset="${id}"]`);
    await page.waitForSelector("#note:not([hidden])");
    await settled(page);
    const text = await page.textContent("#note > p");
    const sentences = text.split(/[.;:] /).length;
    assert.ok(text.length > 80 && sentences >= 2, text);
    const panels = Math.max(1, await page.locator(".chip").count());
    const states = new Set();
    for (let panel = 0; panel < panels; panel++) {
      if (panels > 1) {
        await page.locator(".chip").nth(panel).click();
        await page.waitForSelector(`.chip:nth-child(${panel + 1})[aria-pressed="true"]`);
      }
      await settled(page);
      await page.waitForTimeout(300);
      states.add(JSON.stringify(await stateOf(page)));
      assert.equal(await page.isVisible("#problems"), false, await page.textContent("#problems"));
      assert.notEqual(await page.getAttribute("#status", "data-kind"), "error", await page.textContent("#status"));
    }
    assert.equal(states.size, panels, "every panel is another state");
    assert.deepEqual([errors, requests], [[], []]);
    await context.close();
  });
}

test("the note goes with its state: back, and a change of a parameter", async () => {
  const { page, context } = await opened(browser);
  await page.click("#presets-button");
  await page.click('[data-preset="fig07"]');
  await settled(page);
  await page.fill("#field-restitution", "0.6");
  await page.press("#field-restitution", "Enter");
  await page.waitForSelector("#note .changed");
  await page.waitForTimeout(400);
  await page.goBack();
  await page.waitForSelector("#note .changed", { state: "detached" });
  await page.click("#note .close");
  assert.equal(await page.isVisible("#note"), false);
  await context.close();
});

test("a note goes where another view or another system has come", async () => {
  const { page, context } = await opened(browser);
  const open = async (id) => {
    await page.click("#presets-button");
    await page.click(`[data-preset="${id}"]`);
    await page.waitForSelector("#note:not([hidden])");
    await settled(page);
  };
  await open("fig10");
  await page.click("#tab-toss");
  await page.waitForSelector("#note", { state: "hidden" });
  await open("fig03");
  // The motor's sheet in the same view.
  await page.evaluate(() => {
    location.hash =
      "#view=toss&amplitude=1e-8&twist_amplitude=7e-5&angular_frequency=439823&phase_lag=0&contact_radius=0.00125" +
      "&gyration_radius=0.0063&friction=0.1";
  });
  await page.waitForSelector("#note", { state: "hidden" });
  await context.close();
});

test("the tour has eight steps, each a state and two or three sentences", async () => {
  const { page, context, errors } = await opened(browser);
  await page.click("#tour-button");
  const states = new Set();
  for (let step = 1; step <= 8; step++) {
    await page.waitForFunction(
      (text) => document.querySelector(".tour .place").textContent === text,
      `Step ${step} of 8`,
    );
    await settled(page);
    await page.waitForTimeout(300);
    states.add(JSON.stringify(await stateOf(page)));
    const sentences = (await page.textContent(".tour .text")).split(/[.?!;:] /).length;
    assert.ok(sentences >= 2, await page.textContent(".tour .text"));
    assert.notEqual(await page.getAttribute("#status", "data-kind"), "error", await page.textContent("#status"));
    await page.click(".tour .primary");
  }
  assert.equal(states.size, 8);
  assert.equal(await page.isVisible(".tour"), false);
  assert.equal(await page.evaluate(() => document.activeElement.id), "tour-button", "the focus goes back");
  assert.deepEqual(errors, []);
  await context.close();
});
