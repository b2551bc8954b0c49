/** What people take away: links, pictures with their parameters, sheets to print, tables and frames. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { course, hashOf, onPage, preset, settled, stateOf, svgOf, textOf, type, within } from "./browser.mjs";

const PUBLISHED = "https://example.org/disk/explorer/";

/** The page keeps what it copies in `copied`. */
const COPYING = `Object.defineProperty(navigator, "clipboard", {
  value: { writeText: async (text) => void (globalThis.copied = text) },
});`;

/** As the build writes the address that it is given. */
const publish = (page) =>
  page.evaluate((href) => {
    document.head.append(Object.assign(document.createElement("link"), { rel: "canonical", href }));
  }, PUBLISHED);

async function copiedBy(page, act) {
  await page.evaluate(() => (globalThis.copied = undefined));
  await act();
  await page.waitForFunction(() => globalThis.copied !== undefined);
  return page.evaluate(() => globalThis.copied);
}

/** The pixels of the diagram, with the pointer out of its way. */
async function pictureOf(page) {
  await page.mouse.move(5, 795);
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(300);
  return page.locator("#view-diagram").screenshot();
}

onPage("a copied link shows the same in a fresh page, and leads to the published page if there is one", { script: COPYING }, async (page) => {
  await preset(page, "fig06");
  const copy = () => copiedBy(page, () => page.click("#link-button"));
  const link = await copy();
  assert.equal(link, await page.evaluate(() => location.href));
  assert.match(await page.textContent("#status"), /on this computer only/);
  const picture = await pictureOf(page);
  await within(link.slice(link.indexOf("#")), async (fresh) => {
    assert.deepEqual(await stateOf(fresh), await stateOf(page));
    assert.match(await fresh.textContent("#note"), /Fig\. 6/);
    assert.ok(picture.equals(await pictureOf(fresh)), "the pictures differ");
  });
  await publish(page);
  await page.click("#tab-toss");
  assert.equal(await copy(), PUBLISHED + (await hashOf(page)));
  assert.doesNotMatch(await page.textContent("#status"), /on this computer only/);
});

onPage("pictures say what they were computed with, and hold their link", "#view=toss&restitution=0.4&friction=0.25", async (page) => {
  await publish(page);
  const hash = await hashOf(page);
  for (const [name, has, hasNot] of [
    ["phase portrait", ["ε = 0.4,", "μ = 0.25,", "ω = 15 rad/s,", "wA = 1.4 × πg/ω,"], []],
    ["path of the platform", ["Φ = 0.9 rad,"], ["ε", "wA"]],
  ]) {
    const svg = await svgOf(page, name);
    const partOf = (part) => new RegExp(`<${part}>([^<]*)</${part}>`).exec(svg)[1];
    const words = partOf("desc").replaceAll("\u00a0", " ");
    for (const part of has) assert.ok(words.includes(part), `${part}: ${words}`);
    for (const part of hasNot) assert.ok(!words.includes(part), `${part}: ${words}`);
    assert.equal(partOf("metadata").replaceAll("&#38;", "&"), PUBLISHED + hash);
    // The same words can be read in the picture.
    const seen = svg.replaceAll(/<desc>.*?<\/metadata>/gs, "").replaceAll(/<[^>]*>/g, "").replaceAll(/\s/g, "");
    assert.ok(seen.includes(words.replaceAll(/\s/g, "")), seen);
  }
});

/** What a telephone reads from a photograph of the sheet, on which a module of the code has so many pixels. */
async function readFrom(page, pixelsPerModule, modules) {
  await page.emulateMedia({ media: "print" });
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("jsqr"), "utf8"));
  return page.locator(".printed svg").evaluate(
    async (svg, width) => {
      const image = new Image();
      image.src = `data:image/svg+xml,${encodeURIComponent(svg.outerHTML)}`;
      await image.decode();
      const canvas = new OffscreenCanvas(width, width).getContext("2d");
      // Out of focus by a quarter of a module, and pale.
      canvas.filter = `blur(${0.25 * (width / svg.viewBox.baseVal.width) * 10}px) contrast(60%)`;
      canvas.drawImage(image, 0, 0, width, width);
      return jsQR(canvas.getImageData(0, 0, width, width).data, width, width)?.data;
    },
    Math.round(pixelsPerModule * modules),
  );
}

/** A state whose numbers have all their digits: the longest links are like it. */
const LONG = `#view=diagram&amplitude=${0.2 / 3}&twist_amplitude=${1.3 / 3}&angular_frequency=${44 / 3}&phase_lag=${-1 / 3}\
&contact_radius=${0.4 / 3}&gyration_radius=${0.35 / 3}&friction=${1 / 3}&restitution=${1.1 / 3}&mass=${1.4 / 3}\
&impact_phase=${1 / 7}&normalised_speed=${9 / 7}&throw=${1 / 3},${1 / 7},${2 / 3},${8 / 7}&diagram_forcing=${1 / 3},${2 / 3}\
&diagram_range=${1 / 9},${7 / 9}&basins_phase=${1 / 7},${5 / 7}&basins_speed=${1 / 7},${31 / 7}`;

const PRINTING = "window.print = () => (globalThis.printed = true);";

async function print(page) {
  await page.evaluate(() => (globalThis.printed = false));
  await page.click("#export-button");
  await page.locator("dialog.export .card", { hasText: "sheet to print" }).click();
  await page.waitForFunction(() => globalThis.printed);
}

for (const [what, hash, least] of [["usual", "#view=basins", 500], ["long", LONG, 850]])
  onPage(`a sheet has pictures, parameters, room to write and a code of a ${what} link`, { hash, script: PRINTING }, async (page) => {
    await publish(page);
    const here = PUBLISHED + (await hashOf(page));
    assert.ok(here.length > least, `${here.length}`);
    await print(page);
    assert.equal(await page.isVisible(".printed"), false, "on the screen");
    const modules = await page.locator(".printed svg").evaluate((svg) => svg.viewBox.baseVal.width / 10);
    // Of 64 mm of paper, a quarter of what a camera with 3,000 pixels in a row sees.
    assert.ok(64 / modules > 0.5, `${64 / modules} mm`);
    assert.equal(await readFrom(page, 5, modules), here);
    assert.equal(await page.isVisible("header"), false);
    assert.ok(await page.isVisible(".printed img"));
    assert.match(await page.textContent(".printed dl"), /coefficient of restitution ε0\.(5|366667)/);
    assert.match(await page.textContent(".printed small"), /^https:\/\/example\.org.*restitution=/);
    assert.equal(await page.locator(".printed-line").count(), 3);
    await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
    assert.equal(await page.locator(".printed").count(), 0);
    assert.ok(await page.isVisible("header"));
  });

onPage("a sheet has the note or the task that is open, and a code where nothing is published, too", { script: PRINTING }, async (page) => {
  await preset(page, "fig02");
  await print(page);
  assert.match(await page.textContent(".printed-task"), /Fig\. 2/);
  await course(page, "feigenbaum");
  const answer = await page.textContent(".tour details p");
  await print(page);
  const task = await page.textContent(".printed-task");
  assert.match(task, /Feigenbaum's ratio, step 1 of 3/);
  assert.ok(task.includes(await page.textContent(".tour .text p:nth-of-type(2)")) && !task.includes(answer), task);
  assert.match(await page.textContent(".printed small"), /^#view=/);
  const modules = await page.locator(".printed svg").evaluate((svg) => svg.viewBox.baseVal.width / 10);
  assert.equal(await readFrom(page, 5, modules), await hashOf(page));
});

onPage("tables have distinct impacts and bifurcations, and the diagram copies the latter", { hash: "#view=diagram", script: COPYING }, async (page) => {
  const table = async (name) => {
    const [head, columns, ...rows] = (await textOf(page, name, "CSV")).trim().split("\n");
    return { given: JSON.parse(head.slice(2)), columns: columns.split(","), rows: rows.map((row) => row.split(",")) };
  };
  const impacts = await table("orbit diagram");
  const size = String(impacts.rows).length;
  assert.ok(size < 2e6, `${size}`);
  // Each forcing keeps its 200 impacts; where the disk bounces once in every period they are one row.
  const counts = new Map();
  for (const row of impacts.rows) counts.set(row[0], (counts.get(row[0]) ?? 0) + Number(row.at(-1)));
  assert.deepEqual([...new Set(counts.values())], [200]);
  const single = impacts.rows.filter(([forcing]) => forcing > 0.4 && forcing < 0.45);
  assert.ok(single.length > 50);
  for (const [forcing, phase, speed, , count] of single) {
    assert.equal(count, "200", forcing);
    assert.ok(Math.abs(speed - 4 / 3) <= impacts.given.rounded_to, speed);
    // The period-one orbit: its phase follows from its speed.
    assert.ok(Math.abs(Math.cos(phase) - (Math.PI * (1 - 0.5)) / (1 + 0.5) / (Math.PI * forcing)) < 1e-6, `${phase} at ${forcing}`);
  }
  const found = await table("doublings");
  assert.deepEqual(found.columns, ["kind", "axial_forcing", "impact_phase_rad", "normalised_speed"]);
  const doublings = found.rows.filter(([kind]) => kind === "doubling").map(([, forcing]) => Number(forcing));
  assert.ok(Math.abs(doublings[0] - Math.hypot(1 / 3, 20 / 18 / Math.PI)) < 1e-9, `${doublings[0]}`);
  assert.deepEqual(doublings, doublings.toSorted((one, other) => one - other));
  assert.ok((await table("branches")).rows.length > 1000);
  assert.match(await svgOf(page, "orbit diagram"), /dashed lines: unstable ones; .*doubling at 0\.4860/s);
  const copied = await copiedBy(page, () => page.click("text=Copy the bifurcations"));
  assert.deepEqual(copied.split("\n").map((row) => row.split("\t")), [found.columns, ...found.rows]);
});

/** An audio context that takes down what it is asked to play. */
const LISTENING = `
globalThis.tones = [];
globalThis.AudioContext = class {
  state = "suspended"; currentTime = 0; destination = {};
  resume() { this.state = "running"; }
  suspend() { this.state = "suspended"; }
};
globalThis.OscillatorNode = class {
  constructor(context, { frequency }) { tones.push(this.tone = { frequency, frame: document.timeline.currentTime }); }
  connect(gain) { this.tone.gain = gain.level; return gain; }
  start() {}
  stop() {}
};
globalThis.GainNode = class {
  gain = { setValueAtTime: (level) => void (this.level = level), linearRampToValueAtTime() {} };
  connect() {}
};`;

const DOUBLED = "#view=toss&amplitude=0.0684&normalised_speed=1.4";
onPage("impacts are heard while the motion plays, loud and soft in turn on a doubled period", { hash: DOUBLED, script: LISTENING }, async (page) => {
  const tonesOf = () => page.evaluate(() => globalThis.tones);
  const heard = async (count, share) => {
    await page.getByLabel("Speed of the animation").evaluate((slider, of) => {
      slider.value = slider.max * of;
      slider.dispatchEvent(new Event("input"));
    }, share);
    await page.waitForFunction((least) => globalThis.tones.length >= least, count, { timeout: 60_000 });
    return tonesOf();
  };
  await page.waitForTimeout(1000);
  assert.deepEqual(await tonesOf(), [], "off at the start");
  await page.check("text=Sound");
  const [one, two, three, four] = (await heard(30, 0.8)).slice(-4);
  assert.ok(Math.abs(one.frequency - three.frequency) < 2 && Math.abs(two.frequency - four.frequency) < 2);
  const [loud, soft] = one.frequency > two.frequency ? [one, two] : [two, one];
  assert.ok(loud.frequency > 1.05 * soft.frequency && loud.gain > 1.1 * soft.gain, JSON.stringify([loud, soft]));
  await page.click("text=Pause");
  const before = (await tonesOf()).length;
  await page.waitForTimeout(800);
  await page.focus("#view-toss canvas:last-child");
  for (let step = 0; step < 20; step++) await page.keyboard.press("Shift+ArrowRight");
  assert.equal((await tonesOf()).length, before, "silent where it stands still or jumps");
  await type(page, "restitution", "0.9"); // It chatters.
  await page.click('[aria-label="Back to the start"]');
  const tones = await heard(before + 20, 1);
  assert.equal(new Set(tones.map(({ frame }) => frame)).size, tones.length);
  assert.ok(tones.every(({ frequency, gain }) => frequency > 0 && gain > 0 && gain <= 0.2), JSON.stringify(tones));
});

onPage("a page in a frame shows the view alone, with a way to all of it", "#view=diagram&restitution=0.4", async (page, context) => {
  const hash = await hashOf(page);
  const own = await context.newPage();
  await own.setViewportSize({ width: 480, height: 360 });
  await own.goto((await page.evaluate(() => location.href)).replace("#", "?embed#"));
  await own.waitForSelector("#view-diagram canvas");
  await settled(own);
  for (const hidden of ["header", "#parameters", "#opening"]) assert.equal(await own.isVisible(hidden), false, hidden);
  const box = await own.locator("#view-diagram .picture").boundingBox();
  assert.ok(box.height > 150 && box.y + box.height <= 360 && box.width > 450, JSON.stringify(box));
  assert.equal(await own.evaluate(() => document.documentElement.scrollWidth), 480);
  const full = own.locator("text=Open in full");
  assert.ok(await full.isVisible());
  assert.equal(await full.getAttribute("href"), await page.evaluate(() => location.href));
  // What is done in the frame is no step of the page around it.
  const steps = await own.evaluate(() => history.length);
  await own.click('#view-diagram .picture-tools button >> nth=0');
  await own.waitForFunction((old) => location.hash !== old, hash);
  assert.equal(await own.evaluate(() => history.length), steps);
  assert.equal(await full.getAttribute("href"), (await own.evaluate(() => location.href)).replace("?embed", ""));
  await own.goto((await own.evaluate(() => location.href)).replace("=diagram", "=basins"));
  await settled(own);
  const { amplitude, normalised_speed } = await stateOf(own);
  await own.locator("#view-basins canvas").last().click();
  await own.waitForFunction((old) => !location.hash.includes(`=${old}&`), normalised_speed);
  assert.deepEqual([(await stateOf(own)).view, (await stateOf(own)).amplitude], ["basins", amplitude]);
});
