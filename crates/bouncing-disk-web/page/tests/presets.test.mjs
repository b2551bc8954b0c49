/** Every figure and table of the paper, all their panels, whose answers `native.test.mjs` waits for, and the courses. */

import assert from "node:assert/strict";
import { course, isCalm, onPage, preset, settled, stateOf, type, whenText } from "./browser.mjs";
import { patternOf, sourceOf, WORDS } from "./module.mjs";

const { PRESETS } = await sourceOf("presets.ts");
const { COURSES } = await sourceOf("courses.ts");
const { toHash } = await sourceOf("state.ts");

for (const { id, panels } of PRESETS) {
  onPage(`${id} opens with all its panels, says what to see and is legal`, {}, async (page) => {
    await preset(page, id);
    const text = await page.textContent("#note p");
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

const stateNow = async (page) => JSON.stringify(await stateOf(page));

for (const { id, steps } of COURSES)
  onPage(`the course ${id} leads through its states, and gives back the one that it found`, "#view=basins", async (page) => {
    const before = await stateNow(page);
    await course(page, id);
    for (const [step, { state, answer }] of steps.entries()) {
      const place = patternOf(WORDS.course.place, { step: step + 1, steps: steps.length });
      await whenText(page, ".tour .place", new RegExp(`^${place}$`));
      await page.waitForFunction((hash) => location.hash === hash, toHash(state));
      await isCalm(page);
      const answers = page.locator(".tour details p");
      if (answer) assert.equal(await answers.isVisible(), false, "an answer waits until somebody asks for it");
      if (answer) await page.click(".tour summary");
      assert.equal(await answers.count(), answer ? 1 : 0);
      await page.click(".tour .primary");
    }
    assert.equal(await page.isVisible(".tour"), false);
    assert.equal(await page.evaluate(() => document.activeElement.id), "courses-button", "the focus goes back");
    await page.waitForTimeout(400);
    assert.equal(await stateNow(page), before);
  });

onPage("a course ends where somebody wants to stay, and with a figure", {}, async (page) => {
  await course(page, "tour");
  await page.click(".tour .primary");
  await settled(page);
  await page.click(`.tour button:text-is("${WORDS.course.stay}")`);
  await page.waitForTimeout(400);
  assert.equal(await page.isVisible(".tour"), false);
  assert.equal(await page.evaluate(() => location.hash), toHash(COURSES[0].steps[1].state));
  await course(page, "rest");
  await preset(page, "fig07");
  assert.equal(await page.isVisible(".tour"), false);
  assert.ok(await page.isVisible("#note"));
});
