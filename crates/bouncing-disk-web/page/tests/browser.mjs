/** The installed Chromium and the built page, for all tests. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { file } from "./module.mjs";

const address = pathToFileURL(file).href;

export const VIEWS = ["toss", "diagram", "basins", "motor", "compare", "scan"];

let browser;
before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--disable-gpu", "--js-flags=--expose-gc", "--enable-precise-memory-info"],
  });
});
after(() => browser.close());

/**
 * Opens a page that is settled, unless `settle` is false, and acts on it; there must be no errors in it, and nothing
 * that it asks of anybody. `script` runs in the page before its own; other options are those of a browser's context.
 * A hash alone may stand for the options.
 */
export async function within(given, act) {
  const wanted = typeof given === "string" ? { hash: given } : given;
  const { hash = "", to = address, width = 1280, height = 800, settle = true, script, ...options } = wanted;
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: "light", ...options });
  if (script !== undefined) await context.addInitScript(script);
  const page = await context.newPage();
  const [errors, requests] = [[], []];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => {
    const url = request.url();
    if (!/^(blob|data):/.test(url) && !url.startsWith(to)) requests.push(url);
  });
  try {
    await page.goto(to + hash);
    await ready(page);
    if (settle) await settled(page);
    const result = await act(page, context);
    assert.deepEqual([errors, requests], [[], []]);
    return result;
  } finally {
    await context.close();
  }
}

/** A test of what happens on such a page. */
export const onPage = (title, options, act) => test(title, () => within(options, act));

/** The first state has been checked by the module, and a view shows it. */
export const ready = (page) => page.waitForSelector('[role="tab"][aria-selected="true"]');

export const whenKind = (page, kind, timeout = 30_000) =>
  page.waitForFunction((wanted) => document.getElementById("status").dataset.kind === wanted, kind, { timeout });

export async function isCalm(page) {
  assert.equal(await page.isVisible("#problems"), false, await page.textContent("#problems"));
  assert.notEqual(await page.getAttribute("#status", "data-kind"), "error", await page.textContent("#status"));
}

/** The place of a view's first picture in the window: its upper layer, which takes the pointer and the keyboard. */
export const boxOf = (page, view) => page.locator(`#view-${view} .picture canvas:last-child`).first().boundingBox();

/** Nothing is being computed any more; a motor's curves take longer than a test has to wait for. */
export async function settled(page) {
  // Views wait for 60 ms before they begin, so that a slider does not ask for all that it passes.
  await page.waitForTimeout(150);
  const isMotor = await page.isVisible("#view-motor");
  const isDone = () => document.getElementById("status").dataset.kind !== "busy";
  const done = page.waitForFunction(isDone, undefined, { timeout: isMotor ? 4000 : 60_000 });
  await (isMotor ? done.catch(() => {}) : done);
  await page.waitForTimeout(40);
}

/** Opens a view by its tab and waits for its picture; the charts of a motor are there when its run-up is. */
export async function visit(page, view, act = "click") {
  await page[act](`#tab-${view}`);
  await page.locator(`#view-${view} canvas`).first().waitFor();
  await settled(page);
}

export async function preset(page, id, panel = 0) {
  await page.click("#presets-button");
  await page.click(`[data-preset="${id}"]`);
  await page.waitForSelector("#note:not([hidden])");
  if (panel > 0) await page.locator(".chip").nth(panel).click();
  await settled(page);
}

/** Begins the tour or a lesson. */
export async function course(page, id) {
  await page.click("#courses-button");
  await page.click(`[data-course="${id}"]`);
}

export const hashOf = (page) => page.evaluate(() => location.hash);
export const stateOf = async (page) =>
  Object.fromEntries((await hashOf(page)).slice(1).split("&").map((part) => part.split("=")));

/** The address follows the state a little later when much changes at once. */
export const whenAddress = (page, name, value) => {
  const has = ([key, wanted]) => new URLSearchParams(location.hash.slice(1)).get(key) === wanted;
  return page.waitForFunction(has, [name, value], { timeout: 5000 });
};

export const whenText = (page, selector, pattern, timeout = 30_000) => {
  const has = ([wanted, source]) => new RegExp(source).test(document.querySelector(wanted)?.textContent ?? "");
  return page.waitForFunction(has, [selector, pattern.source], { timeout });
};

export async function type(page, name, text) {
  const field = page.locator(`#field-${name}`);
  await field.evaluate((input) => (input.closest("details").open = true));
  await field.fill(text);
  await field.press("Enter");
}

/** The number of the state, which a field has in its title with all digits, and when it is there. */
export const valueOf = (page, name) => page.getAttribute(`#field-${name}`, "title");
export const whenValue = (page, name, text) =>
  page.waitForFunction(([id, value]) => document.getElementById(id).title === value, [`field-${name}`, text]);

/** What stands beside a name in a view's list of facts. */
export const fact = (page, view, name) =>
  page.locator(`#view-${view} .facts div:has(dt:text-is("${name}")) dd`).textContent();

/** Colours of custom properties in the present scheme, as `#rrggbb`. */
export const coloursOf = (page, names) =>
  page.evaluate((wanted) => {
    const style = getComputedStyle(document.documentElement);
    return wanted.map((name) => {
      const [light, dark = light] = style.getPropertyValue(name).match(/#[0-9a-f]{6}/g);
      return matchMedia("(prefers-color-scheme: dark)").matches ? dark : light;
    });
  }, names);

/** The pixels of a picture that have one of these colours, within `slack` of each byte: `[x, y]`, in device pixels. */
export const pixelsOf = async (page, selector, names, slack = 0) =>
  page.evaluate(
    ([wanted, hexadecimal, most]) => {
      const canvas = document.querySelector(wanted);
      const { width, height } = canvas;
      // A copy: the picture itself is not made for being read.
      const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, width, height);
      const bytes = hexadecimal.map((colour) => [1, 3, 5].map((from) => parseInt(colour.slice(from, from + 2), 16)));
      const is = (at) => bytes.some((one) => one.every((byte, index) => Math.abs(data[at + index] - byte) <= most));
      const found = [];
      for (let at = 0; at < data.length; at += 4)
        if (is(at)) found.push([(at / 4) % width, Math.floor(at / 4 / width)]);
      return found;
    },
    [selector, await coloursOf(page, names), slack],
  );

/** The middle of what has the colour of the disk, in the window: there it answers to the pointer. */
export async function placeOfDisk(page) {
  await page.waitForTimeout(100);
  const box = await boxOf(page, "toss");
  const pixels = await pixelsOf(page, "#view-toss .picture canvas", ["--disk"]);
  const ratio = await page.evaluate(() => devicePixelRatio);
  const middle = (axis) => pixels.reduce((sum, at) => sum + at[axis], 0) / pixels.length / ratio;
  return [box.x + middle(0), box.y + middle(1)];
}

/** The file that a card of the list of files gives. */
export async function savedBy(page, card) {
  const [download] = await Promise.all([page.waitForEvent("download"), card.click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return { name: download.suggestedFilename(), content: Buffer.concat(chunks) };
}

/** The text of what a view offers by this name in this form (SVG, CSV, JSON). */
export async function textOf(page, name, form) {
  await page.click("#export-button");
  const card = page.locator("dialog.export .card", { hasText: name }).filter({ hasText: form }).first();
  return String((await savedBy(page, card)).content);
}
export const svgOf = (page, name) => textOf(page, name, "SVG");

/** A seeded stream of numbers in [0, 1), so that a failure comes back. */
export function stream(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
