/** The state that a link reproduces: its defaults, changes of it, and its form in the hash of the address. */

import type { Change, Quantity, State, Throw, ViewName } from "./contract";
import type { Range, SystemParameters } from "./protocol";

export const VIEW_NAMES: readonly ViewName[] = ["toss", "diagram", "basins", "motor"];
const QUANTITIES: readonly Quantity[] = ["impact_phase", "normalised_speed", "angular_speed"];

/** Loads of a curve, and rise times of a run-up, beyond which a page would compute for minutes. */
const MOST_POINTS = 200;
const MOST_RISE_TIMES = 1000;

/**
 * The hands and the dough of Table I, made to toss again and again at Gamma = 0.45, with the lag of Fig. 6(d): there
 * the disk can bounce once in every period, and all four views have something to show.
 */
export const DEFAULT_SYSTEM: Readonly<SystemParameters> = {
  amplitude: 0.0616,
  twist_amplitude: 0.9,
  angular_frequency: 15,
  phase_lag: -0.8168,
  contact_radius: 0.135,
  gyration_radius: 0.11,
  friction: 0.6,
  restitution: 0.5,
  preload_acceleration: 9.8,
  load_acceleration: 0,
};

export const DEFAULT_STATE: State = frozen({
  view: "toss",
  system: DEFAULT_SYSTEM,
  mass: 0.4,
  start: { impact_phase: 0.4, normalised_speed: 1.4, angular_speed: 0 },
  thrown: null,
  diagram: { axial_forcing: [0.32, 0.62], quantity: "impact_phase", range: null, branches: true },
  basins: { phase_periods: [0, 1], normalised_speed: [0, 5] },
  motor: { loads: [0, 1], points: 9, rise_times: 6 },
});

/** The same state, of which nothing can be changed. */
export function frozen(state: State): State {
  const { system, start, thrown, diagram, basins, motor } = state;
  for (const part of [system, start, thrown ?? {}, diagram, basins, motor]) {
    for (const value of Object.values(part) as unknown[]) if (Array.isArray(value)) Object.freeze(value);
    Object.freeze(part);
  }
  return Object.freeze(state);
}

/** A state with this change. A start that is chosen takes the place of a throw. */
export function changed(state: State, change: Change): State {
  return frozen({
    view: change.view ?? state.view,
    system: { ...state.system, ...change.system },
    mass: change.mass ?? state.mass,
    start: { ...state.start, ...change.start },
    thrown: change.thrown !== undefined ? change.thrown : change.start === undefined ? state.thrown : null,
    diagram: { ...state.diagram, ...change.diagram },
    basins: { ...state.basins, ...change.basins },
    motor: { ...state.motor, ...change.motor },
  });
}

/** One change that does what both do, one after the other. */
export function merged(first: Change, second: Change): Change {
  const names = ["system", "start", "diagram", "basins", "motor"] as const;
  const both = names.filter((name) => first[name] !== undefined && second[name] !== undefined);
  const replaced = second.start !== undefined && second.thrown === undefined;
  return {
    ...first,
    ...second,
    ...(replaced ? { thrown: null } : {}),
    ...Object.fromEntries(both.map((name) => [name, { ...first[name], ...second[name] }])),
  };
}

/** The shortest digits that give the same bits back. JavaScript prints a negative zero without its sign. */
export function printed(value: number): string {
  return Object.is(value, -0) ? "-0" : String(value);
}

/** A decimal number with all of its text used; `null` for anything else, hexadecimal digits and infinities included. */
export function readNumber(text: string): number | null {
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) return null;
  const value = Number(text);
  return Number.isFinite(value) ? value : null;
}

/** Text that is not what a part of the address has to be; the message says what that is. */
class Unreadable extends Error {}

function number(text: string): number {
  const value = readNumber(text);
  if (value === null) throw new Unreadable("a number");
  return value;
}

function numberWithin(low: number, high: number, whole: boolean): (text: string) => number {
  return (text) => {
    const value = number(text);
    if (value >= low && value <= high && (!whole || Number.isInteger(value))) return value;
    throw new Unreadable(`a ${whole ? "whole " : ""}number from ${low} to ${high}`);
  };
}

function oneOf<Name extends string>(names: readonly Name[]): (text: string) => Name {
  return (text) => {
    const name = names.find((known) => known === text);
    if (name === undefined) throw new Unreadable(`one of ${names.join(", ")}`);
    return name;
  };
}

function range(lowest: number): (text: string) => Range {
  return (text) => {
    const [low, high, more] = text.split(",").map(readNumber);
    if (low == null || high == null || more !== undefined || low >= high || low < lowest) {
      const bound = lowest === -Infinity ? "" : ` from ${lowest} up`;
      throw new Unreadable(`two numbers${bound}, the lower one first, with a comma between them`);
    }
    return [low, high];
  };
}

/** A throw that the library may still refuse, such as one that starts on the platform and goes downwards. */
function throwOf(text: string): Throw | null {
  if (text === "none") return null;
  const [phase, gap, relative_velocity, angular_speed, more] = text.split(",").map(readNumber);
  if (phase == null || gap == null || relative_velocity == null || angular_speed == null || more !== undefined || gap < 0)
    throw new Unreadable(
      "none, or four numbers with commas between them: phase, gap from 0 up, relative velocity, angular speed",
    );
  return { phase, gap, relative_velocity, angular_speed };
}

function printedThrow(thrown: Throw | null): string {
  if (thrown === null) return "none";
  return [thrown.phase, thrown.gap, thrown.relative_velocity, thrown.angular_speed].map(printed).join(",");
}

const printedRange = ([low, high]: Range): string => `${printed(low)},${printed(high)}`;

interface Key {
  print(state: State): string;
  read(text: string): Change;
}

function systemKey(name: keyof SystemParameters): Key {
  return { print: (state) => printed(state.system[name]), read: (text) => ({ system: { [name]: number(text) } }) };
}

/** The hash's keys, in the order in which they are written. */
const KEYS: Readonly<Record<string, Key>> = {
  view: { print: (state) => state.view, read: (text) => ({ view: oneOf(VIEW_NAMES)(text) }) },
  ...Object.fromEntries(
    (Object.keys(DEFAULT_SYSTEM) as (keyof SystemParameters)[]).map((name) => [name, systemKey(name)]),
  ),
  mass: { print: (state) => printed(state.mass), read: (text) => ({ mass: number(text) }) },
  impact_phase: {
    print: (state) => printed(state.start.impact_phase),
    read: (text) => ({ start: { impact_phase: number(text) } }),
  },
  normalised_speed: {
    print: (state) => printed(state.start.normalised_speed),
    read: (text) => ({ start: { normalised_speed: number(text) } }),
  },
  angular_speed: {
    print: (state) => printed(state.start.angular_speed),
    read: (text) => ({ start: { angular_speed: number(text) } }),
  },
  throw: {
    print: (state) => printedThrow(state.thrown),
    read: (text) => ({ thrown: throwOf(text) }),
  },
  diagram_forcing: {
    print: (state) => printedRange(state.diagram.axial_forcing),
    read: (text) => ({ diagram: { axial_forcing: range(0)(text) } }),
  },
  diagram_quantity: {
    print: (state) => state.diagram.quantity,
    read: (text) => ({ diagram: { quantity: oneOf(QUANTITIES)(text) } }),
  },
  diagram_range: {
    print: (state) => (state.diagram.range === null ? "all" : printedRange(state.diagram.range)),
    read: (text) => ({ diagram: { range: text === "all" ? null : range(-Infinity)(text) } }),
  },
  diagram_branches: {
    print: (state) => (state.diagram.branches ? "on" : "off"),
    read: (text) => ({ diagram: { branches: oneOf(["on", "off"])(text) === "on" } }),
  },
  basins_phase: {
    print: (state) => printedRange(state.basins.phase_periods),
    read: (text) => ({ basins: { phase_periods: range(-Infinity)(text) } }),
  },
  basins_speed: {
    print: (state) => printedRange(state.basins.normalised_speed),
    read: (text) => ({ basins: { normalised_speed: range(0)(text) } }),
  },
  motor_loads: {
    print: (state) => printedRange(state.motor.loads),
    read: (text) => ({ motor: { loads: range(-Infinity)(text) } }),
  },
  motor_points: {
    print: (state) => printed(state.motor.points),
    read: (text) => ({ motor: { points: numberWithin(2, MOST_POINTS, true)(text) } }),
  },
  motor_rise_times: {
    print: (state) => printed(state.motor.rise_times),
    read: (text) => ({ motor: { rise_times: numberWithin(0.01, MOST_RISE_TIMES, false)(text) } }),
  },
};

/** `#view=toss&amplitude=0.0616&...`: all of the state, so that a link outlives other defaults. */
export function toHash(state: State): string {
  return `#${Object.entries(KEYS)
    .map(([name, key]) => `${name}=${key.print(state)}`)
    .join("&")}`;
}

/** The state of a hash. What is missing has its default; what cannot be read is left out, with a sentence for each. */
export function fromHash(hash: string): { state: State; problems: string[] } {
  const problems: string[] = [];
  let state = DEFAULT_STATE;
  // The start that an address has beside a throw does not take the place of it, wherever it stands.
  let thrown = state.thrown;
  const seen = new Set<string>();
  for (const part of hash.replace(/^#/, "").split("&")) {
    if (part === "") continue;
    const [name = "", text = ""] = unescaped(part).split(/=(.*)/s);
    const key = Object.hasOwn(KEYS, name) ? KEYS[name] : undefined;
    if (key === undefined) {
      problems.push(`The address has a part "${shortened(part)}", which means nothing here.`);
    } else if (seen.has(name)) {
      problems.push(`The address has "${name}" twice; the first one counts.`);
    } else {
      seen.add(name);
      try {
        const change = key.read(text);
        if (change.thrown !== undefined) thrown = change.thrown;
        else state = changed(state, change);
      } catch (error) {
        if (!(error instanceof Unreadable)) throw error;
        problems.push(
          `The address says "${shortened(part)}", but ${name} has to be ${error.message}; ` +
            `${key.print(DEFAULT_STATE)} is taken instead.`,
        );
      }
    }
  }
  return { state: changed(state, { thrown }), problems };
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

const shortened = (text: string): string => (text.length > 40 ? `${text.slice(0, 40)}...` : text);
