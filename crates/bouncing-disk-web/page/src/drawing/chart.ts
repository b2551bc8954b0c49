/** A chart of curves: for files by a pen, on the screen by uPlot, which gives cursor, legend with values and speed. */

import uPlot from "uplot";
import { element, setText } from "../elements";
import { minus, plain, withError } from "../numbers";
import type { Range } from "../protocol";
import {
  clippedTo, crossAt, layOut, NO_TICKS, paintAxes, paintGrid, pixelX, pixelY, type Axis, type Box, type Plot,
} from "./axes"; // prettier-ignore
import { themeColour } from "./colours";
import { CanvasPen, plainText, SCREEN_FONT, type Pen } from "./pen";

export interface Curve {
  /** "disk"; the legend adds the value under the cursor. */
  readonly label: string;
  readonly y: ArrayLike<number>;
  /** Standard errors: a band of twice this is drawn. */
  readonly error?: ArrayLike<number>;
  /** The name of a custom property of `theme.css`. */
  readonly colour: string;
  readonly dash?: readonly number[];
  readonly points?: boolean;
}

/** A vertical line with a word. */
export interface Line {
  readonly x: number;
  readonly error?: number;
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
  readonly lines?: readonly Line[];
  readonly marks?: readonly Mark[];
  /** A grey stretch of the x axis. */
  readonly shade?: { readonly range: Range; readonly label: string };
}

/** Where a chart in a box of `width` by `height` has its axes. */
export function layOutChart(pen: Pen, { x, y, curves }: Chart, width: number, height: number, size: number): Plot {
  // A legend stands above the curves, not on them.
  const [low, high] = y.range;
  const room = curves.length > 1 ? ((1.3 * curves.length + 2) * size) / height : 0;
  return layOut(pen, width, height, { x, y: { ...y, range: [low, high + room * 1.4 * (high - low)] } }, size);
}

/** The whole chart with its legend, in a box of `width` by `height`. */
export function paintChart(pen: Pen, chart: Chart, width: number, height: number, size: number): void {
  const plot = layOutChart(pen, chart, width, height, size);
  paintGrid(pen, plot);
  clippedTo(plot, pen, () => {
    paintExtras(pen, chart, plot);
    for (const curve of chart.curves) paintCurve(pen, chart, curve, plot);
  });
  paintAxes(pen, plot);
  if (chart.curves.length > 1) paintLegend(pen, chart, plot);
}

/** Shaded stretches, lines, marks and bands, which lie below the curves. */
function paintExtras(pen: Pen, chart: Chart, plot: Plot): void {
  const bottom = plot.top + plot.height;
  const zero = pixelY(plot, 0);
  if (chart.shade !== undefined) {
    const from = pixelX(plot, chart.shade.range[0]);
    const to = pixelX(plot, chart.shade.range[1]);
    pen.rect(from, plot.top, to - from, plot.height, { fill: "--runaway" });
    const middle = Math.max(Math.min((from + Math.min(to, plot.left + plot.width)) / 2, to), from);
    // Away from the zero, where the marks of runaway loads stand.
    const below = zero < plot.top + plot.height / 2;
    const end = below ? bottom - plot.size * 0.5 : plot.top + plot.size * 0.5;
    const anchor = below ? "start" : "end";
    const style = { colour: "--picture-text", size: plot.size, anchor, upwards: true } as const;
    if (to - from > plot.size) pen.text(chart.shade.label, middle, end, style);
  }
  if (zero > plot.top && zero < bottom) {
    pen.path([plot.left, zero, plot.left + plot.width, zero], { stroke: "--picture-muted", width: 1 });
  }
  for (const line of chart.lines ?? []) {
    const at = pixelX(plot, line.x);
    if (line.error !== undefined) {
      const low = pixelX(plot, line.x - 2 * line.error);
      const band = { fill: line.colour, opacity: 0.25 };
      pen.rect(low, plot.top, pixelX(plot, line.x + 2 * line.error) - low, plot.height, band);
    }
    pen.path([at, plot.top, at, bottom], { stroke: line.colour, width: 1.2, dash: [5, 3] });
    const nearRight = at > plot.left + plot.width * 0.6;
    pen.text(line.label, at + (nearRight ? -4 : 4), bottom - plot.size * 0.5, {
      colour: line.colour,
      size: plot.size,
      anchor: nearRight ? "end" : "start",
      baseline: "bottom",
      halo: "--picture-paper",
    });
  }
  for (const mark of chart.marks ?? []) {
    const at = pixelX(plot, mark.x);
    const level = pixelY(plot, mark.y);
    const stroke = { stroke: mark.colour, width: 1.6 };
    const arm = plot.size * 0.4;
    if (mark.form === "circle") pen.circle(at, level, arm, { ...stroke, fill: "--picture-paper" });
    else pen.path(crossAt(at, level, arm), stroke);
  }
  for (const curve of chart.curves) paintBand(pen, chart, curve, plot);
}

/** Two standard errors on either side of a curve. */
function paintBand(pen: Pen, { at }: Chart, { y, error, colour }: Curve, plot: Plot): void {
  if (error === undefined) return;
  const upper: number[] = [];
  const lower: number[] = [];
  for (let index = 0; index < at.length; index += 1) {
    const x = pixelX(plot, at[index] as number);
    const [value, by] = [y[index] ?? NaN, 2 * (error[index] ?? NaN)];
    if (!Number.isFinite(value + by)) continue;
    upper.push(x, pixelY(plot, value + by));
    lower.unshift(x, pixelY(plot, value - by));
  }
  if (upper.length > 2) pen.path([...upper, ...lower], { fill: colour, opacity: 0.25, close: true });
}

function paintCurve(pen: Pen, { at }: Chart, { y, colour, dash, points: marked }: Curve, plot: Plot): void {
  const points: number[] = [];
  for (let index = 0; index < at.length; index += 1) {
    const value = y[index] ?? NaN;
    points.push(...(Number.isFinite(value) ? [pixelX(plot, at[index] as number), pixelY(plot, value)] : [NaN, NaN]));
  }
  pen.path(points, { stroke: colour, width: 1.3, dash: dash ?? [] });
  if (marked !== true) return;
  for (let index = 0; index < points.length; index += 2) {
    const x = points[index] as number;
    if (!Number.isNaN(x)) pen.circle(x, points[index + 1] as number, 1.6, { fill: colour });
  }
}

function paintLegend(pen: Pen, chart: Chart, plot: Plot): void {
  const { size } = plot;
  const widest = Math.max(...chart.curves.map((curve) => pen.measure(curve.label, size)));
  const width = widest + size * 3.6;
  const left = plot.left + plot.width - width - size * 0.6;
  const top = plot.top + size * 0.6;
  const paper = { fill: "--picture-paper", stroke: "--picture-frame", width: 0.6 };
  pen.rect(left, top, width, chart.curves.length * size * 1.3 + size * 0.5, paper);
  chart.curves.forEach((curve, index) => {
    const y = top + size * (0.9 + 1.3 * index);
    const style = { stroke: curve.colour, width: 1.4, dash: curve.dash ?? [] };
    pen.path([left + size * 0.5, y, left + size * 2.4, y], style);
    pen.text(curve.label, left + size * 2.9, y, { colour: "--picture-text", size, baseline: "middle" });
  });
}

const SIZE = 12;
const KEYS = "Left and right read the values one by one, Home and End the first and the last.";

/** A chart of curves on the screen by uPlot, which gives cursor, legend with values and speed. */
export class ScreenChart {
  readonly root: HTMLElement;
  private readonly stage = element("div", { class: "chart-stage", role: "application", tabindex: 0 });
  /** The values under the cursor, for screen readers. */
  private readonly reading = element("p", { class: "hidden", "aria-live": "polite" });
  private readonly caption = element("figcaption", { class: "alternative" });
  /** Stands in the place of a picture that is not there yet, or that there is none of. */
  private readonly word = element("p", { class: "chart-word", hidden: true });
  private plot: uPlot | null = null;
  private made = "";
  private chart: Chart | null = null;

  constructor(private readonly height: () => number) {
    this.root = element("figure", { class: "chart" }, this.word, this.stage, this.caption, this.reading);
    this.stage.addEventListener("keydown", (event) => this.key(event));
  }

  /** Shows a chart. The same kinds of curves are only filled anew, which is quick. */
  show(chart: Chart, alternative?: string): void {
    this.chart = chart;
    this.word.hidden = true;
    this.stage.hidden = false;
    this.stage.setAttribute("aria-label", `Chart: ${chart.title}. ${alternative ?? ""} ${KEYS}`);
    if (alternative !== undefined) setText(this.caption, alternative);
    const width = Math.floor(this.root.clientWidth);
    if (width < 50) return;
    const height = this.height();
    const key = [
      chart.title, chart.x.label, chart.y.label, ...chart.curves.map(({ label }) => label),
      themeColour("--picture-paper"), window.devicePixelRatio,
    ].join("\n"); // prettier-ignore
    if (this.plot === null || key !== this.made) {
      this.plot?.destroy();
      this.made = key;
      this.plot = new uPlot(this.options(chart, width, height), columns(chart), this.stage);
    } else {
      if (this.plot.width !== width || this.plot.height !== height) this.plot.setSize({ width, height });
      this.plot.setData(columns(chart), true);
    }
  }

  /** Shows a word in place of a chart, whose values are those of something else by now. */
  showWord(word: string): void {
    // The page does not jump while the next chart is computed.
    this.word.style.minHeight = `${this.stage.offsetHeight || this.word.offsetHeight || this.height()}px`;
    this.plot?.destroy();
    this.plot = null;
    this.chart = null;
    this.stage.hidden = true;
    this.word.hidden = false;
    setText(this.word, word);
    setText(this.caption, "");
    setText(this.reading, "");
  }

  /** The cursor of the keyboard goes from value to value. */
  private key(event: KeyboardEvent): void {
    const { plot, chart } = this;
    if (plot === null || chart === null || chart.at.length === 0) return;
    const last = chart.at.length - 1;
    const at = plot.cursor.idx ?? null;
    const targets: Readonly<Record<string, number>> = {
      ArrowLeft: at === null ? last : Math.max(at - 1, 0),
      ArrowRight: at === null ? 0 : Math.min(at + 1, last),
      Home: 0,
      End: last,
    };
    const target = targets[event.key];
    if (target === undefined) return;
    event.preventDefault();
    plot.setCursor({ left: plot.valToPos(chart.at[target] as number, "x"), top: plot.bbox.height / 2 });
    setText(this.reading, readingOf(chart, target));
  }

  private options(chart: Chart, width: number, height: number): uPlot.Options {
    const font = `${SIZE}px ${SCREEN_FONT}`;
    const frame = { stroke: themeColour("--picture-frame"), width: 1 };
    const axis = (label: string, size: number): uPlot.Axis => ({
      label: plainText(label),
      labelFont: font,
      font,
      labelSize: 20,
      size,
      stroke: themeColour("--picture-text"),
      grid: { stroke: themeColour("--picture-grid"), width: 1 },
      ticks: { ...frame, size: 5 },
      border: { ...frame, show: true },
      values: (_, splits) => splits.map((value) => minus(String(Number(value.toPrecision(10))))),
    });
    const series = chart.curves.map(({ label, colour, dash, points = false }): uPlot.Series => ({
      label,
      stroke: themeColour(colour),
      width: 1.6,
      pxAlign: 0,
      ...(dash === undefined ? {} : { dash: [...dash] }),
      points: { show: points, size: 5, fill: themeColour(colour) },
      value: (_, value: number | null) => plain(value),
    }));
    return {
      width,
      height,
      // Points between pixels keep curves smooth.
      pxAlign: 0,
      series: [{ label: plainText(chart.x.label).replace(/ \(.*/, ""), value: (_, value) => plain(value) }, ...series],
      scales: {
        x: { time: false, range: () => (this.chart ?? chart).x.range },
        y: { range: () => (this.chart ?? chart).y.range },
      },
      axes: [axis(chart.x.label, 34), axis(chart.y.label, 56)],
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      legend: {
        // A line like that of the curve, for those who do not tell the colours apart.
        markers: { width: 2, fill: () => "", dash: (plot, index) => (plot.series[index]?.dash ? "dashed" : "solid") },
      },
      padding: [10, 12, 0, 0],
      hooks: { drawAxes: [(plot) => this.paintBelow(plot)] },
    };
  }

  /** What uPlot does not have, below its curves. */
  private paintBelow({ ctx, bbox }: uPlot): void {
    const { chart } = this;
    if (chart === null) return;
    const ratio = uPlot.pxRatio;
    const [left, top, width, height] = [bbox.left, bbox.top, bbox.width, bbox.height].map((one) => one / ratio);
    const box = { left, top, width, height } as Box;
    const plot: Plot = { ...box, x: chart.x, y: chart.y, xTicks: NO_TICKS, yTicks: NO_TICKS, size: SIZE };
    const pen = new CanvasPen(ctx);
    ctx.save();
    ctx.scale(ratio, ratio);
    clippedTo(plot, pen, () => paintExtras(pen, chart, plot));
    ctx.restore();
  }
}

/** "time (s) 0.25: speed 1.2 ± 0.1": the values of one place with their standard errors. */
function readingOf({ x, at, curves }: Chart, index: number): string {
  const values = curves.map(({ label, y, error }) => `${label} ${withError(y[index] ?? null, error?.[index] ?? null)}`);
  return `${plainText(x.label)} ${plain(at[index])}: ${values.join(", ")}`;
}

/** uPlot knows a gap as null. */
function columns({ at, curves }: Chart): uPlot.AlignedData {
  const gaps = ({ y }: Curve) => Array.from(y, (value) => (Number.isFinite(value) ? value : null));
  return [Array.from(at), ...curves.map(gaps)] as uPlot.AlignedData;
}
