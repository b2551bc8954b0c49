/** Keyboard, screen reader, less motion and imposed colours. */

import assert from "node:assert/strict";
import { onPage, preset, settled, stateOf, VIEWS, visit, whenAddress, whenKind, whenText } from "./browser.mjs";

/** What a screen reader is told: the nodes of the accessibility tree that are not left out. */
async function spoken(page, context) {
  const session = await context.newCDPSession(page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  await session.detach();
  const text = (one) => one?.value ?? "";
  return nodes
    .filter(({ ignored }) => !ignored)
    .map(({ properties = [], ...one }) => ({
      ...Object.fromEntries(["role", "name", "description"].map((part) => [part, text(one[part])])),
      ...Object.fromEntries(properties.map(({ name, value }) => [name, value.value])),
    }));
}

const TITLES = ["Toss and bounce", "Orbit diagram", "Basins", "Motor", "Compare", "Scan"];
const CONTROLS = [
  "button", "slider", "textbox", "checkbox", "combobox", "tab", "application", "tabpanel", "dialog", "DisclosureTriangle",
  "region", "complementary",
]; // prettier-ignore
const PICTURES = { toss: 4, diagram: 1, basins: 1, motor: 4, compare: 3, scan: 1 };
const USABLE = "button, select, input, textarea, summary, canvas[tabindex='0']";

for (const view of VIEWS)
  onPage(`${view}: a screen reader is told a name of all, Tab reaches it, and the focus is seen`, {}, async (page, context) => {
    await visit(page, view);
    const told = await spoken(page, context);
    const nameless = told.filter(({ role, name }) => CONTROLS.includes(role) && name.trim() === "");
    assert.deepEqual(nameless, []);
    const tabs = told.filter(({ role }) => role === "tab").map(({ name, selected }) => [name, selected]);
    assert.deepEqual(tabs, TITLES.map((name, index) => [name, VIEWS[index] === view]));
    const shown = told.filter(({ role }) => role === "application");
    assert.equal(shown.length, PICTURES[view], JSON.stringify(shown));
    for (const { name } of shown) assert.match(name, /arrow|left and right/i, name);
    for (const role of ["banner", "complementary", "main", "heading", "status"])
      assert.ok(told.some((one) => one.role === role), role);
    assert.ok(told.some((one) => one.role === "textbox" && /axial forcing/.test(one.name)));
    assert.ok(told.some((one) => one.role === "slider" && /coefficient of friction, slider/.test(one.name)));
    const wanted = await page.evaluate((selector) => {
      const all = [...document.querySelectorAll(selector)].filter(
        (one) => one.checkVisibility() && !one.disabled && one.tabIndex >= 0,
      );
      all.forEach((one, index) => (one.dataset.test = String(index)));
      document.activeElement?.blur();
      return all.length;
    }, USABLE);
    const seen = new Set();
    for (let step = 0; step < wanted + 15; step++) {
      await page.keyboard.press("Tab");
      const { id, outline, name } = await page.evaluate(() => {
        const one = document.activeElement;
        const { outlineStyle, outlineWidth } = getComputedStyle(one);
        const outline = outlineStyle !== "none" && parseFloat(outlineWidth) >= 1;
        return { id: one.dataset.test, outline, name: one.outerHTML.slice(0, 80) };
      });
      if (id === undefined) continue;
      seen.add(id);
      assert.ok(outline, name);
    }
    assert.equal(seen.size, wanted);
  });

onPage("a refusal is an alert, belongs to its field and is told with it", {}, async (page, context) => {
  await page.fill("#field-restitution", "1.2");
  await page.press("#field-restitution", "Enter");
  await page.locator("#error-restitution").waitFor({ state: "visible" });
  const told = await spoken(page, context);
  assert.ok(told.some(({ role }) => role === "alert"));
  const field = told.find(({ role, name }) => role === "textbox" && /coefficient of restitution/.test(name));
  assert.equal(field.invalid, "true");
  assert.match(field.description, /must be at least 0 and less than 1\./);
});

onPage("the orbit diagram by keyboard: zoom, cross, choice", "#view=diagram", async (page) => {
  await page.focus("#view-diagram canvas[tabindex='0']");
  const width = async () => {
    const [low, high] = (await stateOf(page)).diagram_forcing.split(",").map(Number);
    return high - low;
  };
  const before = await width();
  const { diagram_forcing } = await stateOf(page);
  await page.keyboard.press("+");
  await page.waitForFunction((old) => !location.hash.includes(old), diagram_forcing);
  await page.waitForTimeout(500);
  assert.ok(Math.abs((await width()) - before / 2) < 1e-9);
  await settled(page);
  for (let step = 0; step < 4; step++) await page.keyboard.press("Shift+ArrowRight");
  await whenText(page, "#view-diagram [aria-live]", /^Γ 0\.\d+: 1 impact per period/);
  const facts = page.locator("#view-diagram .panel .facts");
  assert.match(await facts.textContent(), /Multipliers.*Exponent per impact−0\.\d+$/, "that of a periodic orbit");
  const { amplitude } = await stateOf(page);
  await page.keyboard.press("Enter");
  await page.waitForFunction((old) => !location.hash.includes(`amplitude=${old}&`), amplitude);
  await whenText(page, "#status", /has Γ = /);
  await page.keyboard.press("0");
  await page.waitForFunction(() => location.hash.includes("diagram_forcing=0.32,0.62"));
});

onPage("basins by keyboard: the cross tells an end, and Enter runs a start", "#view=basins", async (page) => {
  await page.focus("#view-basins canvas[tabindex='0']");
  await page.keyboard.press("Shift+ArrowUp");
  const live = page.locator("#view-basins .pointed");
  assert.equal(await live.getAttribute("aria-live"), "polite");
  assert.match(await live.textContent(), /^Phase 0\.5000 periods, speed 2\.600: (comes to rest|periodic orbit)/);
  await page.keyboard.press("Enter");
  await whenAddress(page, "view", "toss");
  assert.equal(Number((await stateOf(page)).normalised_speed).toFixed(3), "2.600");
});

onPage("the toss by keyboard: it pauses and steps, and says where the disk is", {}, async (page) => {
  await page.focus("#view-toss .picture-scene canvas[tabindex='0']");
  await page.keyboard.press(" ");
  const isTold = (pattern) => whenText(page, "#view-toss .hidden[aria-live]", pattern);
  await isTold(/^Mode: (flight|sticking|sliding \w+)\. Time: /);
  await page.keyboard.press("Home");
  await isTold(/Time: 0\.00 periods, .* Impacts so far: \d+\./);
  await page.keyboard.press("Shift+ArrowRight");
  await isTold(/Time: 1\.00 periods/);
  await page.keyboard.press("ArrowLeft");
  await isTold(/Time: 0\.94 periods/);
});

onPage("charts by keyboard: values are read one by one", { reducedMotion: "reduce" }, async (page) => {
  const chart = page.locator("#view-toss .chart").first();
  await chart.locator("canvas[tabindex='0']").focus();
  await page.keyboard.press("Home");
  const reading = chart.locator("[aria-live]");
  assert.match(await reading.textContent(), /^time \(periods of the platform\) 0: platform 23\.98, disk 23\.98$/);
  await page.keyboard.press("ArrowRight");
  assert.match(await reading.textContent(), /^time \(periods of the platform\) 0\.0/);
  assert.ok((await reading.boundingBox()).height > 10, "what is read is seen, too");
});

onPage("what goes on is not read out, what is done is, and the busy sign turns", "#view=basins", async (page) => {
  assert.equal(await page.getAttribute("#status", "aria-live"), "polite");
  assert.match(await page.textContent("#status"), /starts at Γ/);
  await page.click("#tab-motor");
  await whenKind(page, "busy");
  assert.equal(await page.getAttribute("#status", "aria-live"), "off");
  assert.equal(await page.evaluate(() => document.getAnimations().length), 1);
});

onPage("who wants less motion gets a picture that stands", { reducedMotion: "reduce" }, async (page) => {
  await page.locator("#view-toss .chart canvas").first().waitFor();
  await page.waitForFunction(() => /^7\.00 periods/.test(document.querySelectorAll("#view-toss .facts dd")[1].textContent));
  assert.equal(await page.textContent(".controls .play"), "Play");
  await page.waitForTimeout(300);
  assert.match(await page.locator("#view-toss .facts dd").nth(1).textContent(), /^7\.00 periods/);
  await page.click("#tab-motor");
  await whenKind(page, "busy");
  assert.deepEqual(await page.evaluate(() => document.getAnimations().map((one) => one.playState)), []);
  // Whoever presses the button wants it to move.
  await page.click("#tab-toss");
  await page.click(".controls .play");
  await page.waitForFunction(() => !/^7\.00 periods/.test(document.querySelectorAll("#view-toss .facts dd")[1].textContent));
});

onPage("imposed colours leave what colours say", { hash: "#view=basins", forcedColors: "active" }, async (page) => {
  const style = (selector, name) =>
    page.evaluate(
      ([wanted, property]) =>
        [...document.querySelectorAll(wanted)].map((one) => getComputedStyle(one).getPropertyValue(property)),
      [selector, name],
    );
  const swatches = await style(".attractors .swatch", "background-color");
  assert.equal(new Set(swatches).size, swatches.length, `each attractor has a colour: ${swatches}`);
  const lines = await style('[role="tab"]', "border-bottom-color");
  assert.equal(lines.filter((one) => one === lines[2]).length, 1, `the open tab is marked: ${lines}`);
  assert.deepEqual([...new Set(await style("input[type=range]", "appearance"))], ["auto"]);
  await preset(page, "fig07");
  const chips = await style(".chip", "background-color");
  assert.ok(new Set(chips).size === 2, `the open panel is marked: ${chips}`);
});
