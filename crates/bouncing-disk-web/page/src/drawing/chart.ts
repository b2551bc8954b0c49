/** A chart of curves, in files and, with a cursor that reads its values, on the screen. */

import type { Offer } from "../contract";
import { element, placeOn, setText } from "../elements";
import { plain, withError } from "../numbers";
import type { Range } from "../protocol";
import { say, WORDS } from "../words";
import { clamp, crossAt, extent, inside, layOut, padded, paintAxes, pixelX, pixelY, valueX } from "./axes";
import type { Axis, Plot } from "./axes";
import { ONE_COLUMN, pictureOffers, PRINT_SIZE, type Basis } from "./files";
import { plainText, type Box, type Pen } from "./pen";
import { Layers } from "./window";

export interface Curve {
  readonly label: string;
  readonly y: ArrayLike<number>;
  /** Standard errors: a band of twice this is drawn. */
  readonly error?: ArrayLike<number>;
  /** The ends of an interval of 95 %, which need not have the value in its middle. */
  readonly between?: readonly [low: ArrayLike<number>, high: ArrayLike<number>];
  /** The name of a custom property of `theme.css`. */
  readonly colour: string;
  readonly dash?: readonly number[];
  /** Each value has a dot; or that alone, where what lies between two of them means nothing. */
  readonly points?: boolean | "alone";
}

/** A stretch of the axis of x with a word, or a place on it with what its error covers. */
export interface Stretch {
  readonly range: Readonly<Range>;
  readonly at?: number;
  readonly label: string;
  readonly colour: string;
}

/** A point apart from the curves: a hollow circle or a cross. */
export interface Mark {
  readonly x: number;
  readonly y: number;
  readonly form: "circle" | "cross";
  readonly colour: string;
}

export interface Chart {
  readonly title: string;
  readonly x: Axis;
  readonly y: Axis;
  /** Where the values of the curves stand on the axis of x. */
  readonly at: ArrayLike<number>;
  readonly curves: readonly Curve[];
  readonly stretches?: readonly Stretch[];
  readonly marks?: readonly Mark[];
}

function layOutChart(pen: Pen, { x, y, curves }: Chart, width: number, height: number, size: number): Plot {
  // A legend stands above the curves, not on them.
  const [low, high] = y.range;
  const legend = curves.length > 1 ? ((1.3 * curves.length + 1.4) * size) / (height - 4.3 * size) : 0;
  const room = legend < 0.6 ? legend / (1 - legend) : 1.5;
  return layOut(pen, width, height, { x, y: { ...y, range: [low, high + room * (high - low)] } }, size);
}

function paintChart(pen: Pen, chart: Chart, plot: Plot): void {
  pen.clipped(plot, () => {
    for (const stretch of chart.stretches ?? []) paintStretch(pen, stretch, chart, plot);
    const [left, zero, right] = [plot.left, pixelY(plot, 0), plot.left + plot.width];
    if (inside(plot, left, zero)) pen.path([left, zero, right, zero], { stroke: "--picture-muted", width: 1 });
    for (const { x, y, form, colour } of chart.marks ?? []) {
      const [at, level, arm] = [pixelX(plot, x), pixelY(plot, y), plot.size * 0.4];
      const stroke = { stroke: colour, width: 1.6 };
      if (form === "circle") pen.circle(at, level, arm, { ...stroke, fill: "--picture-paper" });
      else pen.path(crossAt(at, level, arm), stroke);
    }
    for (const curve of chart.curves) paintBand(pen, chart, curve, plot);
    for (const curve of chart.curves) paintCurve(pen, chart, curve, plot);
  });
  paintAxes(pen, plot);
  if (chart.curves.length > 1) paintLegend(pen, chart, plot);
}

function paintStretch(pen: Pen, { range, at, label, colour }: Stretch, chart: Chart, plot: Plot): void {
  const { left, top, width, height, size } = plot;
  const [from = NaN, to = NaN] = range.map((end) => clamp(pixelX(plot, end), left, left + width));
  pen.rect(from, top, to - from, height, { fill: colour, opacity: at === undefined ? 1 : 0.25 });
  const style = { colour: "--picture-text", size } as const;
  const [first, last] = [top + size * (legendLines(chart) + 0.5), top + height - size * 0.5];
  if (at === undefined) {
    // Away from the zero, where the marks of runaway loads stand.
    const below = pixelY(plot, 0) < top + height / 2;
    const place = { ...style, anchor: below ? "start" : "end", upwards: true } as const;
    if (to - from > size) pen.text(label, (from + to) / 2 + 0.3 * size, below ? last : first, place);
    return;
  }
  const line = pixelX(plot, at);
  pen.path([line, top, line, top + height], { stroke: colour, width: 1.2, dash: [5, 3] });
  // Beside the line, at the lowest place that no curve runs through.
  const long = pen.measure(label, size);
  const sides = [line + 0.5 * size, line - 0.5 * size - long].filter((x) => x > left && x + long < left + width);
  const levels = Array.from({ length: Math.max(Math.floor((last - first) / size), 1) }, (_, row) => last - row * size);
  const places = levels.flatMap((y) => (sides.length > 0 ? sides : [left]).map((x) => ({ x, y })));
  const crowds = places.map(({ x, y }) => crowdOf(chart, plot, { left: x, top: y - size, width: long, height: 1.3 * size }));
  const { x, y } = places[crowds.indexOf(Math.min(...crowds))] as (typeof places)[number];
  pen.text(label, x, y, style);
}

/** How high the legend is, in letters: a legend of one curve is none. */
const legendLines = ({ curves: { length } }: Chart): number => (length > 1 ? 1.3 * length + 1 : 0);

/** How much of the curves and marks of a chart lies in a box. */
function crowdOf({ at, curves, marks = [] }: Chart, plot: Plot, box: Box): number {
  const zero = inside(box, box.left, pixelY(plot, 0)) ? 1 : 0;
  let count = zero + marks.filter(({ x, y }) => inside(box, pixelX(plot, x), pixelY(plot, y))).length;
  for (const { y } of curves)
    for (let index = 1; index < at.length; index += 1) {
      const xs = [index - 1, index].map((place) => pixelX(plot, at[place] as number)) as Range;
      const ys = [index - 1, index].map((place) => pixelY(plot, y[place] as number)) as Range;
      if (xs[1] < box.left || xs[0] > box.left + box.width) continue;
      for (let share = 0; share <= 1; share += 1 / 16)
        if (inside(box, xs[0] + share * (xs[1] - xs[0]), ys[0] + share * (ys[1] - ys[0]))) count += 1;
    }
  return count;
}

/** Two standard errors on either side of a value, or its interval. */
function endsOf({ y, error, between }: Curve, index: number): number[] {
  const [value, by] = [y[index] ?? NaN, 2 * (error?.[index] ?? 0)];
  return between?.map((ends) => ends[index] ?? NaN) ?? [value - by, value + by];
}

/** A range with room for these curves and some more values. Errors of any size do not flatten the curves. */
export function spanOf(curves: readonly Curve[], more: readonly number[] = [], room = 0.05): Range {
  const values = curves.flatMap(({ y }) => Array.from(y).filter(Number.isFinite));
  const most = 1.6 * Math.max(...values.map(Math.abs), 0);
  const ends = curves.flatMap((curve) => Array.from(curve.y).flatMap((_, index) => endsOf(curve, index)));
  const all = extent([...more, ...values, ...ends.map((end) => clamp(end, -most, most))]);
  // Without any value but zero there is no scale to take from the numbers.
  return padded(all?.some((end) => end !== 0) ? all : [0, 1], room);
}

function paintBand(pen: Pen, { at }: Chart, curve: Curve, plot: Plot): void {
  if (curve.error === undefined && curve.between === undefined) return;
  const upper: number[] = [];
  const lower: number[] = [];
  for (let index = 0; index < at.length; index += 1) {
    const x = pixelX(plot, at[index] as number);
    const [low = NaN, high = NaN] = endsOf(curve, index);
    if (!Number.isFinite(low) || !Number.isFinite(high)) continue;
    upper.push(x, pixelY(plot, high));
    lower.unshift(x, pixelY(plot, low));
  }
  if (upper.length > 2) pen.path([...upper, ...lower], { fill: curve.colour, opacity: 0.25, close: true });
}

function paintCurve(pen: Pen, { at }: Chart, { y, colour, dash, points: marked }: Curve, plot: Plot): void {
  const points: number[] = [];
  for (let index = 0; index < at.length; index += 1) {
    const value = y[index] ?? NaN;
    points.push(...(Number.isFinite(value) ? [pixelX(plot, at[index] as number), pixelY(plot, value)] : [NaN, NaN]));
  }
  if (marked !== "alone") pen.path(points, { stroke: colour, width: 1.3, dash: dash ?? [] });
  if (marked === undefined || marked === false) return;
  for (let index = 0; index < points.length; index += 2) {
    const x = points[index] as number;
    if (!Number.isNaN(x)) pen.circle(x, points[index + 1] as number, 1.6, { fill: colour });
  }
}

function paintLegend(pen: Pen, chart: Chart, plot: Plot): void {
  const { size } = plot;
  const width = Math.max(...chart.curves.map((curve) => pen.measure(curve.label, size))) + size * 3.6;
  const [left, top] = [plot.left + plot.width - width - size * 0.6, plot.top + size * 0.6];
  const paper = { fill: "--picture-paper", stroke: "--picture-frame", width: 0.6 };
  pen.rect(left, top, width, chart.curves.length * size * 1.3 + size * 0.5, paper);
  chart.curves.forEach(({ label, colour, dash = [] }, index) => {
    const y = top + size * (0.9 + 1.3 * index);
    pen.path([left + size * 0.5, y, left + size * 2.4, y], { stroke: colour, width: 1.4, dash });
    pen.text(label, left + size * 2.9, y, { colour: "--picture-text", size, baseline: "middle" });
  });
}

/** Charts below each other, each so high, on one axis: all have the place that the longest numbers need. */
export function chartOffers(
  name: string, title: string, charts: readonly Chart[], each: number, basis: Basis,
): Offer[] {
  return pictureOffers({
    name,
    title,
    basis,
    width: ONE_COLUMN,
    height: each * charts.length,
    paint(pen, width) {
      const plots = charts.map((chart) => layOutChart(pen, chart, width, each, PRINT_SIZE));
      const numbers = plots.flatMap(({ yTicks }) => yTicks.map(({ label }) => label));
      const long = (label: string) => pen.measure(label, PRINT_SIZE);
      const widest = numbers.reduce((one, other) => (long(other) > long(one) ? other : one), "");
      charts.forEach((chart, index) => {
        const aligned = { ...chart, y: { ...chart.y, widest } };
        const plot = layOutChart(pen, aligned, width, each, PRINT_SIZE);
        paintChart(pen, aligned, { ...plot, top: plot.top + index * each });
      });
    },
  });
} // prettier-ignore

const SIZE = 12;

/** What a point of a curve leads to, with the sentence of its keys and what is read of the curve that is chosen. */
interface Picking {
  readonly keys: string;
  hint(curve: string): string;
  pick(at: number, curve: number): void;
}

/** A chart on the screen. The pointer and the keys move a cursor, whose values are read below the curves. */
export class ScreenChart {
  readonly root: HTMLElement;
  private readonly layers = new Layers("picture-chart", "");
  private readonly reading = element("p", { class: "reading", "aria-live": "polite" });
  private readonly caption = element("figcaption", { class: "alternative" });
  /** Stands in the place of a picture that is not there yet, or that there is none of. */
  private readonly word = element("p", { class: "chart-word" });
  private chart: Chart | null = null;
  private plot: Plot | null = null;
  /** The number of the values under the cursor, and the curve of which a point would be picked. */
  private at: number | null = null;
  private chosen = 0;

  constructor(
    private readonly height: () => number,
    private readonly picking?: Picking,
  ) {
    const { surface } = this.layers;
    this.root = element("figure", { class: "chart" }, this.word, this.reading, this.caption);
    surface.addEventListener("keydown", (event) => this.key(event));
    surface.addEventListener("pointermove", (event) => this.point(event));
    surface.addEventListener("pointerleave", () => this.read(null));
    surface.addEventListener("click", (event) => {
      this.point(event);
      this.pick();
    });
  }

  show(chart: Chart, alternative = ""): void {
    const { layers } = this;
    this.chart = chart;
    this.word.replaceWith(layers.root);
    layers.root.style.height = `${this.height()}px`;
    const keys = [WORDS.drawing.chart_keys, this.picking?.keys ?? ""].join(" ").trim();
    layers.surface.setAttribute("aria-label", say(WORDS.drawing.chart, { title: chart.title, text: alternative, keys }));
    setText(this.caption, alternative);
    layers.fit();
    const { width, height } = layers;
    if (width < 50) return;
    const pen = layers.data();
    this.plot = layOutChart(pen, chart, width, height, SIZE);
    paintChart(pen, chart, this.plot);
    this.paintCursor();
  }

  /** Shows a word in place of a chart, whose values are those of something else by now. */
  showWord(word: string): void {
    const { layers } = this;
    // The page does not jump while the next chart is computed.
    this.word.style.minHeight = `${layers.root.offsetHeight || this.word.offsetHeight || this.height()}px`;
    layers.root.replaceWith(this.word);
    this.chart = null;
    this.at = null;
    setText(this.word, word);
    setText(this.caption, "");
    setText(this.reading, "");
  }

  private key(event: KeyboardEvent): void {
    const { chart, at } = this;
    const last = (chart?.at.length ?? 0) - 1;
    if (chart === null || last < 0) return;
    const across = this.picking && { ArrowUp: -1, ArrowDown: 1 }[event.key];
    const along = { ArrowLeft: (at ?? last + 1) - 1, ArrowRight: (at ?? -1) + 1, Home: 0, End: last }[event.key];
    if (event.key === "Enter") return this.pick();
    if (across !== undefined) this.chosen = clamp(this.chosen + across, 0, chart.curves.length - 1);
    else if (along === undefined) return;
    event.preventDefault();
    this.read(clamp(along ?? at ?? 0, 0, last));
  }

  private pick(): void {
    if (this.at !== null) this.picking?.pick(this.at, this.chosen);
  }

  private point(event: MouseEvent): void {
    const { chart, plot } = this;
    if (chart === null || plot === null) return;
    const { x, y } = placeOn(this.layers.surface, event);
    const at = nearest(chart.at, valueX(plot, x));
    this.chosen = Math.max(nearest(chart.curves.map((curve) => pixelY(plot, curve.y[at] ?? NaN)), y), 0);
    if (at >= 0) this.read(at);
  }

  private read(at: number | null): void {
    this.at = at;
    this.paintCursor();
  }

  private paintCursor(): void {
    const { chart, plot, at } = this;
    const pen = this.layers.cursor();
    const known = chart !== null && plot !== null && at !== null && at < chart.at.length;
    if (!known) return setText(this.reading, "");
    const hint = this.picking?.hint(plainText(chart.curves[this.chosen]?.label ?? ""));
    setText(this.reading, hint === undefined ? readingOf(chart, at) : `${readingOf(chart, at)}. ${hint}`);
    const x = pixelX(plot, chart.at[at] as number);
    pen.path([x, plot.top, x, plot.top + plot.height], { stroke: "--picture-cursor", width: 1 });
    chart.curves.forEach(({ y, colour }, index) => {
      const radius = this.picking !== undefined && index === this.chosen ? 6 : 3.5;
      pen.circle(x, pixelY(plot, y[at] ?? NaN), radius, { fill: colour });
    });
  }
}

/** The number of the value that is nearest to one; -1 where there are none. */
function nearest(values: ArrayLike<number>, to: number): number {
  let found = -1;
  for (let index = 0; index < values.length; index += 1)
    if (Math.abs((values[index] as number) - to) < Math.abs((values[found] ?? Infinity) - to)) found = index;
  return found;
}

/** "time (s) 0.25: speed 1.2 ± 0.1": the values of one place with their standard errors or intervals. */
function readingOf({ x, y: axis, at, curves }: Chart, index: number): string {
  const { factor = 1 } = axis;
  const values = curves.map(({ label, y, error, between }) => {
    const [low, high] = between?.map((ends) => plain((ends[index] ?? NaN) * factor)) ?? [];
    const value = axis.powers === true ? 10 ** (y[index] ?? NaN) : (y[index] ?? null);
    const interval = low === undefined || high === undefined ? "" : say(WORDS.drawing.interval, { low, high });
    return `${plainText(label)} ${withError(value, error?.[index] ?? null, factor)}${interval}`;
  });
  return `${plainText(x.label)} ${plain((at[index] ?? NaN) * (x.factor ?? 1))}: ${values.join(", ")}`;
}
