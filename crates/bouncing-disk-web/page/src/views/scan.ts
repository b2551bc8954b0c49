/** A scan: one result at points of a range of a parameter, for some values of a second one. */

import { Cancelled, type Change, type Context, type Offer, type State } from "../contract";
import { clamp, evenly } from "../drawing/axes";
import { chartOffers, ScreenChart } from "../drawing/chart";
import { ONE_COLUMN, PARTS, statorWords, tableOffers } from "../drawing/files";
import { choice, div, element, oncePerFrame, rich, roomBelow } from "../elements";
import { STEPS } from "../presets";
import type { Range } from "../protocol";
import { changed, DEFAULT_STATE, MOST_POINTS, MOST_VALUES } from "../state";
import { resolved } from "../store";
import { say, WORDS } from "../words";
import { Asked, ComputingView } from "./asking";
import { chartOf, describeGaps, describeOptima, planOf, readingsOf, type Plan } from "./scan/curves";
import { compute, RESULT, type Outcome } from "./scan/results";
import { LabelledField, parameterChoice, rangeAbout, settings, varied } from "./varied";

/** Answers that are kept, so that another result or another curve of the same points comes at once. */
const MOST_KNOWN = 3000;

const TEXT = WORDS.scan;

const short = (value: number): number => Number(value.toPrecision(3));

export class ScanView extends ComputingView {
  private readonly chart = new ScreenChart(() => clamp(roomBelow(this.chart.root) - 190, 300, 1100), {
    keys: TEXT.keys,
    hint: (curve) => say(TEXT.hint, { curve }),
    pick: (at, curve) => this.pick(at, curve),
  });
  private readonly over = parameterChoice(TEXT.over, (over) => this.about(over, (range) => ({ over, range })));
  private readonly family = parameterChoice(TEXT.family, (name) => this.curvesOf(name), TEXT.noFamily);
  private readonly result = choice(TEXT.result, TEXT.results, (result) => this.change({ result }));
  // A range is typed number by number: each counts with what stands in the other field.
  private readonly low = this.field(TEXT.from, ([low = 0]) => ({ range: [low, this.high.numbers()?.[0] ?? NaN] }));
  private readonly high = this.field(TEXT.to, ([high = 0]) => ({ range: [this.low.numbers()?.[0] ?? NaN, high] }));
  private readonly points = this.field(TEXT.points, ([points = 0]) => ({ points }));
  private readonly values = this.field(TEXT.values, (values) => ({ values }), MOST_VALUES);
  private readonly optima = element("ul", { class: "remark optima" });
  private readonly gaps = element("p", { class: "remark" });
  private readonly known = new Map<string, Outcome>();
  private plan = planOf(this.context.state());
  private readonly asked = new Asked<void>();
  protected readonly draw = oncePerFrame(() => this.paint());

  constructor(host: HTMLElement, context: Context) {
    super(context, ["scan"]);
    const bars = [
      div("bar", this.result.root, this.over.root, this.low.root, this.high.root),
      div("bar", this.points.root, this.family.root, this.values.root),
    ];
    host.append(settings(TEXT.settings, context, READY, bars), this.chart.root, this.optima, this.gaps);
  }

  show(state: State): void {
    const { over, family, range, points, result, values } = state.scan;
    this.plan = planOf(state);
    this.over.select.value = over;
    this.result.select.value = result;
    this.family.select.value = family ?? "";
    this.low.show([range[0]], varied(over));
    this.high.show([range[1]], varied(over));
    this.points.show([points]);
    this.values.root.hidden = family === null;
    this.values.show(values, family === null ? {} : varied(family));
    this.redraw();
  }

  offers(): Offer[] {
    const { plan } = this;
    const { scan, at, lines } = plan;
    const readings = readingsOf(plan, this.known);
    if (readings.flat().includes(null)) return [];
    const state = this.context.state();
    const { system, mass, start, motor } = state;
    const ofMotor = RESULT[scan.result].opens.view === "motor";
    const names = PARTS.all.filter((name) => name !== scan.over && name !== scan.family);
    const basis = { state, names, more: ofMotor ? statorWords(state) : [] };
    const parameters = { system, mass, start, scan, ...(ofMotor && { stator: motor.stator }) };
    const rows = function* () {
      for (const [index, { value }] of lines.entries())
        for (const [place, reading] of (readings[index] ?? []).entries()) {
          const { value: number = NaN, error = NaN, between: [low, high] = [NaN, NaN], lacks = "" } = reading ?? {};
          yield [value ?? NaN, at[place] ?? NaN, number, error, low, high, lacks];
        }
    };
    const columns = [scan.family ?? "family", scan.over, scan.result, "standard_error", "low_95", "high_95", "lacks"];
    return [
      ...tableOffers({ name: "scan", parameters, columns, rows }),
      ...chartOffers("scan", TEXT.results[scan.result], [chartOf(plan, readings)], ONE_COLUMN * 0.75, basis),
    ];
  }

  private get scan(): State["scan"] {
    return this.context.state().scan;
  }

  private field(label: string, of: (values: number[]) => Partial<State["scan"]>, most = 1): LabelledField {
    return new LabelledField(label, this.context, (values) => this.change(of(values)), most);
  }

  /** Numbers that cannot be scanned are refused where they are typed, with a sentence. */
  private change(change: Partial<State["scan"]>): string | void {
    const { range, points } = { ...this.scan, ...change };
    const most = Number.isInteger(points) && points >= 2 && points <= MOST_POINTS;
    if (!most) return say(TEXT.wrongPoints, { most: MOST_POINTS });
    if (!(range[0] < range[1] && range[1] - range[0] < Infinity)) return TEXT.wrongRange;
    this.context.change({ scan: change });
  }

  /** Values of a second parameter, evenly within its range and without its ends, which may be alike. */
  private curvesOf(family: string): void {
    if (family === "") this.change({ family: null });
    else this.about(family, (range) => ({ family, values: evenly(range, MOST_VALUES + 2).slice(1, -1).map(short) }));
  }

  private about(name: string, change: (range: Range) => Partial<State["scan"]>): void {
    const state = this.context.state();
    const parameter = varied(name);
    const value = parameter.value(state) ?? NaN;
    this.change(change(rangeAbout(value, parameter, state).map(short) as Range));
  }

  protected async fetch(): Promise<void> {
    const keys = this.plan.lines.flatMap((line) => line.keys);
    await this.asked.get(keys, () => this.computeAll(this.plan, keys));
  }

  private async computeAll(plan: Plan, keys: readonly string[]): Promise<void> {
    const { known, context } = this;
    const states = plan.lines.flatMap((line) => line.states);
    // Where all points are known nothing else ends what is under way.
    context.client.cancel("scan");
    if (known.size > MOST_KNOWN) known.clear();
    const open = [...keys.entries()].filter(([, name]) => !known.has(name));
    const began = performance.now();
    let done = 0;
    const tell = () => {
      const passed = (performance.now() - began) / 1000;
      const left =
        done === 0 ? TEXT.unknownTime : say(TEXT.left, { seconds: Math.ceil((passed / done) * (open.length - done)) });
      context.status(say(TEXT.busy, { done: states.length - open.length + done, all: states.length, left }), "busy");
    };
    tell();
    try {
      const wanted = open.map(([index]) => states[index] as State);
      await compute(context, RESULT[plan.scan.result], wanted, (outcome, index) => {
        known.set(open[index]?.[1] ?? "", outcome);
        done += 1;
        tell();
        this.draw();
      });
      const seconds = ((performance.now() - began) / 1000).toFixed(1);
      context.status(say(TEXT.done, { count: open.length, all: states.length, seconds }));
    } catch (error) {
      if (!(error instanceof Cancelled)) this.gaps.textContent = "";
      throw error;
    }
  }

  private paint(): void {
    const readings = readingsOf(this.plan, this.known);
    const all = readings.flat();
    const whole = !all.includes(null);
    const optima = describeOptima(this.plan, readings);
    if (all.every((reading) => reading === null)) this.chart.showWord(TEXT.coming);
    else this.chart.show(chartOf(this.plan, readings));
    this.optima.replaceChildren(...(whole ? optima.map((text) => element("li", {}, ...rich(text))) : []));
    const words = whole ? [describeGaps(this.plan, readings), TEXT.remark].join(" ").trim() : TEXT.coming;
    this.gaps.replaceChildren(...rich(words));
  }

  /** Opens the state of a point in the view that shows it. */
  private pick(at: number, curve: number): void {
    const { scan, lines } = this.plan;
    const point = lines[curve]?.states[at];
    if (point === undefined) return;
    const { opens } = RESULT[scan.result];
    this.attempt(async () => {
      const opened = await resolved(this.context.client, "scan-point", changed(point, opens));
      const { system, mass, start, thrown, diagram, summary } = opened;
      const [forcing, [low, high]] = [summary.axial_forcing, diagram.axial_forcing];
      const axial_forcing: Range = forcing > low && forcing < high ? [low, high] : [0.8 * forcing, 1.2 * forcing];
      this.context.change({ ...opens, system, mass, start, thrown, diagram: { axial_forcing } });
    });
  }
}

/** Scans that are ready made: the system, and what is computed of it. */
const { best_hand, preload, basin_share, exponent } = WORDS.scan.ready;

const of = (label: string, system: Change, scan: Partial<State["scan"]>) => ({
  label,
  change: { ...system, view: "scan", scan: { ...DEFAULT_STATE.scan, family: null, ...scan } } satisfies Change,
});

const READY = [
  of(best_hand, STEPS.hand.release, { family: "phase_lag", range: [0, 1.4] }),
  // The range of Fig. 11, 80 to 280 mN.
  of(preload, STEPS.motor.sheet, { over: "preload_acceleration", range: [2.43, 8.51], points: 13, result: "motor_speed" }),
  of(basin_share, STEPS.tour.bounce, { over: "axial_forcing", range: [0.3, 0.62], points: 33, result: "share_periodic" }),
  of(exponent, STEPS.tour.bounce, { over: "axial_forcing", range: [0.34, 0.58], points: 121, result: "orbit_exponent" }),
];
