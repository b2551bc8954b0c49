/** Under load: the page never freezes, and survives a thousand changes. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { hashOf, onPage, settled, stateOf, stream, type, VIEWS, within } from "./browser.mjs";

const CHANGES = Number(process.env.EXPLORER_CHANGES ?? 1000);
const SPEEDS = "#view=diagram&diagram_quantity=normalised_speed&restitution=0.5";
/** Growth of the page's memory (bytes). */
const GROWTH = 50e6;

/**
 * The pixels of a view's pictures, and what is said of them; a view without animation has the same ones for the same
 * state. Not of buttons: their round corners are not always blended alike.
 */
const picture = (page, view) =>
  page.locator(`#view-${view}`).evaluate((host) => ({
    pixels: [...host.querySelectorAll("canvas")].map((canvas) => canvas.toDataURL()),
    words: host.querySelector(".alternative").textContent,
  }));

/** The long tasks of one round through all views, with the view in which each happened. */
const longTasks = () =>
  within({}, async (page) => {
    await page.evaluate(() => {
      globalThis.tasks = [];
      new PerformanceObserver((list) => {
        const view = document.querySelector("[role=tab][aria-selected=true]").id;
        for (const { duration } of list.getEntries()) globalThis.tasks.push(`${view}: ${duration} ms`);
      }).observe({ type: "longtask", buffered: false });
    });
    for (const view of VIEWS) {
      await page.click(`#tab-${view}`);
      await settled(page);
      // The last one is what the next view begins with: one whose basins are found soon.
      for (const forcing of ["0.4", "0.55", "0.5"]) {
        await type(page, "axial_forcing", forcing);
        await settled(page);
      }
    }
    return page.evaluate(() => globalThis.tasks);
  });

test("no task of the main thread takes longer than 50 ms while work goes on", { timeout: 600_000 }, async () => {
  // The browser's measure begins at 50 ms. It counts the time that a busy machine gives to others, so a round without
  // a long task shows that none is needed.
  const rounds = [];
  while (rounds.length < 4 && rounds.at(-1)?.length !== 0) rounds.push(await longTasks());
  assert.deepEqual(rounds.at(-1), [], JSON.stringify(rounds));
});

onPage("the range that nobody chose is that of the present orbits", SPEEDS, async (page) => {
  const first = await picture(page, "diagram");
  for (const restitution of ["0.9", "0.5"]) {
    await type(page, "restitution", restitution);
    await settled(page);
  }
  await page.evaluate(() => document.activeElement.blur());
  assert.deepEqual(await picture(page, "diagram"), first);
});

const RANGES = {
  axial_forcing: [0.2, 0.7], twist_amplitude: [0, 2], phase_lag: [-3, 3], restitution: [0, 0.9], friction: [0, 1],
  contact_radius: [0.05, 0.2], gyration_radius: [0.05, 0.2], load_acceleration: [-3, 3], impact_phase: [0, 6],
  normalised_speed: [0.1, 5], angular_speed: [-20, 20], mass: [0.1, 1],
}; // prettier-ignore
const MANY = "a thousand changes in a row: no error, no growth, and the last picture is that of a fresh page";

test(MANY, { timeout: 900_000 }, async () => {
  const random = stream(2009);
  const oneOf = (all) => all[Math.floor(random() * all.length)];
  const last = async (page) => {
    await page.mouse.move(5, 795);
    return { ...(await picture(page, "diagram")), state: await stateOf(page) };
  };
  const { left, hash } = await within({}, async (page) => {
    const memory = async () => {
      await page.evaluate(() => globalThis.gc());
      await page.waitForTimeout(300);
      await page.evaluate(() => globalThis.gc());
      return page.evaluate(() => performance.memory.usedJSHeapSize);
    };
    for (const view of VIEWS) {
      await page.click(`#tab-${view}`);
      await settled(page);
    }
    const before = await memory();
    for (let change = 0; change < CHANGES; change++) {
      if (random() < 0.15) await page.click(`#tab-${oneOf(VIEWS)}`);
      else {
        const [name, [low, high]] = oneOf(Object.entries(RANGES));
        const text = (low + random() * (high - low)).toPrecision(6);
        await page.locator(`#field-${name}`).evaluate((field, value) => {
          field.focus();
          field.value = value;
          field.dispatchEvent(new Event("change", { bubbles: true }));
        }, text);
      }
      // Mostly before the answers of the last change are there.
      if (random() < 0.3) await page.waitForTimeout(60 * random());
    }
    await page.click("#tab-diagram");
    await settled(page);
    await page.waitForTimeout(600);
    const grown = (await memory()) - before;
    assert.equal(await page.isVisible("#problems"), false, await page.textContent("#problems"));
    assert.ok(grown < GROWTH, `${grown / 1e6} MB`);
    return { left: await last(page), hash: await hashOf(page) };
  });
  assert.ok(left.pixels.length > 0);
  await within({ hash }, async (page) => {
    await page.waitForTimeout(300);
    assert.deepEqual(await last(page), left);
  });
});
