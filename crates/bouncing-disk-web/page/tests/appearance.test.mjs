/** What eyes and fingers need: contrast in both schemes, targets that can be hit, and the picture before the form. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { coloursOf, onPage, pixelsOf, settled, VIEWS, visit } from "./browser.mjs";

/** What the Web Content Accessibility Guidelines ask of text, and of lines and marks that carry meaning. */
const TEXT = 4.5;
const GRAPHIC = 3;
const TARGET = 40;

/** Red, green and blue in linear light. */
const linear = (colour) =>
  [1, 3, 5]
    .map((at) => parseInt(colour.slice(at, at + 2), 16) / 255)
    .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));

function luminance(colour) {
  const [red, green, blue] = linear(colour);
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

function contrast(one, other) {
  const [low, high] = [luminance(one), luminance(other)].sort((first, second) => first - second);
  return (high + 0.05) / (low + 0.05);
}

/** Every custom property with a colour that the sources name. */
const THEME = readFileSync(new URL("../src/styles/theme.css", import.meta.url), "utf8");
const NAMES = [...THEME.matchAll(/(--[\w-]+): [^;]*#/g)].map(([, name]) => name);

const PAPER = ["--picture-paper"];
const GROUNDS = ["--background", "--panel", "--soft", "--error-soft", "--note"];
/** Which colours stand on which, and how much they have to differ from them. */
const PAIRS = [
  ...["--ink", "--muted", "--accent", "--error"].map((name) => [name, GROUNDS, TEXT]),
  ["--on-accent", ["--accent"], TEXT],
  ["--edge", ["--background", "--panel"], GRAPHIC],
  ...["--picture-text", "--picture-muted", "--warning", "--stall"].map((name) => [name, PAPER, TEXT]),
  ["--picture-text", ["--runaway"], TEXT],
  ["--warning", ["--panel"], TEXT],
  ...[
    "--picture-frame", "--picture-cursor", "--picture-selection", "--disk", "--disk-side", "--platform-mark",
    "--platform-line", "--impact", "--impact-now", "--branch-stable", "--branch-unstable", "--bifurcation",
    "--density-0", "--density-1", "--density-2", "--density-3", "--density-4", "--curve-speed", "--curve-power",
    "--curve-input", "--curve-efficiency",
  ].map((name) => [name, PAPER, GRAPHIC]),
  ["--disk-mark", ["--disk"], GRAPHIC],
  ["--undecided-line", ["--undecided"], GRAPHIC],
  ["--attractor-mark", ["--attractor-halo"], GRAPHIC],
]; // prettier-ignore

for (const scheme of ["light", "dark"])
  onPage(`text and pictures stand out from their grounds: ${scheme}`, { colorScheme: scheme }, async (page) => {
    const values = await coloursOf(page, NAMES);
    const colours = Object.fromEntries(NAMES.map((name, index) => [name, values[index]]));
    const weak = [];
    for (const [name, grounds, least] of PAIRS)
      for (const ground of grounds) {
        const found = contrast(colours[name], colours[ground]);
        if (!(found >= least)) weak.push(`${name} on ${ground}: ${found.toFixed(2)}, not ${least}`);
      }
    assert.deepEqual(weak, []);
  });

onPage("the categories of basins differ for every kind of colour vision", {}, async (page) => {
  // Viénot's projections in linear light: without long, without middle waves.
  const blind = {
    protanope: [[0.11238, 0.88762, 0], [0.11238, 0.88762, 0], [0.00401, -0.00401, 1]],
    deuteranope: [[0.29275, 0.70725, 0], [0.29275, 0.70725, 0], [-0.02234, 0.02234, 1]],
    all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  }; // prettier-ignore
  for (const scheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme: scheme });
    const names = Array.from({ length: 8 }, (_, index) => `--category-${index}`);
    const colours = await coloursOf(page, names);
    for (const [kind, matrix] of Object.entries(blind)) {
      const seen = colours.map((colour) => {
        const light = linear(colour);
        const sums = matrix.map((row) => row.reduce((sum, one, at) => sum + one * light[at], 0));
        return sums.map((sum) => Math.cbrt(Math.max(0, sum)));
      });
      for (let one = 0; one < 8; one++)
        for (let other = 0; other < one; other++) {
          const apart = Math.hypot(...seen[one].map((part, at) => part - seen[other][at]));
          assert.ok(apart > 0.1, `${scheme}, ${kind}: categories ${other} and ${one} are ${apart.toFixed(3)} apart`);
        }
    }
  }
});

const PHONE = { width: 360, height: 740, hasTouch: true };
onPage("on a telephone the picture comes first, and what is tapped has 40 pixels at least", PHONE, async (page) => {
  assert.ok(await page.evaluate(() => matchMedia("(pointer: coarse)").matches), "the page believes in fingers");
  const small = (least) => {
    const wanted = "button, select, summary, input:not([type=checkbox], [type=file]), label:has([type=checkbox])";
    return [...document.querySelectorAll(wanted)]
      .filter((one) => one.checkVisibility() && !one.disabled)
      .map((one) => [one.getBoundingClientRect(), one])
      .filter(([box]) => box.width < least - 0.5 || box.height < least - 0.5)
      .map(([box, one]) => `${one.id || one.outerHTML.slice(0, 60)}: ${box.width} x ${box.height}`);
  };
  const isLarge = async (where) => assert.deepEqual(await page.evaluate(small, TARGET), [], where);
  for (const view of VIEWS) {
    await visit(page, view, "tap");
    const seen = await page.evaluate((name) => {
      const boxOf = (element) => element.getBoundingClientRect();
      const picture = boxOf(document.querySelector(`#view-${name} canvas`));
      return {
        top: picture.top + scrollY,
        right: picture.right,
        form: boxOf(document.getElementById("parameters")).top + scrollY,
        open: [...document.querySelectorAll("aside details[open]")].map((one) => one.className),
        sliders: boxOf(document.querySelector(".essentials")).bottom,
        tabs: [...document.querySelectorAll('[role="tab"]')].map((tab) => boxOf(tab).right),
      };
    }, view);
    assert.ok(seen.top < 250, `${view} begins at ${seen.top}`);
    assert.ok(seen.right <= 360 && Math.max(...seen.tabs) <= 360, JSON.stringify(seen));
    assert.ok(seen.form > seen.top + 250, `${view}: the form is at ${seen.form}`);
    // The three sliders wait under the thumb.
    assert.deepEqual([seen.open, seen.sliders], [[], 740]);
    await isLarge(view);
  }
  await page.tap(".essentials summary");
  assert.equal(await page.locator(".essentials").evaluate((group) => group.getBoundingClientRect().bottom), 740);
  await page.locator("aside details").evaluateAll((all) => all.forEach((one) => (one.open = true)));
  await isLarge("all fields");
  await page.tap("#presets-button");
  await isLarge("figures");
  await page.locator("dialog.presets .card").first().tap();
  await settled(page);
  await isLarge("note");
  await page.tap("#courses-button");
  await page.tap("[data-course='doubling']");
  await isLarge("lesson");
});

onPage("on a telephone the inset leaves the disk free", { ...PHONE, reducedMotion: "reduce" }, async (page) => {
  const canvas = "#view-toss .picture-scene canvas";
  const disk = await pixelsOf(page, canvas, ["--disk"]);
  const path = await pixelsOf(page, canvas, ["--platform-line"], 39);
  const [right, left] = [Math.max(...disk.map(([x]) => x)), Math.min(...path.map(([x]) => x))];
  assert.ok(path.length > 20 && right < left, `${right}, ${left}`);
});
