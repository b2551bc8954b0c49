/** The state that a link reproduces: its defaults, changes of it, and its form in the hash of the address. */

import { VIEW_NAMES, type Change, type State } from "./contract";
import presets from "./presets.json";
import { SYSTEM_NAMES, type FlightStart, type Range, type Stator } from "./protocol";
import { say, WORDS } from "./words";

export { VIEW_NAMES };

/** Loads of a curve, and rise times of a run-up, beyond which a page would compute for minutes. */
export const MOST_POINTS = 200;
export const MOST_RISE_TIMES = 1000;
export const MOST_PERIODS = 500;
/** Curves of a scan, which have to be told apart. */
export const MOST_VALUES = 5;

export const DEFAULT_STATE: State = {
  view: "toss",
  system: presets.usual,
  summary: null,
  mass: 0.4,
  start: { impact_phase: 0.4, normalised_speed: 1.4, angular_speed: 0 },
  thrown: null,
  diagram: { axial_forcing: [0.32, 0.62], quantity: "impact_phase", range: null, branches: true, drive: "sine" },
  basins: { phase_periods: [0, 1], normalised_speed: [0, 5] },
  motor: { rise_times: 6, stator: null },
  compare: { parameter: "normalised_speed", value: 0, periods: 160, from: null },
  scan: {
    over: "amplitude_angle",
    range: [0, 1.2],
    points: 41,
    result: "toss_speed",
    family: "phase_lag",
    values: [-2, -1, 0, 1, 2].map((quarters) => (quarters * Math.PI) / 4),
  },
};

/**
 * A state with this change. A start that is chosen takes the place of a throw, and an amplitude that of what the system
 * sets.
 */
export function changed(state: State, change: Change): State {
  const parts = Object.entries(state).map(([name, old]: [string, unknown]) => {
    const own: unknown = change[name as keyof Change];
    return [name, typeof old === "object" ? { ...old, ...(own as object) } : (own ?? old)];
  });
  const { system, mass, start } = change;
  const set = [...((system?.amplitude === undefined && state.system.set) || []), ...(system?.set ?? [])];
  const next = Object.fromEntries(parts) as State;
  return {
    ...next,
    system: { ...next.system, set: set.length > 0 ? set : undefined },
    summary: system === undefined && mass === undefined ? state.summary : null,
    thrown: change.thrown !== undefined ? change.thrown : start === undefined ? state.thrown : null,
  };
}

/** The shortest digits that give the same bits back. JavaScript prints a negative zero without its sign. */
const printed = (value: number): string => (Object.is(value, -0) ? "-0" : String(value));

export const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** Whether digits that make 0 have another one among them, as 1e-400 has. */
export const isLost = (digits: string): boolean => /^[^e]*[1-9]/i.test(digits);

/** A decimal number with all of its text used; `null` for anything else, and for what no double holds. */
function readNumber(text: string): number | null {
  const value = DECIMAL.test(text) ? Number(text) : NaN;
  return Number.isFinite(value) && (value !== 0 || !isLost(text)) ? value : null;
}

/** Text that is not what a part of the address has to be; the message says what that is. */
class Unreadable extends Error {}

/** How a value stands in an address. */
interface Form<Value> {
  print(value: Value): string;
  read(text: string): Value;
}

/** A number of which `message` says what it has to be. */
const numberThat = (message: string, legal: (value: number) => boolean = () => true): Form<number> => ({
  print: printed,
  read(text) {
    const value = readNumber(text);
    if (value === null || !legal(value)) throw new Unreadable(message);
    return value;
  },
});

const NUMBER = numberThat(WORDS.address.number);

const whole = (low: number, high: number): Form<number> =>
  numberThat(say(WORDS.address.whole, { low, high }), (one) => one >= low && one <= high && Number.isInteger(one));

const bounded = (low: number, high: number): Form<number> =>
  numberThat(say(WORDS.address.bounded, { low, high }), (value) => value >= low && value <= high);

/** Several numbers with commas between them. */
const numbersThat = (message: string, legal: (values: number[]) => boolean): Form<readonly number[]> => ({
  print: (values) => values.map(printed).join(","),
  read(text) {
    const values = text.split(",").flatMap((one) => readNumber(one) ?? []);
    if (values.length !== text.split(",").length || !legal(values)) throw new Unreadable(message);
    return values;
  },
});

const range = (lowest = -Infinity): Form<Range> =>
  numbersThat(
    lowest === -Infinity ? WORDS.address.range : say(WORDS.address.range_from, { lowest }),
    ([low = NaN, high = NaN, ...more]) => more.length === 0 && low < high && high - low < Infinity && low >= lowest,
  ) as Form<Range>;

const VALUES = numbersThat(say(WORDS.address.up_to, { most: MOST_VALUES }), (values) => values.length <= MOST_VALUES);

/** A throw that the library may still refuse, such as one that starts on the platform and goes downwards. */
const FOUR = numbersThat(WORDS.address.throw, ({ length, 1: gap = NaN }) => length === 4 && gap >= 0);
const THROW: Form<FlightStart> = {
  print: ({ phase, gap, relative_velocity: speed, angular_speed }) => FOUR.print([phase, gap, speed, angular_speed]),
  read(text) {
    const [phase = 0, gap = 0, relative_velocity = 0, angular_speed = 0] = FOUR.read(text);
    return { phase, gap, relative_velocity, angular_speed };
  },
};

/** A table of JSON, of which the library says whether it is a stator. */
const STATOR: Form<Stator> = {
  print: (stator) => encodeURIComponent(JSON.stringify(stator)),
  read(text) {
    const legal = (one: unknown) => typeof one === "string" || Number.isFinite(one);
    try {
      const stator = JSON.parse(text);
      if (stator.constructor === Object && Object.values(stator).every(legal)) return stator;
    } catch {} // It is not even JSON.
    throw new Unreadable(WORDS.address.stator);
  },
};

function oneOf<Name extends string>(names: readonly Name[]): Form<Name> {
  return {
    print: (name) => name,
    read(text) {
      const name = names.find((known) => known === text);
      if (name === undefined) throw new Unreadable(say(WORDS.address.one_of, { names: names.join(", ") }));
      return name;
    },
  };
}

/** One of the names of some texts. */
const oneOfTexts = <Texts extends object>(texts: Texts): Form<keyof Texts & string> =>
  oneOf(Object.keys(texts) as (keyof Texts & string)[]);

/** What a scan or a comparison can vary. */
const PARAMETER: Form<string> = oneOf(Object.keys(WORDS.form.labels));

const SWITCH: Form<boolean> = {
  print: (on) => (on ? "on" : "off"),
  read: (text) => oneOf(["on", "off"]).read(text) === "on",
};

/** A word for what is not there. */
const orNone = <Value>(word: string, { print, read }: Form<Value>): Form<Value | null> => ({
  print: (value) => (value === null ? word : print(value)),
  read: (text) => (text === word ? null : read(text)),
});

interface Key {
  print(state: State): string;
  read(text: string): Change;
}

const all = <Part extends "view" | "mass" | "thrown">(part: Part, { print, read }: Form<State[Part]>): Key => ({
  print: (state) => print(state[part]),
  read: (text) => ({ [part]: read(text) }),
});

type Parts = Omit<State, "view" | "summary" | "mass" | "thrown">;

const of = <Part extends keyof Parts, Name extends keyof Parts[Part]>(
  part: Part,
  name: Name,
  { print, read }: Form<Parts[Part][Name]>,
): Key => ({
  print: (state) => print((state as Parts)[part][name]),
  read: (text) => ({ [part]: { [name]: read(text) } }),
});

/** The hash's keys, in the order in which they are written. */
const KEYS: Readonly<Record<string, Key>> = {
  view: all("view", oneOf(VIEW_NAMES)),
  ...Object.fromEntries(SYSTEM_NAMES.map((name) => [name, of("system", name, NUMBER)])),
  mass: all("mass", NUMBER),
  impact_phase: of("start", "impact_phase", NUMBER),
  normalised_speed: of("start", "normalised_speed", NUMBER),
  angular_speed: of("start", "angular_speed", NUMBER),
  throw: all("thrown", orNone("none", THROW)),
  diagram_forcing: of("diagram", "axial_forcing", range(0)),
  diagram_quantity: of("diagram", "quantity", oneOfTexts(WORDS.diagram.quantities)),
  diagram_range: of("diagram", "range", orNone("all", range())),
  diagram_branches: of("diagram", "branches", SWITCH),
  diagram_drive: of("diagram", "drive", oneOfTexts(WORDS.diagram.drives)),
  basins_phase: of("basins", "phase_periods", range()),
  basins_speed: of("basins", "normalised_speed", range(0)),
  motor_rise_times: of("motor", "rise_times", bounded(0.01, MOST_RISE_TIMES)),
  motor_stator: of("motor", "stator", orNone("none", STATOR)),
  compare_parameter: of("compare", "parameter", PARAMETER),
  compare_value: of("compare", "value", NUMBER),
  compare_periods: of("compare", "periods", whole(1, MOST_PERIODS)),
  compare_from: of("compare", "from", orNone("parting", bounded(0, MOST_PERIODS))),
  scan_over: of("scan", "over", PARAMETER),
  scan_range: of("scan", "range", range()),
  scan_points: of("scan", "points", whole(2, MOST_POINTS)),
  scan_result: of("scan", "result", oneOfTexts(WORDS.scan.results)),
  scan_family: of("scan", "family", orNone("none", PARAMETER)),
  scan_values: of("scan", "values", VALUES),
};

/** Links of before had the forcing in the place of the amplitude. */
const OLD_FORCING = "axial_forcing";

/** `#view=toss&amplitude=0.0616&...`: all of the state, so that a link outlives other defaults. */
export function toHash(state: State): string {
  const parts = Object.entries(KEYS).map(([name, key]) => `${name}=${key.print(state)}`);
  return `#${parts.join("&")}`;
}

/** The state of a hash. What is missing has its default; what cannot be read is left out, with a sentence for each. */
export function fromHash(hash: string): { state: State; problems: string[] } {
  const problems: string[] = [];
  let state = DEFAULT_STATE;
  // The start that an address has beside a throw does not take the place of it, wherever it stands.
  let thrown = state.thrown;
  let forcing: number | undefined;
  const seen = new Set<string>();
  for (const part of hash.replace(/^#/, "").split("&")) {
    if (part === "") continue;
    const [name = "", text = ""] = unescaped(part).split(/=(.*)/s);
    const key = Object.hasOwn(KEYS, name) ? KEYS[name] : undefined;
    if (name === OLD_FORCING && readNumber(text) !== null) {
      forcing ??= readNumber(text) as number;
    } else if (key === undefined) {
      problems.push(say(WORDS.address.unknown, { part: shortened(part) }));
    } else if (seen.has(name)) {
      problems.push(say(WORDS.address.twice, { name }));
    } else {
      seen.add(name);
      try {
        const change = key.read(text);
        if (change.thrown !== undefined) thrown = change.thrown;
        else state = changed(state, change);
      } catch (error) {
        if (!(error instanceof Unreadable)) throw error;
        const found = { part: shortened(part), name, form: error.message, value: key.print(DEFAULT_STATE) };
        problems.push(say(WORDS.address.unreadable, found));
      }
    }
  }
  if (forcing !== undefined && !seen.has("amplitude"))
    state = changed(state, { system: { set: [[OLD_FORCING, forcing]] } });
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
