/** Links reproduce states to the bit, and what is broken in them is said and left out. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { hashOf, onPage, settled, stateOf, stream, valueOf, whenValue, within } from "./browser.mjs";
import { WORDS } from "./module.mjs";

onPage("states with awkward numbers come back to the bit", {}, async (page) => {
  const random = stream(7);
  for (let round = 0; round < 25; round++) {
    const positive = () => 10 ** (random() * 2 - 1) * (1 + random());
    const wanted = {
    view: ["toss", "diagram", "basins", "compare"][Math.floor(4 * random())],
    amplitude: 0.06 * (1 + random() / 3), twist_amplitude: positive(), angular_frequency: 15,
    phase_lag: -3 * random(),
    contact_radius: positive(), gyration_radius: positive(), friction: random() / 3, restitution: random() * 0.9,
    preload_acceleration: 9.8 + random(), load_acceleration: random() - 0.5,
    contact_time: round % 4 ? 0 : random() / 9, mass: positive(),
    impact_phase: 6 * random(), normalised_speed: positive(), angular_speed: -5e-324 * (round % 2),
    throw: round % 3 ? `${6 * random()},${random() / 3},${random() - 0.5},${-5e-324 * (round % 2)}` : "none",
    diagram_forcing: `${0.3 + random() / 10},${0.5 + random() / 10}`, diagram_quantity: "impact_phase",
    diagram_range: round % 2 ? "all" : `${-random()},${1 + random()}`, diagram_branches: round % 2 ? "on" : "off",
    diagram_drive: ["sine", "triangle", "sawtooth", "parabolas"][round % 4],
    basins_phase: `${random() / 3},${0.5 + random() / 3}`, basins_speed: `${random()},${3 + random()}`,
    motor_rise_times: String(1 + 5 * random()),
    motor_stator: round % 3 ? "none" : encodeURIComponent(`{"kind":"axial","mass":${positive()},"quality":${1 + random()}}`),
    compare_parameter: ["restitution", "stroke", "mass"][round % 3], compare_value: random(), compare_periods: "30",
    compare_from: round % 2 ? "parting" : 9 * random(),
    scan_over: ["contact_time", "impact_phase"][round % 2], scan_range: `${-random()},${random()}`, scan_points: "2",
    scan_result: ["orbit_period", "motor_power"][round % 2],
    scan_family: ["none", "phase_lag"][round % 2], scan_values: `${random()},${-5e-324 * (round % 2)}`,
  }; // prettier-ignore
    const hash = `#${Object.entries(wanted)
      .map(([key, value]) => `${key}=${Object.is(value, -0) ? "-0" : value}`)
      .join("&")}`;
    await page.evaluate((next) => (location.hash = next), hash);
    await page.waitForFunction((view) => document.querySelector(`#tab-${view}[aria-selected="true"]`), wanted.view);
    await whenValue(page, "amplitude", String(wanted.amplitude));
    assert.equal(await hashOf(page), hash);
    for (const name of ["contact_radius", "gyration_radius", "restitution", "impact_phase", "mass", "phase_lag"])
      assert.equal(Number(await valueOf(page, name)), wanted[name], name);
    assert.equal(await page.isVisible("#problems"), false);
  }
});

const UNREADABLE = ["throw must be none, or", "four numbers"];
/** Links, the parts of the state that they lead to, and what is said of them. */
const LINKS = [
  [
    "view=diagram&friction=0.3&restitution=1.5&amplitude=abc&nonsense=1&mass=1&mass=2&basins_speed=5,1" +
      "&diagram_quantity=%E0%A4%A&gyration_radius=0x1",
    { view: "diagram", friction: "0.3", mass: "1", restitution: "0.5", basins_speed: "0,5" },
    ["abc", "nonsense", "twice", "5,1", "diagram_quantity", "0x1"],
  ],
  // What the library refuses: a start on the platform that goes into it, and a flight that takes too long.
  ...[
    ["1,2", UNREADABLE],
    ["1,0.1,0.5,x", UNREADABLE],
    ["1,0.1,0.5,2,3", UNREADABLE],
    ["1,-0.1,0.5,2", [UNREADABLE[0], "gap from 0 up"]],
    ["1,0.1,1e999,2", UNREADABLE],
    ["", UNREADABLE],
    ["1,0,-1,2", ["not possible"]],
    ["1,0.1,1e300,2", ["not possible"]],
    ["1,0.1,0.5,1e300", ["not possible"]],
  ].map(([text, said]) => [
    `friction=0.3&throw=${text}&normalised_speed=1.1`,
    { throw: "none", friction: "0.3", normalised_speed: "1.1" },
    said,
  ]),
  [
    "compare_parameter=colour&compare_value=x&compare_periods=0&compare_from=-1&scan_over=&scan_range=2,1&friction=0.3",
    { compare_parameter: "normalised_speed", compare_from: "parting", scan_over: "amplitude_angle", friction: "0.3" },
    ["colour", "compare_value", "compare_periods", "compare_from", "scan_over", "2,1"],
  ],
  [
    "scan_points=1.5&scan_result=weight&scan_family=all&scan_values=1,2,3,4,5,6&friction=0.3",
    { scan_points: "41", scan_result: "toss_speed", scan_family: "phase_lag", friction: "0.3" },
    ["1.5", "weight", "scan_family", "up to 5 numbers"],
  ],
  ["restitution=0&contact_time=0.03&friction=0.3", { restitution: "0.5", friction: "0.3" }, ["restitution of a compliant contact"]],
  // No double holds the first, and the second would silently be 0.
  ["friction=1e400&restitution=1e-400", { friction: "0.6", restitution: "0.5" }, ["1e400", "1e-400"]],
  // Links of before: the forcing sets the amplitude, unless there is one.
  ["axial_forcing=0.5&angular_frequency=15", { amplitude: String((0.5 * Math.PI * 9.8) / 225) }, []],
  ["axial_forcing=0.5&amplitude=0.06", { amplitude: "0.06" }, []],
  ["motor_stator={&friction=0.3", { motor_stator: "none", friction: "0.3" }, ["the table of a stator"]],
  ['motor_stator={"mass":-1,"quality":9}&friction=0.3', { motor_stator: "none", friction: "0.3" }, ["stator.mass"]],
  ['motor_stator={"mess":1}&friction=0.3', { motor_stator: "none", friction: "0.3" }, ["mess"]],
  ['motor_stator={"mass":1e400}&friction=0.3', { motor_stator: "none", friction: "0.3" }, ["the table of a stator"]],
  [
    'motor_stator={"kind":"axial_twist","mass":1,"quality":9}&friction=0.3',
    { motor_stator: "none", friction: "0.3" },
    ["stator.kind is axial_twist"],
  ],
  ["contact_time=-1&friction=0.3", { contact_time: "0", friction: "0.3" }, ["contact.time = -1"]],
  // A throw counts wherever it stands, and a link without one begins with the impact.
  [
    "throw=1,0.1,0.5,2&impact_phase=0.3&normalised_speed=1.1",
    { throw: "1,0.1,0.5,2", normalised_speed: "1.1", impact_phase: "0.3" },
    [],
    /^Thrown 100 mm above/,
  ],
  ["impact_phase=0.3&normalised_speed=1.1", { throw: "none", impact_phase: "0.3" }, [], new RegExp(`^${WORDS.toss.begins}`)],
  // Nothing legal opens the defaults.
  ...[
    ["", []],
    ["%%%", ["is unknown"]],
    ["restitution=7&amplitude=-1&contact_time=-1&angular_frequency=0&mass=-3&normalised_speed=-1", ["not possible"]],
    ["<script>alert(1)</script>", ["is unknown"]],
  ].map(([hash, said]) => [hash, { restitution: "0.5", angular_frequency: "15" }, said]),
];

test("what is broken in a link is refused with a sentence each, and the rest is kept", async () => {
  for (const [hash, wanted, said, status = /^/] of LINKS)
    await within(`#${hash}`, async (page) => {
      const state = await stateOf(page);
      for (const [name, value] of Object.entries(wanted)) assert.equal(state[name], value, `${name} of ${hash}`);
      const told = await page.textContent("#problems");
      for (const words of said) assert.ok(told.includes(words), `${words}: ${told}`);
      assert.match(await page.textContent("#status"), status);
      if (said.length > 0) await page.click("#problems .close");
      assert.equal(await page.isVisible("#problems"), false);
    });
});

/** Types a number into a field of the form just before the page hears of an address, or just after. */
const arrives = (page, hash, before, name, text) =>
  page.evaluate(
    ([address, first, id, value]) => {
      const act = () => {
        const field = document.getElementById(id);
        field.value = value;
        field.dispatchEvent(new Event("change", { bubbles: true }));
      };
      if (first) act();
      else window.addEventListener("hashchange", act, { once: true });
      location.hash = address;
    },
    [hash, before, `field-${name}`, text],
  );

onPage("what is typed while an address is being checked changes the state of that address", {}, async (page) => {
  await arrives(page, "friction=0.31&restitution=0.1", false, "restitution", "0.62");
  await whenValue(page, "restitution", "0.62");
  assert.equal((await stateOf(page)).friction, "0.31");
  // What the address has that is refused is refused all the same.
  await arrives(page, "friction=-1&restitution=0.1", false, "restitution", "0.63");
  await whenValue(page, "restitution", "0.63");
  await settled(page);
  assert.equal(await page.isVisible("#problems"), true);
  assert.ok((await stateOf(page)).friction >= 0);
});

onPage("an address takes the place of what was typed before, and the last one is kept", {}, async (page) => {
  await arrives(page, "friction=0.33&restitution=0.25", true, "restitution", "0.66");
  await whenValue(page, "friction", "0.33");
  await settled(page);
  assert.equal((await stateOf(page)).restitution, "0.25");
  await page.evaluate(async () => {
    for (const friction of ["0.41", "0.42", "0.43", "-1", "0.44"]) {
      location.hash = `friction=${friction}`;
      await new Promise((done) => window.addEventListener("hashchange", done, { once: true }));
    }
  });
  await whenValue(page, "friction", "0.44");
  await settled(page);
  assert.equal((await stateOf(page)).friction, "0.44");
});
