/** What is not known is shown and named: undecided cells, cycles that rounding chose, errors of numbers. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, opened, settled } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

async function within(hash, act, options = {}) {
  const { page, context, errors } = await opened(browser, { hash, ...options });
  try {
    await settled(page);
    await act(page);
    assert.deepEqual(errors, []);
  } finally {
    await context.close();
  }
}

/** The default system with the amplitude of this forcing. */
const forcing = (value) => `amplitude=${(value * Math.PI * 9.8) / 225}`;

/** At the fold of period 1 starts crawl past the orbit that is about to be born. */
const FOLD = `#view=basins&${forcing(1 / 3)}`;
const ROUNDED = forcing(2.73);

for (const scheme of ["light", "dark"])
  test(`undecided cells are striped, in the legend, in the words and under the cross: ${scheme}`, () =>
    within(
      FOLD,
      async (page) => {
        const entry = await page.locator(".attractors li:has(.undecided)").textContent();
        const [, share] = /([\d.]+) % of this window/.exec(entry);
        assert.match(entry, /^Undecided: not on any of these/);
        assert.ok(share > 1 && share < 10, entry);
        assert.match(await page.textContent("#view-basins .alternative"), new RegExp(`${share} % are undecided\\.$`));
        const { counts, place } = await page.evaluate(() => {
          const canvas = document.querySelector("#view-basins canvas");
          const style = getComputedStyle(document.documentElement);
          const wanted = ["--undecided", "--undecided-line"].map((name) => {
            const value = parseInt(style.getPropertyValue(name).trim().slice(1), 16);
            return [value >> 16, (value >> 8) & 255, value & 255];
          });
          const { width, height } = canvas;
          const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
          const is = (x, y, [red, green, blue]) => {
            const at = 4 * (y * width + x);
            return data[at] === red && data[at + 1] === green && data[at + 2] === blue;
          };
          const counts = [0, 0];
          let place = null;
          for (let y = 20; y < height - 50; y++)
            for (let x = 60; x < width - 20; x++)
              wanted.forEach((colour, index) => {
                if (!is(x, y, colour)) return;
                counts[index]++;
                // A place amid grey cells is one that a pointer hits.
                const amid = [-2, 2].every((by) => wanted.some((one) => is(x + by, y, one)));
                if (index === 0 && amid) place ??= [x / devicePixelRatio, y / devicePixelRatio];
              });
          return { counts, place };
        });
        const all = counts[0] + counts[1];
        assert.ok(counts[0] > 500 && counts[1] > 0.2 * all && counts[1] < 0.5 * all, `grey and stripes: ${counts}`);
        const box = await page.locator("#view-basins canvas").last().boundingBox();
        await page.mouse.move(box.x + place[0], box.y + place[1]);
        await page.waitForFunction(() => /: undecided\.$/.test(document.querySelector(".pointed").textContent));
      },
      { scheme },
    ));

test("where the whole window is decided, the words say so, and shares have their intervals", () =>
  within("#view=basins", async (page) => {
    assert.match(await page.textContent("#view-basins .alternative"), /; 0\.0 % are undecided\.$/);
    assert.match(await page.locator(".attractors li").first().textContent(), /% \(95 %: .* % to .* %\)/);
  }));

test("a cycle that rounding chose is called so under the cursor of the orbit diagram", () =>
  within(`#view=diagram&diagram_forcing=2.72999,2.73001&diagram_branches=off`, async (page) => {
    await page.focus("#view-diagram canvas[tabindex='0']");
    await page.keyboard.press("Shift+ArrowRight");
    const panel = page.locator("#view-diagram .panel");
    await panel.locator(".caution").waitFor({ state: "visible" });
    assert.match(await panel.locator(".caution").textContent(), /^Rounding-dependent: /);
    assert.match(await panel.textContent(), /\(chosen by rounding\)/);
    assert.match(await page.textContent("#announcer"), /rounding-dependent$/);
  }));

for (const [view, host] of [["basins", ".panel"], ["toss", ".toss-left"]])
  test(`a cycle that rounding chose is called so in the view ${view}, and others are not`, () =>
    within(`#view=${view}&${ROUNDED}`, async (page) => {
      const caution = page.locator(`#view-${view} ${host} .caution`);
      await caution.waitFor({ state: "visible" });
      assert.match(await caution.textContent(), /^Rounding-dependent: /);
      await page.fill("#field-axial_forcing", "0.45");
      await page.press("#field-axial_forcing", "Enter");
      await caution.waitFor({ state: "hidden" });
    })); // prettier-ignore

test("numbers that come of a sample or an average have their errors with them", () =>
  within("#view=motor", async (page) => {
    const fact = (name) =>
      page.evaluate(
        (wanted) =>
          [...document.querySelectorAll("#view-motor .facts dt")].find((one) => one.textContent === wanted)
            .nextElementSibling.textContent,
        name,
      );
    await page.waitForFunction(() => /±/.test(document.querySelector("#view-motor .facts").textContent));
    assert.match(await fact("Steady speed"), /^−?[\d.]+ ± [\d.]+ rad\/s without load$/);
    await page.waitForFunction(() => /±.*N m/.test(document.querySelector("#view-motor .facts").textContent));
    assert.match(await fact("Stall load"), /^\([\d.]+ ± [\d.]+\) .?N m$/);
  }));
