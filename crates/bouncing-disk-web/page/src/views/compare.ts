/** Two states that differ in one parameter, side by side: the shared one, A, and B. */

import { Cancelled, messageOf, type Change, type Context, type Offer, type State } from "../contract";
import { clamp, extent } from "../drawing/axes";
import { chartOffers, ScreenChart, type Chart } from "../drawing/chart";
import { ONE_COLUMN, PARTS, tableOffers } from "../drawing/files";
import { button, div, element, oncePerFrame, rich, roomBelow, setText } from "../elements";
import { nextDouble, plain } from "../numbers";
import { STEPS } from "../presets";
import type { MotionJson, Range, VerdictJson } from "../protocol";
import { DEFAULT_STATE, MOST_PERIODS } from "../state";
import { resolved } from "../store";
import { say, WORDS } from "../words";
import { Asked, ComputingView, impactOf, motionStartOf, verdictOf } from "./asking";
import { behaviour } from "./diagram/words";
import { Recording, traces, WIDEST, type Column } from "./toss/recording";
import { exactText, settings, LabelledField, parameterChoice, varied, withValue } from "./varied";

const SAMPLES = 48;
/** Periods that the heights and spins are shown for, and how many of them before the parting. */
const SHOWN = 14;
const BEFORE = 3;
/** Points of the chart of the difference: more of them nobody sees. */
const MOST_DRAWN = 2500;
/** The next double of a parameter may give the same system, where that follows from it by rounding. */
const MOST_STEPS = 64;

/** Heights differ from this share of the amplitude on, and below that one rounding makes the difference. */
const APART = 0.01;
/** From this share of the amplitude on one sees it. */
const SEEN = 0.1;
const ROUNDED = 1e-13;

const TEXT = WORDS.compare;

/** The same of A and of B. */
type Both<Value> = readonly [a: Value, b: Value];

/** Two motions that were sampled alike; the shared state is A. */
interface Pair {
  readonly state: State;
  readonly motions: Both<Recording>;
  /** |difference of heights| over the amplitude of A. */
  readonly apart: Float64Array;
  /** Periods until the heights first differ; null if they never do. */
  readonly first: number | null;
  /** The period from which on they are seen to differ in each; null if there is none. */
  readonly parting: number | null;
  /** The value that A has of the parameter. */
  readonly own: number;
  /** What the library says that both do for good. */
  readonly ends: Both<string> | null;
}

export class CompareView extends ComputingView {
  private readonly charts: ScreenChart[] = [0, 1, 2].map(
    () => new ScreenChart(() => clamp(roomBelow(this.charts[0]?.root as Element) / 2 - 64, 170, 520)),
  );
  private readonly parameter = parameterChoice(TEXT.parameter, (name) => this.choose(name));
  private readonly value = new LabelledField(TEXT.value, this.context, ([value = 0]) => this.change({ value }));
  private readonly periods = new LabelledField(TEXT.periods, this.context, ([periods = 0]) => this.follow(periods));
  private readonly from = new LabelledField(TEXT.from, this.context, ([from = 0]) => this.showFrom(from));
  private readonly sentence = element("p", { class: "differs" });
  private readonly words = element("ul", { class: "remark optima", "aria-live": "polite" });
  private readonly asked = new Asked<void>();
  private pair: Pair | null = null;
  private problem = "";
  protected readonly draw = oncePerFrame(() => this.paint());

  constructor(host: HTMLElement, context: Context) {
    super(context, SLOTS);
    const next = button(TEXT.next, () => this.attempt(() => this.next()));
    const bars = [
      div("bar", this.parameter.root, this.value.root, next),
      div("bar", this.periods.root, this.from.root, button(TEXT.parting, () => this.change({ from: null }))),
    ];
    const charts = div("compare", ...this.charts.map(({ root }) => root));
    host.append(settings(TEXT.settings, context, READY, bars), this.sentence, this.words, charts);
  }

  show(state: State): void {
    const { parameter, value, periods } = state.compare;
    this.parameter.select.value = parameter;
    this.value.show([value], { ...varied(parameter), exact: true });
    this.periods.show([periods]);
    this.redraw();
  }

  offers(): Offer[] {
    const { pair } = this;
    // Those of another state are never given under this one.
    if (pair === null || keyOf(pair.state) !== keyOf(this.context.state())) return [];
    const columns = [...columnsOf(pair, "height"), ...columnsOf(pair, "angular_speed"), pair.apart];
    const rows = function* () {
      for (const row of pair.apart.keys()) yield [row / SAMPLES, ...columns.map((column) => column[row] ?? NaN)];
    };
    const { system, start, thrown, compare } = pair.state;
    const parameter = varied(compare.parameter);
    const other = `B: ${parameter.symbol} = ${exactText(parameter, compare.value)}`;
    const basis = { state: pair.state, names: PARTS.all, more: [other] };
    return [
      ...tableOffers({ name: "comparison", parameters: { system, start, thrown, compare }, columns: COLUMNS, rows }),
      ...chartOffers("comparison", TEXT.title, this.chartsOf(pair), ONE_COLUMN * 0.6, basis),
    ];
  }

  private change(compare: Partial<State["compare"]>): void {
    this.context.change({ compare });
  }

  private follow(periods: number): string | void {
    const legal = Number.isInteger(periods) && periods >= 1 && periods <= MOST_PERIODS;
    if (!legal) return say(TEXT.wrongPeriods, { most: MOST_PERIODS });
    this.change({ periods });
  }

  private showFrom(from: number): string | void {
    const most = this.context.state().compare.periods - 1;
    if (!(from >= 0 && from <= most)) return say(TEXT.wrongFrom, { most });
    this.change({ from });
  }

  /** Another parameter of B, which is A as long as nobody gives it another value. */
  private choose(parameter: string): void {
    this.change({ parameter, value: varied(parameter).value(this.context.state()) ?? NaN });
  }

  /** The next value that is another system at all. */
  private async next(): Promise<void> {
    const state = this.context.state();
    const parameter = varied(state.compare.parameter);
    const same = JSON.stringify(state);
    let value = parameter.value(state) ?? NaN;
    for (let step = 0; step < MOST_STEPS; step += 1) {
      value = nextDouble(value);
      const other = await resolved(this.context.client, VALUE, withValue(parameter, value, state));
      if (JSON.stringify(other) !== same) break;
    }
    this.change({ value });
  }

  protected async fetch(): Promise<void> {
    const { context } = this;
    const state = context.state();
    const { thrown, compare } = state;
    const { parameter, periods } = compare;
    try {
      await this.asked.get(keyOf(state), async () => {
        if (thrown !== null && Object.hasOwn(DEFAULT_STATE.start, parameter)) throw new Error(TEXT.thrown);
        context.status(TEXT.busy, "busy");
        this.pair = await pairOf(context, state);
        context.status(say(TEXT.done, { periods, samples: SAMPLES }));
        this.draw();
      });
    } catch (error) {
      if (!(error instanceof Cancelled) && context.state() === state) {
        Object.assign(this, { pair: null, problem: messageOf(error) });
        this.draw();
      }
      throw error;
    }
  }

  private paint(): void {
    const { pair } = this;
    if (pair === null) {
      this.words.replaceChildren();
      setText(this.sentence, "");
      for (const chart of this.charts) chart.showWord(this.problem || TEXT.coming);
      return;
    }
    const { parameter: name, value } = pair.state.compare;
    const parameter = varied(name);
    const values = { value: exactText(parameter, value), own: exactText(parameter, pair.own) };
    this.sentence.replaceChildren(...rich(say(TEXT.differs, { symbol: parameter.symbol, ...values })));
    this.from.show([this.windowOf(pair)[0]]);
    const words = describe(pair);
    // The same words are not read out again.
    if (this.words.textContent !== words.join(""))
      this.words.replaceChildren(...words.map((text) => element("li", {}, text)));
    const caption = say(TEXT.caption, { samples: SAMPLES });
    const charts = this.chartsOf(pair);
    const show = (index: number) => this.charts[index]?.show(charts[index] as Chart, index === 2 ? caption : "");
    [0, 1].forEach(show);
    // In a frame of its own: all three together would hold up the page.
    requestAnimationFrame(() => this.pair === pair && show(2));
  }

  /** The periods that heights and spins are shown for. */
  private windowOf({ first, parting, state: { compare } }: Pair): Range {
    const { from } = this.context.state().compare;
    const wanted = Math.floor((parting ?? first ?? 0) - BEFORE);
    const low = from ?? clamp(wanted, 0, Math.max(compare.periods - SHOWN, 0));
    return [low, low + SHOWN];
  }

  private chartsOf(pair: Pair): Chart[] {
    const window = this.windowOf(pair);
    const [a, b] = pair.motions;
    const alike = PARTS.platform.every((name) => a.system[name] === b.system[name]);
    const named = [
      { motion: a, disk: "A", platform: alike ? TEXT.platform : TEXT.platformA },
      { motion: b, disk: "B", platform: alike ? null : TEXT.platformB },
    ] as const;
    return [...traces(named, window, window[1]), differenceChart(pair, window)];
  }
}

/** The difference on an axis of powers of ten. */
function differenceChart({ apart, state }: Pair, window: Range): Chart {
  const step = Math.ceil(apart.length / MOST_DRAWN);
  const largestOf = (bin: number) => Math.max(...apart.subarray(bin * step, (bin + 1) * step));
  const logs = new Float64Array(Math.floor(apart.length / step)).map((_, bin) => Math.log10(largestOf(bin)));
  const at = logs.map((_, bin) => (bin * step) / SAMPLES);
  const [low, high] = extent(logs.filter(Number.isFinite)) ?? [-16, 0];
  return {
    title: TEXT.difference,
    x: { label: WORDS.axes.time, range: [0, state.compare.periods] },
    y: { label: TEXT.differenceAxis, range: [Math.floor(low), Math.ceil(high + 1e-9)], powers: true, widest: WIDEST },
    at,
    curves: [{ label: say(TEXT.instants, { step }), y: logs, colour: "--curve-efficiency" }],
    stretches: [{ range: window, label: TEXT.window, colour: "--runaway" }],
  };
}

/** Why a disk at rest never reaches the fast orbit, and what the last digit of a number does to a chaotic one. */
const ready = (label: string, state: Change, parameter: string, value: number) => {
  const compare = { ...DEFAULT_STATE.compare, parameter, value };
  return { label, change: { ...state, view: "compare", compare } as const };
};
const READY = [
  ready(TEXT.ready.rest, STEPS.tour.bounce, "normalised_speed", 0),
  ready(TEXT.ready.digit, STEPS.tour.chaos, "restitution", nextDouble(0.5)),
];

const SLOTS = ["compare-a", "compare-b"] as const;
/** What a field asks for does not end the motions that are under way. */
const VALUE = "compare-value";
const COLUMNS = [
  "time_periods", "height_A_m", "height_B_m", "angular_speed_A_rad_per_s", "angular_speed_B_rad_per_s", "difference_over_A",
] as const; // prettier-ignore

/** What both motions depend on. */
const keyOf = ({ system, mass, start, thrown, compare: { parameter, value, periods } }: State): string =>
  JSON.stringify([system, mass, start, thrown, parameter, value, periods]);

/** A column of both motions. */
const columnsOf = ({ motions }: Pick<Pair, "motions">, name: Column): Both<Float64Array> =>
  [motions[0].span(name, 0, Infinity), motions[1].span(name, 0, Infinity)];

async function pairOf(context: Context, state: State): Promise<Pair> {
  const { parameter, value, periods } = state.compare;
  const other = await resolved(context.client, VALUE, withValue(varied(parameter), value, state));
  const both = async <Value>(ask: (own: State, slot: string) => Promise<Value>): Promise<Both<Value>> =>
    Promise.all([ask(state, SLOTS[0]), ask(other, SLOTS[1])]);
  const motions = await both(async (own, slot) => {
    const motion = { system: own.system, start: motionStartOf(own), periods, samples_per_period: SAMPLES };
    const answer = await context.client.ask<MotionJson>(slot, { call: "motion", ...motion });
    return new Recording(answer, periods, own.system);
  });
  const [a, b] = columnsOf({ motions }, "height");
  const apart = a.map((height, row) => Math.abs(height - (b[row] as number)) / state.system.amplitude);
  const own = varied(parameter).value(state) ?? NaN;
  // Contacts that take time have no verdict, nor has a disk that was thrown: it begins with no impact.
  const judged = [state, other].every(({ thrown, system }) => thrown === null && system.contact_time === 0);
  const verdicts = judged ? await both((one, slot) => verdictOf(context, slot, one.system, impactOf(one))) : null;
  const ends = verdicts && ([endOf(verdicts[0]), endOf(verdicts[1])] as const);
  const first = apart.findIndex((value) => value > APART);
  return { state, motions, apart, own, first: first < 0 ? null : first / SAMPLES, parting: partingOf(apart), ends };
}

/** The period after the last one in which nobody sees a difference. */
function partingOf(apart: Float64Array): number | null {
  const periods = Math.floor(apart.length / SAMPLES);
  const isSeen = (period: number) => apart.subarray(period * SAMPLES, (period + 1) * SAMPLES).some((one) => one > SEEN);
  let parting = periods;
  while (parting > 0 && isSeen(parting - 1)) parting -= 1;
  return parting < periods ? parting : null;
}

const endOf = (verdict: VerdictJson): string => behaviour(verdict) + (verdict.rounding_dependent ? TEXT.rounding : "");

/** What there is to say of two motions. */
function describe({ apart, first, parting, ends, state: { compare } }: Pair): string[] {
  const { periods } = compare;
  const lasting = ends === null ? TEXT.noVerdict : say(TEXT.ends, { a: ends[0], b: ends[1] });
  const [, most] = extent(apart) as Range;
  if (most === 0) return [say(TEXT.identical, { periods, samples: SAMPLES }), lasting];
  if (most < ROUNDED) return [lasting, say(TEXT.rounded, { periods })];
  if (first === null) return [lasting, say(TEXT.together, { periods, largest: plain(most, 2) })];
  const said = first * SAMPLES < 2 ? TEXT.atOnce : say(TEXT.apart, { first: plain(first, 3) });
  return [lasting, parting ? `${said} ${say(TEXT.parted, { parting })}` : said];
}
