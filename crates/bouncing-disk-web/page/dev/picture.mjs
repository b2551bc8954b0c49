/**
 * Makes the picture of the explorer for the README: a screenshot of a built page, in a state that its address records.
 *
 *     node --test dev/picture.mjs
 *
 * EXPLORER_HTML, CHROMIUM and PICTURE say where the page, the browser and the picture are, if not at their usual places.
 */

import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { whenText, within } from "../tests/browser.mjs";

/** The orbit diagram of Fig. 6 from the first bounces to chaos, the system at its own forcing. */
const STATE = [
  "view=diagram", "amplitude=0.0616", "twist_amplitude=0.9", "angular_frequency=15", "phase_lag=-0.8168",
  "contact_radius=0.135", "gyration_radius=0.11", "friction=0.6", "restitution=0.5", "preload_acceleration=9.8",
  "load_acceleration=0", "impact_phase=0.4", "normalised_speed=1.4", "angular_speed=0",
  "diagram_forcing=0.46,0.62", "diagram_quantity=impact_phase", "diagram_range=0,0.3", "diagram_branches=on",
].join("&"); // prettier-ignore
/** Where the cursor points, in shares of the picture: its orbit is read below. */
const CURSOR = { x: 0.36, y: 0.5 };
/** Bytes that a README may ask its readers to load. */
const MOST_BYTES = 250_000;

const path = process.env.PICTURE ?? fileURLToPath(new URL("../../../../docs/figures/explorer.png", import.meta.url));

test("the picture of the explorer", () =>
  within({ hash: `#${STATE}`, reducedMotion: "reduce" }, async (page) => {
    await whenText(page, "#view-diagram", /doubling at/);
    const box = await page.locator("#view-diagram .picture canvas").last().boundingBox();
    await page.mouse.move(box.x + CURSOR.x * box.width, box.y + CURSOR.y * box.height);
    await whenText(page, ".facts", /impacts? in/);
    await page.screenshot({ path });
    assert.ok(statSync(path).size < MOST_BYTES, "the picture is too large");
  }));
