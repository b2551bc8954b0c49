/** Basins: what is seen is of the map that the form names, and shares say of which starts they are. */

import assert from "node:assert/strict";
import { onPage, pixelsOf, svgOf, type, whenKind, whenText } from "./browser.mjs";
import { patternOf, WORDS } from "./module.mjs";

/** What is asked by one of the calls in `window.holds` waits until `window.release()`, and other calls from then on. */
function holdable() {
  window.held = [];
  window.holds = [];
  const Original = window.Worker;
  window.Worker = class extends Original {
    postMessage(message, ...rest) {
      if (window.holds.includes(JSON.parse(message.request ?? "{}").call)) {
        window.held.push(() => super.postMessage(message, ...rest));
      } else super.postMessage(message, ...rest);
    }
  };
  window.release = (holds = []) => {
    window.holds = holds;
    for (const send of window.held.splice(0)) send();
  };
}

const CATEGORIES = Array.from({ length: 8 }, (_, index) => `--category-${index}`);

/** How many pixels of the picture have the colour of an attractor. */
const coloured = async (page) => (await pixelsOf(page, "#view-basins canvas", CATEGORIES)).length;

const hold = (page, ...calls) => page.evaluate((which) => (window.holds = which), calls);
const caption = (page) => page.textContent("#view-basins .alternative");
const FORCING = (value) => `amplitude=${(value * Math.PI * 9.8) / 225}`;
const DOUBLING = `#view=basins&${FORCING(0.486)}`;

onPage("no cell of another map stands under this legend", { hash: DOUBLING, script: holdable }, async (page) => {
  const before = await coloured(page);
  assert.ok(before > 10_000, `${before}`);
  assert.match(await caption(page), /^The starts/);
  const [all] = await page.locator("#view-basins .attractors small").allTextContents();
  assert.match(all, /^Of starts at speeds up to 2\.3: 65\.8 %/);
  // As long as the attractors are looked for, both are faint.
  await hold(page, "attractors", "basins");
  await type(page, "axial_forcing", "0.5");
  await page.waitForSelector("#view-basins .stale");
  await page.waitForTimeout(200);
  assert.ok((await coloured(page)) < before / 100, "old cells in full colours while attractors are looked for");
  assert.match(await caption(page), /0\.5 .*being computed/);
  // As soon as the new ones are known, the old cells are gone.
  await page.evaluate(() => window.release(["basins"]));
  await page.waitForSelector("#view-basins .stale", { state: "detached" });
  await page.waitForTimeout(200);
  assert.equal(await coloured(page), 0, "old cells under a new legend");
  assert.match(await caption(page), /being computed/);
  await page.evaluate(() => window.release());
  await whenText(page, "#view-basins .alternative", /^The starts/);
  assert.ok((await coloured(page)) > 10_000);
  // While the window of one map moves, its cells are stretched; they are right where they are.
  await hold(page, "basins");
  await page.click('#view-basins [aria-label="Zoom in"]');
  await page.waitForTimeout(300);
  assert.ok((await coloured(page)) > 10_000);
  assert.match(await caption(page), /being computed/);
}); // prettier-ignore

onPage("where no basins can be computed, none are shown", "#view=basins", async (page) => {
  await type(page, "restitution", "0.999999");
  await whenKind(page, "error", 120_000);
  await page.waitForTimeout(200);
  assert.equal(await coloured(page), 0);
  assert.equal(await page.locator(".attractors li").count(), 0);
  assert.match(await caption(page), /^There are no basins at/);
  await type(page, "restitution", "0.5");
  await whenText(page, "#view-basins .alternative", /^The starts/);
  assert.ok((await page.locator(".attractors li").count()) > 1);
}); // prettier-ignore

onPage("the share of the window is the answer, and that of all starts has a line of its own", DOUBLING, async (page) => {
  const entries = await page.locator(".attractors li").allTextContents();
  const { window, all, all_undecided, note } = WORDS.basins;
  const told = [`[\\d.]+ %${patternOf(window.replace("{share}", ""))}${patternOf(all)}$`, patternOf(all_undecided)];
  entries.forEach((entry, index) => assert.match(entry, new RegExp(told[index === entries.length - 1 ? 1 : 0])));
  assert.match(await page.textContent("#view-basins .panel"), new RegExp(patternOf(note, { starts: "1,024" })));
  // A window within the basin of the orbit of period 1.
  await page.evaluate(() => {
    location.hash = location.hash
      .replace(/basins_phase=[^&]*/, "basins_phase=0.116,0.118")
      .replace(/basins_speed=[^&]*/, "basins_speed=1.457,1.459");
  });
  await whenText(page, ".attractors", new RegExp(patternOf(window, { share: "100\\.0 %" })));
  const shares = (await page.locator(".attractors b").allTextContents()).map((text) => parseFloat(text));
  assert.equal(shares.reduce((sum, share) => sum + share), 100, `${shares}`);
  assert.equal(shares.length, await page.locator(".attractors li").count());
}); // prettier-ignore

onPage("printed basins have their map and a legend", DOUBLING, async (page) => {
  const svg = (await svgOf(page, "basins")).replaceAll(/<[^>]*>/g, " ").replaceAll(/\s+/g, " ");
  assert.match(svg, /Γ = 0\.486, ε = 0\.5/);
  const [words] = /^1\. [^.;:]*/.exec(await page.locator(".attractors li").first().textContent());
  assert.ok(svg.includes(words.trim().split(" ").slice(0, 4).join(" ")), `${words}: ${svg}`);
  for (const bold of await page.locator(".attractors b").allTextContents()) assert.ok(svg.includes(`${bold} of`), bold);
  assert.match(svg, /Undecided/);
});

onPage("attractors are numbered from one, as their texts name them", `#view=basins&${FORCING(0.51)}`, async (page) => {
  const [rest, ...others] = (await page.locator(".attractors li").allTextContents()).slice(0, -1);
  [rest, ...others].forEach((entry, index) => assert.ok(entry.startsWith(`${index + 1}. `), entry));
  const [, number] = /then attractor (\d+);/.exec(rest);
  const [target] = others[number - 2].replace(/^\d+\. /, "").split(/\.(?!\d)/);
  assert.ok(rest.includes(`leads to: ${target}.`), `${rest} ${target}`);
}); // prettier-ignore
