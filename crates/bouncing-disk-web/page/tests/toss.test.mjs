/** Toss and bounce: what it says of the motion, when it plays, what a throw is, and what is drawn. */

import assert from "node:assert/strict";
import {
  fact, hashOf, onPage, pixelsOf, placeOfDisk, preset, settled, stateOf, svgOf, type, visit, whenAddress, whenText,
  within,
} from "./browser.mjs"; // prettier-ignore
import { WORDS } from "./module.mjs";

const now = async (page) => Number.parseFloat(await fact(page, "toss", "Time"));

/** The disk moves on by itself: the time grows three times in a row, however slow the machine is. */
async function plays(page, what) {
  await page.evaluate(() => (window.times = []));
  const grows = () => {
    const time = Number.parseFloat(document.querySelectorAll("#view-toss .facts dd")[1].textContent);
    if (window.times.at(-1) !== time) window.times.push(time);
    const last = window.times.slice(-4);
    return last.length === 4 && last.every((one, index) => index === 0 || one > last[index - 1]);
  };
  await page.waitForFunction(grows, undefined, { timeout: 15_000 }).catch(async () => {
    assert.fail(`${what} stands: ${await page.evaluate(() => window.times)}`);
  });
  assert.equal(await page.textContent(".controls .play"), "Pause", what);
}

/** Goes to an instant, in periods. */
const seek = (page, periods) =>
  page.locator('[aria-label="Time in periods"]').evaluate((input, to) => {
    input.value = String(to);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, periods);

onPage("Fig. 9: the energy of a contact without an end is counted", {}, async (page) => {
  await preset(page, "fig09", 2);
  await whenText(page, "#view-toss", /of 48 periods/);
  // All of what it has after the impact at the start: (a_g q)^2/2 with 6.3 mm and 30 rad/s less some.
  await seek(page, 0);
  await page.waitForFunction(() => /^0\.00/.test(document.querySelectorAll("#view-toss .facts dd")[1].textContent));
  assert.equal(await fact(page, "toss", "Kinetic, rotary"), "17.8 mJ/kg");
  assert.equal(await fact(page, "toss", "Lost in friction"), "17.8 mJ/kg");
  assert.equal(await fact(page, "toss", "Stored in the disk"), "−17.8 mJ/kg");
  const end = Number(await page.getAttribute('[aria-label="Time in periods"]', "max"));
  assert.ok(end * 0.1 >= 4, `${end} periods of 0.1 s`);
  await seek(page, 45);
  await whenText(page, "#view-toss .facts dd", /slid|stick/);
  assert.equal(await fact(page, "toss", "Angular speed"), "0 rad/s", "what rounding leaves is nothing");
});

onPage("a motion that another view or a figure opens is seen to move", "#view=basins", async (page) => {
  const box = await page.locator("#view-basins canvas").last().boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await whenAddress(page, "view", "toss");
  await plays(page, "a start of the basins");
  await page.click("#tab-diagram");
  await preset(page, "fig09");
  await plays(page, "a figure");
});

onPage("a motion stands where it was left", {}, async (page) => {
  await plays(page, "the first motion");
  await visit(page, "diagram");
  await visit(page, "toss");
  const left = await now(page);
  assert.ok(left > 0);
  await page.waitForTimeout(300);
  assert.equal(await now(page), left);
  assert.equal(await page.textContent(".controls .play"), "Play");
});

onPage("a disk on soft hands goes into the contact", "#contact_time=0.06", async (page) => {
  await page.click(".controls .play");
  await seek(page, 0.05);
  await whenText(page, "#view-toss .facts", /Height above the platform−\d/);
});

onPage("a throw is in the address, and a link of it shows the same motion", {}, async (page) => {
  await page.click(".controls .play");
  await seek(page, 0);
  const [x, y] = await placeOfDisk(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y - 30, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => /throw=-?\d/.test(location.hash));
  await plays(page, "a throw");
  const state = await stateOf(page);
  // How fast the hand was depends on the machine.
  const [, gap, velocity, speed] = state.throw.split(",").map(Number);
  assert.ok(gap > 0 && velocity >= 0 && speed >= 0, state.throw);
  assert.match(await page.textContent("#status"), /^Thrown /);
  await within(await hashOf(page), async (copy) => {
    assert.deepEqual(await stateOf(copy), state);
    for (const name of ["Work of the platform", "Stored in the disk"])
      assert.equal(await fact(copy, "toss", name), await fact(page, "toss", name));
  });
  // Going back leads to the motion before, and so does the button.
  await page.getByRole("button", { name: WORDS.toss.back_to_impact }).click();
  await whenAddress(page, "throw", "none");
  await page.goBack();
  await whenAddress(page, "throw", state.throw);
  // The address is there before its state is.
  await page.getByRole("button", { name: WORDS.toss.back_to_impact }).waitFor();
  await type(page, "normalised_speed", "1.2"); // Another start takes its place.
  await whenAddress(page, "throw", "none");
});

onPage("Fig. 2: the path of a point of the platform is drawn, and opens with the lag", {}, async (page) => {
  await preset(page, "fig02", 0);
  await page.click(".controls .play");
  assert.match(await page.textContent("#view-toss .toss"), /path of a point of the platform, .* to 1\.31 rad and 177 mm on both sides/);
  /** The area that the exported path encloses, as a share of its own box. */
  const area = async () => {
    const [, path] = /<path d="M([^"]*)Z"[^>]*fill="none"/.exec(await svgOf(page, "path of the platform"));
    const places = path.split("L").map((text) => text.split(" ").map(Number));
    const sum = places.reduce((total, [x, y], index) => {
      const [nextX, nextY] = places[(index + 1) % places.length];
      return total + (x * nextY - nextX * y) / 2;
    }, 0);
    const side = (axis) => Math.max(...places.map((at) => at[axis])) - Math.min(...places.map((at) => at[axis]));
    return Math.abs(sum) / (side(0) * side(1));
  };
  // An ellipse with its axes along those of the picture has pi/4 of its box, a line nothing.
  assert.ok(Math.abs((await area()) - Math.PI / 4) < 0.01);
  await page.locator(".chip").nth(2).click();
  await settled(page);
  assert.ok((await area()) < 0.01);
  // On the screen it is in the corner.
  const pixels = await pixelsOf(page, "#view-toss .picture-scene canvas", ["--platform-line"], 39);
  const [width, side] = await page.$eval(".picture-scene canvas", (canvas) => [canvas.width, 110 * devicePixelRatio]);
  const drawn = pixels.filter(([x, y]) => x >= width - side && y < side).length;
  assert.ok(drawn > 20, `${drawn} pixels`);
}); // prettier-ignore

onPage("printed time traces stand on one axis of time", {}, async (page) => {
  const frame = /<rect x="([\d.]+)" y="[\d.]+" width="(\d{3}[\d.]*)" height="[\d.]+"[^>]*fill="none"/g;
  const places = [...(await svgOf(page, "time traces")).matchAll(frame)].map(([, left, width]) => `${left} ${width}`);
  assert.equal(places.length, 2);
  assert.equal(places[0], places[1]);
});

onPage("the plot of impacts is read by keyboard, and the wheel over it scrolls the page", { height: 500 }, async (page) => {
  const plot = page.locator("#view-toss .picture-portrait canvas").last();
  await plot.focus();
  await page.keyboard.press("Shift+ArrowRight");
  await whenText(page, "#view-toss .toss > :nth-child(4) .reading", /^phase 0\.520 periods, speed [\d.]+$/);
  await plot.hover();
  await page.mouse.wheel(0, 60);
  await page.waitForFunction(() => document.getElementById("main").scrollTop > 0);
});
