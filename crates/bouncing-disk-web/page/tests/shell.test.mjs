/** The shell: tabs, keyboard, bad input, exports, sizes, and that nothing is asked of anybody. */

import assert from "node:assert/strict";
import { hashOf, onPage, pixelsOf, savedBy, settled, stateOf, VIEWS, whenAddress, whenValue } from "./browser.mjs";
import { WORDS } from "./module.mjs";

onPage("the first paint from the disk takes less than a second", {}, async (page) => {
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
  assert.ok(paint < 1000, `${paint} ms`);
});

onPage("all can be done with the keyboard alone", {}, async (page) => {
  await page.focus("#tab-toss");
  await page.keyboard.press("ArrowRight");
  await whenAddress(page, "view", "diagram");
  await page.keyboard.press("End");
  await whenAddress(page, "view", "scan");
  await page.keyboard.press("Home");
  await whenAddress(page, "view", "toss");
  await page.press("#presets-button", "Enter");
  await page.keyboard.press("Tab");
  for (let step = 0; step < 6; step++) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await whenAddress(page, "view", "basins");
  assert.match(await page.textContent("#note"), /Fig\. 7/);
  await page.press("#courses-button", " ");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent(".tour"), /step 1 of 8/);
  await page.keyboard.press("ArrowRight");
  assert.match(await page.textContent(".tour"), /step 2 of 8/);
  await page.keyboard.press("Escape");
  await whenAddress(page, "view", "basins");
  assert.equal(await page.isVisible(".tour"), false);
  await page.press("#help-button", "Enter");
  assert.ok(await page.isVisible("dialog.help"));
  const help = await page.textContent("dialog.help");
  for (const [, what] of WORDS.shell.help.keys) assert.ok(help.includes(what), what);
  assert.match(help, /Phys\. Rev\. E 80, 046201 \(2009\)/);
  await page.keyboard.press("Escape");
  await page.press("#export-button", "Enter");
  assert.ok(await page.evaluate(() => document.activeElement.closest("dialog.export") !== null));
  await page.keyboard.press("Escape");
  assert.equal(await page.isVisible("dialog.export"), false);
});

onPage("a slider changes the state and makes one entry of the history", {}, async (page) => {
  const before = [await page.evaluate(() => history.length), await hashOf(page)];
  const box = await page.locator('[data-name="restitution"] input[type=range]').boundingBox();
  const at = (share) => [box.x + box.width * share, box.y + box.height / 2];
  await page.mouse.move(...at(0.5));
  await page.mouse.down();
  await page.mouse.move(...at(0.8), { steps: 20 });
  await page.mouse.up();
  await page.waitForTimeout(600);
  const restitution = Number((await stateOf(page)).restitution);
  assert.ok(Math.abs(restitution - 0.76) < 0.05, String(restitution));
  assert.equal(await page.evaluate(() => history.length), before[0] + 1);
  await page.goBack();
  assert.equal(await hashOf(page), before[1]);
  await whenValue(page, "restitution", "0.5");
  await page.goForward();
  await whenValue(page, "restitution", String(restitution));
});

onPage("every view opens by its tab and has room, from 320 to 2,560 pixels", {}, async (page) => {
  const sizes = [
    [320, 640], [480, 800], [768, 1024], [1024, 700], [1280, 800], [1920, 1080], [2560, 1440],
  ]; // prettier-ignore
  for (const [width, height] of sizes) {
    await page.setViewportSize({ width, height });
    for (const view of VIEWS) {
      await page.click(`#tab-${view}`);
      await settled(page);
      assert.equal(await page.getAttribute(`#tab-${view}`, "aria-selected"), "true");
      assert.ok((await page.getAttribute(`#view-${view}`, "aria-description")).length > 10);
      await whenAddress(page, "view", view);
      const { wide, room, bottom } = await page.evaluate((name) => {
        const host = document.getElementById(`view-${name}`);
        const { width, height } = host.getBoundingClientRect();
        const ends = [...host.querySelectorAll("canvas")].map((one) => one.getBoundingClientRect().bottom);
        const wide = document.documentElement.scrollWidth - innerWidth;
        return { wide, room: [width, height], bottom: Math.max(...ends) };
      }, view);
      // On a large screen the pictures take the height of the window.
      if (width === 2560) assert.ok(bottom > 0.8 * 1440 && bottom <= 1440, `${view} ends at ${bottom}`);
      assert.ok(wide <= 0, `${view} at ${width}: ${wide} px too wide`);
      assert.ok(room[0] >= 0.6 * width && room[1] >= 300, `${view} at ${width}: ${room}`);
    }
  }
});

onPage("pictures follow the colours of the system", "#view=diagram", async (page) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await page.waitForTimeout(300);
  assert.ok((await pixelsOf(page, "#view-diagram canvas", ["--picture-paper"])).length > 10_000);
});

onPage("every file that a view offers can be saved, and is not empty", {}, async (page) => {
  const files = page.locator("dialog.export .card", { hasText: /(CSV|JSON|SVG|PNG)/ });
  for (const view of VIEWS) {
    await page.click(`#tab-${view}`);
    await settled(page);
    // A view offers its files as soon as it has something to say.
    let count = 0;
    for (let tries = 0; count < 1 && tries < 40; tries++) {
      await page.waitForTimeout(tries === 0 ? 0 : 500);
      await page.click("#export-button");
      count = await files.count();
      await page.keyboard.press("Escape");
    }
    assert.ok(count >= 1, view);
    for (let item = 0; item < count; item++) {
      await page.click("#export-button");
      const { name, content } = await savedBy(page, files.nth(item));
      assert.match(name, /^[a-z0-9-]+\.(csv|json|svg|png)$/);
      assert.ok(content.length > 10, name);
    }
  }
});
