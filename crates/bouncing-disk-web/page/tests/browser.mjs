/** The installed Chromium and the built page, for all tests. */

import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const here = dirname(fileURLToPath(import.meta.url));

/** The page of the real module by EXPLORER_HTML; else one with a fake module, built here. */
function builtPage() {
  const given = process.env.EXPLORER_HTML;
  if (given) {
    if (!existsSync(given)) throw new Error(`EXPLORER_HTML is ${given}, which does not exist`);
    return given;
  }
  const out = mkdtempSync(join(tmpdir(), "explorer-"));
  const { status, stderr } = spawnSync(process.execPath, [join(here, "../build.mjs"), "--fake", "--out", out]);
  if (status !== 0) throw new Error(String(stderr));
  return join(out, "explorer.html");
}

export const isFake = !process.env.EXPLORER_HTML;
export const file = builtPage();
export const address = pathToFileURL(file).href;

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--js-flags=--expose-gc", "--enable-precise-memory-info",
    ],
  }); // prettier-ignore

/** A page, and what must not happen in it: errors and requests. */
export async function opened(browser, { hash = "", width = 1280, height = 800, scheme = "light", touch = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, hasTouch: touch });
  const page = await context.newPage();
  const errors = [];
  const requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith("blob:") && !url.startsWith("data:") && url.split("#")[0] !== address) requests.push(url);
  });
  await page.goto(address + hash);
  await ready(page);
  return { page, context, errors, requests };
}

/** The first state has been checked by the module, and a view shows it. */
export const ready = (page) => page.waitForSelector('[role="tab"][aria-selected="true"]');

/** Nothing is being computed any more; a motor's curves take longer than a test has to wait for. */
export async function settled(page) {
  // Views wait for 60 ms before they begin, so that a slider does not ask for all that it passes.
  await page.waitForTimeout(150);
  const timeout = (await page.isVisible("#view-motor")) ? 4000 : 60_000;
  try {
    await page.waitForFunction(() => document.getElementById("status").dataset.kind !== "busy", undefined, { timeout });
  } catch (error) {
    if (timeout === 60_000) throw error;
  }
  await page.waitForTimeout(40);
}

/** The state, as the address has it. */
export const stateOf = (page) =>
  page.evaluate(() =>
    Object.fromEntries(
      location.hash
        .slice(1)
        .split("&")
        .map((part) => part.split("=")),
    ),
  );

/** The address follows the state a little later when much changes at once. */
export async function whenAddress(page, name, value) {
  await page.waitForFunction(
    ([key, expected]) => new URLSearchParams(location.hash.slice(1)).get(key) === expected,
    [name, value],
    { timeout: 5000 },
  );
}

/** Types a number into a field of the form and confirms it. */
export async function type(page, name, text) {
  const field = page.locator(`#field-${name}`);
  await field.evaluate((input) => {
    input.closest("details").open = true;
  });
  await field.fill(text);
  await field.press("Enter");
}
