/** A scan: one result at points of a range of a parameter, for some values of a second one. */

import {
  Cancelled, OPTIMA, RESULTS, type Context, type Offer, type ResultName, type State, type View, type ViewKind,
} from "../contract"; // prettier-ignore
import { clamp } from "../drawing/axes";
import { chartOffers, ScreenChart } from "../drawing/chart";
import { ONE_COLUMN, PARTS, tableOffers } from "../drawing/files";
import { button, choice, debounced, div, element, labelled, oncePerFrame, rich } from "../elements";
import type { Range } from "../protocol";
import { axialForcing, changed, MOST_POINTS, MOST_VALUES } from "../state";
import { say, WORDS } from "../words";
import { tellFailure } from "./asking";
import { chartOf, describeGaps, describeOptima, planOf, readingsOf, type Plan } from "./scan/curves";
import { READY } from "./scan/ready";
import { compute, RESULT, type Outcome } from "./scan/results";
import { NumberField, parameterChoice, rangeAbout, settings, valueIn, varied } from "./varied";

/** Answers that are kept, so that another result or another curve of the same points comes at once. */
const MOST_KNOWN = 3000;

const TEXT = WORDS.scan;

class ScanView implements View {
  private readonly chart = new ScreenChart(
    () => clamp(window.innerHeight - this.chart.root.offsetTop - 230, 300, 1100),
    {
      keys: TEXT.keys,
      hint: (curve) => say(TEXT.hint, { curve }),
      pick: (at, curve) => this.pick(at, curve),
    },
  );
  private readonly over = parameterChoice(TEXT.over, (over) => void this.about(over, (range) => ({ over, range })));
  private readonly family = parameterChoice(TEXT.family, (name) => this.curvesOf(name), TEXT.noFamily);
  private readonly result = choice(
    TEXT.result,
    RESULTS.map((name) => [name, TEXT.results[name]]),
    (result) => this.context.change({ scan: { result: result as ResultName } }),
  );
  private readonly optimum = choice(
    TEXT.optimum,
    OPTIMA.map((name) => [name, TEXT.optima[name]]),
    (optimum) => this.context.change({ scan: { optimum: optimum as (typeof OPTIMA)[number] } }),
  );
  private readonly low: NumberField;
  private readonly high: NumberField;
  private readonly points: NumberField;
  private readonly values: NumberField;
  private readonly optima = element("ul", { class: "remark optima" });
  private readonly gaps = element("p", { class: "remark" });
  private readonly known = new Map<string, Outcome>();
  private plan: Plan;
  private asked = "";
  private readonly compute = debounced(150, () => void this.fetch());
  private readonly draw = oncePerFrame(() => this.paint());

  constructor(
    host: HTMLElement,
    private readonly context: Context,
  ) {
    const range = (low: number, high: number) => this.change({ range: [low, high] });
    this.low = new NumberField(TEXT.from, context, ([low = 0]) => range(low, this.scan.range[1]));
    this.high = new NumberField(TEXT.to, context, ([high = 0]) => range(this.scan.range[0], high));
    this.points = new NumberField(TEXT.points, context, ([points = 0]) => this.change({ points }));
    this.values = new NumberField(TEXT.values, context, (values) => this.change({ values }), MOST_VALUES);
    const ready = READY.map((one) => button(one.label, () => context.change(one.change)));
    const bars = [
      div("bar", element("span", {}, TEXT.readyMade), ...ready),
      div("bar", labelled(TEXT.result, this.result), labelled(TEXT.over, this.over), this.low.root, this.high.root),
      div("bar", this.points.root, labelled(TEXT.family, this.family), this.values.root,
        labelled(TEXT.optimum, this.optimum)),
    ]; // prettier-ignore
    host.append(settings(TEXT.settings, bars), this.chart.root, this.optima, this.gaps);
    this.plan = planOf(context.state());
  }

  show(state: State): void {
    const { scan } = state;
    this.plan = planOf(state);
    const over = varied(scan.over);
    this.over.value = scan.over;
    this.result.value = scan.result;
    this.optimum.value = scan.optimum;
    this.family.value = scan.family ?? "";
    this.low.show([scan.range[0]], over);
    this.high.show([scan.range[1]], over);
    this.points.show([scan.points]);
    this.values.root.hidden = scan.family === null;
    this.values.show(scan.values, scan.family === null ? {} : varied(scan.family));
    this.compute();
    this.draw();
  }

  hide(): void {
    this.compute.stop();
    this.context.client.cancel("scan");
    this.asked = "";
  }

  redraw(): void {
    this.draw();
  }

  offers(): Offer[] {
    const { plan } = this;
    const { scan, at, lines } = plan;
    const readings = readingsOf(plan, this.known);
    if (readings.flat().includes(null)) return [];
    const state = this.context.state();
    const { system, mass, start } = state;
    const basis = { state, names: PARTS.all.filter((name) => name !== scan.over && name !== scan.family) };
    const rows = function* () {
      for (const [index, { value }] of lines.entries())
        for (const [place, reading] of (readings[index] ?? []).entries()) {
          const { value: number = NaN, error = NaN, between: [low, high] = [NaN, NaN], lacks = "" } = reading ?? {};
          yield [value ?? NaN, at[place] ?? NaN, number, error, low, high, lacks];
        }
    };
    const columns = [scan.family ?? "family", scan.over, scan.result, "standard_error", "low_95", "high_95", "lacks"];
    return [
      ...tableOffers({ name: "scan", parameters: { system, mass, start, scan }, columns, rows }),
      ...chartOffers("scan", TEXT.results[scan.result], [chartOf(plan, readings)], ONE_COLUMN * 0.75, basis),
    ];
  }

  private get scan(): State["scan"] {
    return this.context.state().scan;
  }

  /** The numbers of a form that cannot be scanned are refused where they are typed. */
  private change(change: Partial<State["scan"]>): void {
    const { range, points } = { ...this.scan, ...change };
    const most = Number.isInteger(points) && points >= 2 && points <= MOST_POINTS;
    if (range[0] < range[1] && most) this.context.change({ scan: change });
    else {
      this.context.status(most ? TEXT.wrongRange : say(TEXT.wrongPoints, { most: MOST_POINTS }), "error");
      this.show(this.context.state());
    }
  }

  /** Values of a second parameter, evenly within its range and without its ends, which may be alike. */
  private curvesOf(family: string): void {
    if (family === "") return this.context.change({ scan: { family: null } });
    const value = ([low, high]: Range, sixth: number) => Number((low + ((high - low) * sixth) / 6).toPrecision(3));
    void this.about(family, (range) => ({ family, values: [1, 2, 3, 4, 5].map((sixth) => value(range, sixth)) }));
  }

  private async about(name: string, change: (range: Range) => Partial<State["scan"]>): Promise<void> {
    const { context } = this;
    const state = context.state();
    const parameter = varied(name);
    try {
      const [low, high] = rangeAbout(await valueIn(context, "scan-value", parameter, state), parameter, state);
      context.change({ scan: change([Number(low.toPrecision(3)), Number(high.toPrecision(3))]) });
    } catch (error) {
      tellFailure(context, error);
    }
  }

  private async fetch(): Promise<void> {
    const { plan, known, context } = this;
    const states = plan.lines.flatMap((line) => line.states);
    const keys = plan.lines.flatMap((line) => line.keys);
    const key = JSON.stringify(keys);
    if (key === this.asked) return;
    this.asked = key;
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
      if (this.asked === key) this.asked = "";
      if (!(error instanceof Cancelled)) this.gaps.textContent = "";
      tellFailure(context, error);
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
    const { system, mass, start, thrown, diagram } = changed(point, opens);
    const forcing = axialForcing(system);
    const [low, high] = diagram.axial_forcing;
    const axial_forcing: Range = forcing > low && forcing < high ? [low, high] : [0.8 * forcing, 1.2 * forcing];
    this.context.change({ ...opens, system, mass, start, thrown, diagram: { axial_forcing } });
  }
}

export const scan: ViewKind = {
  name: "scan",
  ...WORDS.views.scan,
  make: (host, context) => new ScanView(host, context),
};
