/**
 * Makes the picture of the explorer for the README: a screenshot of a built page, in a state that its address records.
 *
 *     node dev/picture.mjs EXPLORER.html [PICTURE.png]
 *
 * It needs an installed Chromium; CHROMIUM says where, if not at /usr/bin/chromium.
 */

import { statSync } from "node:fs";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

/** The orbit diagram of Fig. 6 from the first bounces to chaos, the system at its own forcing. */
const STATE = [
  "view=diagram", "amplitude=0.0616", "twist_amplitude=0.9", "angular_frequency=15", "phase_lag=-0.8168",
  "contact_radius=0.135", "gyration_radius=0.11", "friction=0.6", "restitution=0.5", "preload_acceleration=9.8",
  "load_acceleration=0", "impact_phase=0.4", "normalised_speed=1.4", "angular_speed=0",
  "diagram_forcing=0.46,0.62", "diagram_quantity=impact_phase", "diagram_range=0,0.3", "diagram_branches=on",
].join("&"); // prettier-ignore
/** Where the cursor points, in shares of the picture: its orbit is read below. */
const CURSOR = { x: 0.36, y: 0.5 };
const SIZE = { width: 1280, height: 800 };
/** Bytes that a README may ask its readers to load. */
const MOST_BYTES = 250_000;

const DEFAULT = fileURLToPath(new URL("../../../../docs/figures/explorer.png", import.meta.url));

async function main() {
  const [html, picture = DEFAULT] = process.argv.slice(2);
  if (html === undefined) {
    console.error("usage: node dev/picture.mjs EXPLORER.html [PICTURE.png]");
    process.exitCode = 2;
    return;
  }
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--headless", "--no-sandbox", "--disable-gpu"],
  });
  try {
    const context = await browser.newContext({ viewport: SIZE, colorScheme: "light", reducedMotion: "reduce" });
    const page = await context.newPage();
    await page.goto(`${pathToFileURL(html).href}#${STATE}`);
    await page.waitForFunction(() => /forcings, /.test(document.getElementById("status")?.textContent ?? ""));
    await page.waitForFunction(() => /doubling at/.test(document.getElementById("view-diagram")?.textContent ?? ""));
    const canvas = page.locator("#view-diagram .picture canvas").last();
    const box = await canvas.boundingBox();
    if (box === null) throw new Error("the view has no picture");
    await page.mouse.move(box.x + CURSOR.x * box.width, box.y + CURSOR.y * box.height);
    await page.waitForFunction(() => /impacts? in/.test(document.querySelector(".facts")?.textContent ?? ""));
    await page.screenshot({ path: picture });
  } finally {
    await browser.close();
  }
  const { size } = statSync(picture);
  console.log(`${picture}: ${size} bytes`);
  if (size > MOST_BYTES) throw new Error(`the picture is larger than ${MOST_BYTES} bytes`);
}

await main();
