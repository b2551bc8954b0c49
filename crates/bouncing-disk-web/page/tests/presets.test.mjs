/** What figures and tables say, whose panels `native.test.mjs` opens one by one, and the courses. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { boxOf, course, hashOf, isCalm, onPage, preset, settled, type, whenText } from "./browser.mjs";
import { patternOf, sourceOf, WORDS } from "./module.mjs";

const { PRESETS, stateOf: panelState } = await sourceOf("presets.ts");
const { COURSES } = await sourceOf("courses.ts");
const { toHash } = await sourceOf("state.ts");

test("every panel of a figure is another state", () => {
  for (const { id, panels } of PRESETS) {
    assert.equal(new Set(panels.map((panel) => toHash(panelState(panel)))).size, panels.length, id);
  }
});

onPage("a figure opens with its note, and its panels by their names, if it has several", {}, async (page) => {
  for (const { id, text, panels } of [PRESETS.find((one) => one.panels.length === 1), PRESETS.find(({ id }) => id === "fig06")]) {
    await preset(page, id);
    assert.equal(await page.textContent("#note p"), text);
    const chips = page.locator(".chip");
    const names = panels.length > 1 ? panels.map(({ label }) => label.replace("_", "")) : [];
    assert.deepEqual(await chips.allTextContents(), names);
    for (const index of names.keys()) {
      await chips.nth(index).click();
      await page.waitForSelector(`.chip:nth-child(${index + 1})[aria-pressed="true"]`);
      await page.waitForFunction((hash) => location.hash === hash, toHash(panelState(panels[index])));
      await isCalm(page);
    }
  }
});

onPage("the note goes with its state, and where another view has come", {}, async (page) => {
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
});

for (const { id, steps } of COURSES)
  onPage(`the course ${id} leads through its states, and gives back the one that it found`, "#view=basins", async (page) => {
    const open = () => page.locator(".group[open]").count();
    const before = [await hashOf(page), await open()];
    await course(page, id);
    for (const [step, { state, text, task, answer }] of steps.entries()) {
      const place = patternOf(WORDS.course.place, { step: step + 1, steps: steps.length });
      await whenText(page, ".tour .place", new RegExp(`^${place}$`));
      await page.waitForFunction((hash) => location.hash === hash, toHash(state));
      await isCalm(page);
      const names = /“(First impact|Platform)”/.test(`${text} ${task}`);
      if (names) assert.equal(await open(), before[1] + 1, "what the step names stands open");
      await settled(page);
      const pictures = page.locator(".view:not([hidden]) .picture");
      const ends = await pictures.evaluateAll((all) => all.map((one) => one.getBoundingClientRect().bottom));
      assert.ok(ends.length > 0 && Math.max(...ends) <= 800, `pictures of step ${step + 1} end at ${ends}`);
      const seen = await page.locator(".tour details p").evaluateAll((all) => all.map((one) => one.checkVisibility()));
      assert.deepEqual(seen, answer ? [false] : [], "an answer waits until somebody asks for it");
      assert.equal(await page.locator("#main").evaluate(({ scrollTop }) => scrollTop), 0);
      await page.locator("#main").evaluate((main) => main.scrollTo(0, 300));
      await page.click(".tour .primary");
    }
    assert.equal(await page.isVisible(".tour"), false);
    assert.equal(await page.evaluate(() => document.activeElement.id), "courses-button", "the focus goes back");
    await page.waitForTimeout(400);
    assert.deepEqual([await hashOf(page), await open()], before);
  });

onPage("a reading stays no longer than its step", "#view=diagram&diagram_forcing=0.44,0.53", async (page) => {
  const { x, y, width } = await boxOf(page, "diagram");
  await page.mouse.move(x + 0.7 * width, y + 100);
  await whenText(page, "#view-diagram .facts", /2 impacts in 2 periods/);
  await course(page, "feigenbaum");
  await whenText(page, "#view-diagram .facts", /Period–/);
});

onPage("a course ends where somebody wants to stay, and with a figure", {}, async (page) => {
  await course(page, "tour");
  await page.click(".tour .primary");
  await settled(page);
  await page.click(`.tour button:text-is("${WORDS.course.stay}")`);
  await page.waitForTimeout(400);
  assert.equal(await page.isVisible(".tour"), false);
  assert.equal(await hashOf(page), toHash(COURSES[0].steps[1].state));
  await course(page, "rest");
  await preset(page, "fig07");
  assert.equal(await page.isVisible(".tour"), false);
  assert.ok(await page.isVisible("#note"));
});
