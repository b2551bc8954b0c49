/** What is not known is shown and named: undecided cells, cycles that rounding chose, errors of numbers. */

import assert from "node:assert/strict";
import { pixelsOf, type, whenText, onPage } from "./browser.mjs";
import { patternOf, WORDS } from "./module.mjs";

/** The default system with the amplitude of this forcing. */
const forcing = (value) => `amplitude=${(value * Math.PI * 9.8) / 225}`;

/** At the fold of period 1 starts crawl past the orbit that is about to be born. */
const FOLD = `#view=basins&${forcing(1 / 3)}`;
const ONE_FORCING = "#view=diagram&diagram_forcing=2.72999,2.73001&diagram_branches=off";
const PICTURE = "#view-basins canvas";
const ROUNDED = forcing(2.73);

for (const scheme of ["light", "dark"])
  onPage(`undecided cells are striped and said: ${scheme}`, { hash: FOLD, colorScheme: scheme }, async (page) => {
    const entry = await page.locator(".attractors li:has(.undecided)").textContent();
    const [, share] = new RegExp(patternOf(WORDS.basins.window, { share: "([\\d.]+) %" })).exec(entry);
    assert.ok(entry.startsWith(WORDS.basins.undecided), entry);
    assert.ok(share > 1 && share < 10, entry);
    const names = ["--undecided", "--undecided-line"];
    const pixels = await Promise.all(names.map((name) => pixelsOf(page, PICTURE, [name])));
    // Inside of the axes, whose lines have the colour of the stripes.
    const [width, height] = await page.$eval(PICTURE, (canvas) => [canvas.width, canvas.height]);
    const isInside = ([x, y]) => x >= 60 && x < width - 20 && y >= 20 && y < height - 50;
    const inner = pixels.map((all) => all.filter(isInside));
    const [grey, stripes] = inner.map(({ length }) => length);
    // A place amid grey cells is one that a pointer hits.
    const known = new Set(inner.flat().map(String));
    const place = inner[0].find(([x, y]) => known.has(`${x - 2},${y}`) && known.has(`${x + 2},${y}`));
    assert.ok(grey > 500 && stripes > 0.25 * grey && stripes < grey, `grey and stripes: ${[grey, stripes]}`);
    const box = await page.locator("#view-basins canvas").last().boundingBox();
    await page.mouse.move(box.x + place[0], box.y + place[1]);
    await whenText(page, ".pointed", /: undecided\.$/);
  });

onPage("a cycle that rounding chose is called so under the cursor", ONE_FORCING, async (page) => {
  await page.focus("#view-diagram canvas[tabindex='0']");
  await page.keyboard.press("Shift+ArrowRight");
  const panel = page.locator("#view-diagram .panel");
  await panel.locator("[aria-live] .caution").waitFor({ state: "visible" });
  assert.match(await panel.locator(".caution").textContent(), /^Rounding-dependent: /);
  assert.match(await panel.textContent(), /\(chosen by rounding\)/);
});

for (const [view, host] of [["basins", ".panel"], ["toss", ".toss"]])
  onPage(`a cycle that rounding chose is called so in ${view}`, `#view=${view}&${ROUNDED}`, async (page) => {
    const caution = page.locator(`#view-${view} ${host} .caution`);
    await caution.waitFor({ state: "visible" });
    assert.match(await caution.textContent(), /^Rounding-dependent: /);
    await type(page, "axial_forcing", "0.45");
    await caution.waitFor({ state: "hidden" });
  }); // prettier-ignore
