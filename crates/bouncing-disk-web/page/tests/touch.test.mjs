/** Fingers: the disk is thrown by dragging it, and pictures are pinched, panned and tapped. */

import assert from "node:assert/strict";
import { boxOf, onPage, placeOfDisk, settled, stateOf, whenText } from "./browser.mjs";

/** A test on a telephone with a view, and `touch(kind, ...points)` for its fingers, in pixels of the window. */
function onTelephone(title, view, act) {
  const options = { hash: `#view=${view}`, width: 390, height: 840, hasTouch: true };
  onPage(title, options, async (page, context) => {
    const session = await context.newCDPSession(page);
    const touch = (type, ...points) =>
      session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await act(page, touch);
  });
}

async function middleOf(page, view) {
  const box = await boxOf(page, view);
  return [box.x + box.width / 2, box.y + box.height / 2];
}

const rangeOf = (text) => text.split(",").map(Number);

/** One finger from place to place, in steps as a finger makes them. */
async function drag(page, touch, from, to, steps = 8) {
  await touch("touchStart", from);
  for (let step = 1; step <= steps; step++) {
    await touch("touchMove", from.map((start, at) => start + ((to[at] - start) * step) / steps));
    await page.waitForTimeout(12);
  }
  await touch("touchEnd");
}

onTelephone("a finger on a paused disk throws it, and the page stays where it is", "toss", async (page, touch) => {
  await page.tap(".controls .play");
  await page.focus("#view-toss .picture canvas:last-child");
  await page.keyboard.press("Home");
  const from = await placeOfDisk(page);
  await drag(page, touch, from, [from[0] + 50, from[1] - 60]);
  await whenText(page, "#status", /^Thrown .* above/);
  const told = await page.textContent("#status");
  assert.match(told, /m\/s upwards relative to it, turning at \d/);
  assert.equal(await page.evaluate(() => scrollY), 0);
});

onTelephone("a finger on a moving disk, or beside it, scrolls the page", "toss", async (page, touch) => {
  const [x, y] = await placeOfDisk(page);
  await drag(page, touch, [x, y], [x, y - 150], 16);
  await page.waitForFunction(() => scrollY > 50);
  await page.evaluate(() => scrollTo(0, 0));
  const box = await boxOf(page, "toss");
  await drag(page, touch, [box.x + 20, box.y + box.height - 20], [box.x + 20, box.y - 150], 16);
  await page.waitForFunction(() => scrollY > 50);
  assert.doesNotMatch(await page.textContent("#status"), /Thrown/);
});

onTelephone("two fingers zoom the orbit diagram, and not the page", "diagram", async (page, touch) => {
  const [x, y] = await middleOf(page, "diagram");
  const before = rangeOf((await stateOf(page)).diagram_forcing);
  await touch("touchStart", [x - 30, y], [x + 30, y]);
  for (let step = 1; step <= 6; step++) {
    await touch("touchMove", [x - 30 - 10 * step, y], [x + 30 + 10 * step, y]);
    await page.waitForTimeout(20);
  }
  await touch("touchEnd");
  await page.waitForTimeout(600);
  const after = rangeOf((await stateOf(page)).diagram_forcing);
  const shrunk = (after[1] - after[0]) / (before[1] - before[0]);
  assert.ok(Math.abs(shrunk - 1 / 3) < 0.02, `the window is ${shrunk} of what it was`);
  assert.ok(after[0] > before[0] && after[1] < before[1], String(after));
  assert.equal(await page.evaluate(() => visualViewport.scale), 1);
  await settled(page);
  assert.match(await page.textContent("#status"), /^\d+ forcings in [\d.]+ s/);
});

onTelephone("one finger moves the orbit diagram, and a tap chooses a forcing", "diagram", async (page, touch) => {
  const [x, y] = await middleOf(page, "diagram");
  const before = rangeOf((await stateOf(page)).diagram_forcing);
  await drag(page, touch, [x, y], [x + 80, y]);
  await page.waitForTimeout(600);
  const after = rangeOf((await stateOf(page)).diagram_forcing);
  assert.ok(Math.abs(after[1] - after[0] - (before[1] - before[0])) < 1e-9, "it is moved and not zoomed");
  assert.ok(after[0] < before[0] - 0.05, `${before} to ${after}`);
  await settled(page);
  const { amplitude } = await stateOf(page);
  await page.touchscreen.tap(x + 60, y);
  await page.waitForFunction((old) => !location.hash.includes(`amplitude=${old}&`), amplitude);
  await whenText(page, "#view-diagram .facts", /impact/);
});
