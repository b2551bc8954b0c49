/** The shell: tabs, keyboard, bad input, exports, sizes, and that nothing is asked of anybody. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, opened, ready, settled, stateOf, type, whenAddress } from "./browser.mjs";

const VIEWS = ["toss", "diagram", "basins", "motor"];

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

/** A page without errors and requests at its end. */
async function clean(options, act) {
  const { page, context, errors, requests } = await opened(browser, options);
  try {
    await act(page, context);
    await settled(page);
    assert.deepEqual(errors, []);
    assert.deepEqual(requests, []);
  } finally {
    await context.close();
  }
}

test("every view opens by its tab, and says what it is", () =>
  clean({}, async (page) => {
    for (const view of VIEWS) {
      await page.click(`#tab-${view}`);
      await settled(page);
      assert.equal(await page.getAttribute(`#tab-${view}`, "aria-selected"), "true");
      assert.ok(await page.isVisible(`#view-${view}`));
      assert.ok((await page.getAttribute(`#view-${view}`, "aria-description")).length > 10);
      await whenAddress(page, "view", view);
    }
  }));

test("the first paint from the disk takes less than a second", () =>
  clean({}, async (page) => {
    const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
    assert.ok(paint < 1000, `${paint} ms`);
  }));

test("all can be done with the keyboard alone", () =>
  clean({}, async (page) => {
    await page.focus("#tab-toss");
    await page.keyboard.press("ArrowRight");
    await whenAddress(page, "view", "diagram");
    await page.keyboard.press("End");
    await whenAddress(page, "view", "motor");
    await page.keyboard.press("1");
    await whenAddress(page, "view", "toss");
    await page.keyboard.press("p");
    await page.keyboard.press("Tab");
    for (let step = 0; step < 6; step++) await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Enter");
    await whenAddress(page, "view", "basins");
    assert.match(await page.textContent("#note"), /Fig\. 7/);
    await page.keyboard.press("t");
    assert.match(await page.textContent(".tour"), /Step 1 of 8/);
    await page.keyboard.press("ArrowRight");
    assert.match(await page.textContent(".tour"), /Step 2 of 8/);
    await page.keyboard.press("Escape");
    assert.equal(await page.isVisible(".tour"), false);
    await page.keyboard.press("?");
    assert.ok(await page.isVisible("dialog.help"));
    assert.match(await page.textContent("dialog.help"), /Phys\. Rev\. E 80, 046201 \(2009\)/);
    await page.keyboard.press("Escape");
    await page.keyboard.press("e");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("role")), "menuitem");
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => document.activeElement.id), "export-button");
    const field = page.locator("#field-friction");
    await field.focus();
    await page.keyboard.press("ArrowUp");
    await whenAddress(page, "friction", "0.601");
    // Keys that mean something elsewhere are letters in a field.
    await page.keyboard.type("p");
    assert.equal(await page.isVisible("dialog.presets"), false);
    await page.keyboard.press("Escape");
  }));

test("every control has a name, and the order of tabs has no trap", () =>
  clean({}, async (page) => {
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("button, input, select, [role=tab]")]
        .filter((one) => !(one.textContent.trim() || one.getAttribute("aria-label") || one.title || one.labels?.length))
        .map((one) => one.outerHTML),
    );
    assert.deepEqual(nameless, []);
    const seen = new Set();
    for (let step = 0; step < 200; step++) {
      await page.keyboard.press("Tab");
      seen.add(await page.evaluate(() => document.activeElement.id || document.activeElement.outerHTML.slice(0, 80)));
    }
    for (const id of ["tab-toss", "presets-button", "field-axial_forcing", "field-angular_speed"])
      assert.ok(seen.has(id), id);
  }));

test("a value outside of its range is refused where it is typed, with the range, and the picture stays", () =>
  clean({}, async (page) => {
    await settled(page);
    const before = await stateOf(page);
    for (const [name, text, expected] of [
      ["restitution", "1.2", /\[0, 1\)/],
      ["amplitude", "-0.1", /0/],
      ["angular_frequency", "0", /0/],
      ["friction", "abc", /not a number/],
      ["preload_acceleration", "1e400", /not a number/],
      ["amplitude", "1e12", /1e8|100000000/],
      ["mass", "-1", /0/],
      ["normalised_speed", "-2", /0/],
      ["phase_lag", "0x10", /not a number/],
      ["restitution", "0,5", /not a number/],
    ]) {
      await type(page, name, text);
      const error = page.locator(`#error-${name}`);
      await error.waitFor({ state: "visible" });
      assert.match(await error.textContent(), expected, `${name} = ${text}`);
      assert.equal(await page.getAttribute(`#field-${name}`, "aria-invalid"), "true");
      assert.equal(await page.inputValue(`#field-${name}`), text, "what was typed stays");
      assert.deepEqual(await stateOf(page), before);
      await page.keyboard.press("Escape");
      assert.equal(await error.isVisible(), false);
    }
  }));

test("multiples of pi, true minus signs and the forcing can be typed", () =>
  clean({}, async (page) => {
    await type(page, "phase_lag", "−0.25π");
    await whenAddress(page, "phase_lag", String(-0.25 * Math.PI));
    await type(page, "axial_forcing", "0.5");
    await whenAddress(page, "amplitude", String((0.5 * Math.PI * 9.8) / 225));
    assert.equal(Number(await page.inputValue("#field-axial_forcing")).toFixed(12), "0.500000000000");
  }));

test("a slider changes the state and makes one entry of the history", () =>
  clean({}, async (page) => {
    await settled(page);
    const before = await page.evaluate(() => [history.length, location.hash]);
    const slider = page.locator('[data-name="restitution"] input[type=range]');
    const box = await slider.boundingBox();
    await page.mouse.move(box.x + box.width * 0.5, box.y + box.height / 2);
    await page.mouse.down();
    for (let step = 1; step <= 20; step++) {
      await page.mouse.move(box.x + box.width * (0.5 + 0.015 * step), box.y + box.height / 2);
      await page.waitForTimeout(20);
    }
    await page.mouse.up();
    await page.waitForTimeout(600);
    const restitution = Number((await stateOf(page)).restitution);
    assert.ok(Math.abs(restitution - 0.76) < 0.05, String(restitution));
    assert.equal(await page.evaluate(() => history.length), before[0] + 1);
    await page.goBack();
    assert.equal(await page.evaluate(() => location.hash), before[1]);
  }));

test("back and forward lead through the states", () =>
  clean({}, async (page) => {
    await page.click("#tab-diagram");
    await page.waitForTimeout(400);
    await type(page, "friction", "0.25");
    await page.waitForTimeout(400);
    await page.click("#tab-motor");
    await page.waitForTimeout(400);
    await page.goBack();
    await page.waitForSelector('#tab-diagram[aria-selected="true"]');
    assert.equal(await page.inputValue("#field-friction"), "0.25");
    await page.goBack();
    await page.waitForFunction(() => document.getElementById("field-friction").value === "0.6");
    await page.goForward();
    await page.waitForFunction(() => document.getElementById("field-friction").value === "0.25");
    await page.goForward();
    await page.waitForSelector('#tab-motor[aria-selected="true"]');
  }));

test("from 360 to 2,560 pixels nothing sticks out, and the picture has room", () =>
  clean({}, async (page) => {
    const sizes = [
      [360, 640], [480, 800], [768, 1024], [1024, 700], [1280, 800], [1920, 1080], [2560, 1440],
    ]; // prettier-ignore
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      for (const view of VIEWS) {
        await page.click(`#tab-${view}`);
        await settled(page);
        const { wide, room } = await page.evaluate((name) => {
          const { width, height } = document.getElementById(`view-${name}`).getBoundingClientRect();
          return { wide: document.documentElement.scrollWidth - innerWidth, room: [width, height] };
        }, view);
        assert.ok(wide <= 0, `${view} at ${width}: ${wide} px too wide`);
        assert.ok(room[0] >= 0.6 * width && room[1] >= 300, `${view} at ${width}: ${room}`);
      }
    }
  }));

test("dark, light and automatic colours", () =>
  clean({ scheme: "dark" }, async (page) => {
    const scheme = () => page.evaluate(() => document.documentElement.dataset.scheme);
    assert.equal(await scheme(), "dark");
    await page.click("#theme-button");
    assert.equal(await scheme(), "light");
    await page.reload();
    await ready(page);
    assert.equal(await scheme(), "light", "it is kept");
    await page.click("#theme-button");
    assert.equal(await scheme(), "dark");
    await page.click("#theme-button");
    await page.emulateMedia({ colorScheme: "light" });
    await page.waitForFunction(() => document.documentElement.dataset.scheme === "light");
  }));

test("every file that a view offers can be saved, and is not empty", () =>
  clean({}, async (page) => {
    for (const view of VIEWS) {
      await page.click(`#tab-${view}`);
      await settled(page);
      // A view offers its files as soon as it has something to say.
      let count = 0;
      for (let tries = 0; count < 1 && tries < 40; tries++) {
        await page.waitForTimeout(tries === 0 ? 0 : 500);
        await page.click("#export-button");
        count = (await page.locator(".menu .items button").count()) - 1;
        await page.keyboard.press("Escape");
      }
      assert.ok(count >= 1, view);
      for (let item = 0; item < count; item++) {
        await page.click("#export-button");
        const [download] = await Promise.all([
          page.waitForEvent("download"),
          page.locator(".menu .items button").nth(item).click(),
        ]);
        assert.match(download.suggestedFilename(), /^[a-z0-9-]+\.(csv|json|svg|png)$/);
        const chunks = [];
        for await (const chunk of await download.createReadStream()) chunks.push(chunk);
        assert.ok(Buffer.concat(chunks).length > 10, download.suggestedFilename());
      }
    }
  }));

test("touch: sliders and tabs answer", () =>
  clean({ width: 390, height: 800, touch: true }, async (page) => {
    await page.tap("#tab-basins");
    await whenAddress(page, "view", "basins");
    await settled(page);
    await page.tap("details:nth-of-type(2) > summary");
    const box = await page.locator('[data-name="restitution"] input[type=range]').boundingBox();
    await page.touchscreen.tap(box.x + box.width * 0.25, box.y + box.height / 2);
    await page.waitForFunction(() => location.hash.includes("restitution=0.2"));
  }));
