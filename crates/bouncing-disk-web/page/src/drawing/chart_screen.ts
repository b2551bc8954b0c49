/** A chart of curves on the screen by uPlot, which gives cursor, legend with values and speed. */

import uPlot from "uplot";

import type { Plot } from "./axes";
import { CanvasPen } from "./canvas_pen";
import type { Chart, Curve } from "./chart";
import { paintExtras } from "./chart_paint";
import type { Colours } from "./colours";
import { parseColour } from "./colours";
import { element, setText } from "./elements";
import { minus, plain, withError } from "./numbers";
import { SCREEN_FONT } from "./pen";
import { plainText } from "./rich_text";
import { linearScale } from "./scale";

const SIZE = 12;
const KEYS = "Left and right read the values one by one, Home and End the first and the last.";

export class ScreenChart {
  readonly root = element("figure", { class: "chart" });
  private readonly stage = element("div", { class: "chart-stage", role: "application", tabindex: 0 });
  /** The values under the cursor, for screen readers. */
  private readonly reading = element("p", { class: "hidden", "aria-live": "polite" });
  private readonly caption = element("figcaption", { class: "alternative" });
  private plot: uPlot | null = null;
  private made = "";
  private chart: Chart | null = null;

  /** Stands in the place of a picture that is not there yet, or that there is none of. */
  private readonly word = element("p", { class: "chart-word", hidden: true });

  constructor(private readonly height: () => number) {
    this.root.append(this.word, this.stage, this.caption, this.reading);
    this.stage.addEventListener("keydown", (event) => this.key(event));
  }

  /** Shows a chart. The same kinds of curves are only filled anew, which is quick. */
  show(chart: Chart, colour: Colours, alternative?: string): void {
    this.chart = chart;
    this.word.hidden = true;
    this.stage.hidden = false;
    this.stage.setAttribute("aria-label", `Chart: ${chart.title}. ${alternative ?? ""} ${KEYS}`);
    if (alternative !== undefined) setText(this.caption, alternative);
    const width = Math.floor(this.root.clientWidth);
    if (width < 50) return;
    const height = this.height();
    const key = JSON.stringify([
      chart.title, chart.xLabel, chart.yLabel, chart.curves.map((curve) => [curve.label, curve.error !== undefined]),
      colour("--picture-paper"), window.devicePixelRatio,
    ]); // prettier-ignore
    if (this.plot === null || key !== this.made) {
      this.made = key;
      this.plot?.destroy();
      this.plot = new uPlot(this.options(chart, colour, width, height), columns(chart), this.stage);
    } else {
      if (this.plot.width !== width || this.plot.height !== height) this.plot.setSize({ width, height });
      this.plot.setData(columns(chart), true);
    }
  }

  /** Shows a word in place of a chart, whose values are those of something else by now. */
  showWord(word: string): void {
    // The page does not jump while the next chart is computed.
    this.word.style.minHeight = `${this.stage.offsetHeight || this.word.offsetHeight || this.height()}px`;
    this.destroy();
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
    if (plot === null || chart === null || chart.x.length === 0) return;
    const last = chart.x.length - 1;
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
    plot.setCursor({ left: plot.valToPos(chart.x[target] as number, "x"), top: plot.bbox.height / 2 });
    setText(this.reading, readingOf(chart, target));
  }

  destroy(): void {
    this.plot?.destroy();
    this.plot = null;
    this.made = "";
  }

  private options(chart: Chart, colour: Colours, width: number, height: number): uPlot.Options {
    const ink = colour("--picture-text");
    const axis = (label: string, size?: number): uPlot.Axis => ({
      label: plainText(label),
      labelFont: `${SIZE}px ${SCREEN_FONT}`,
      font: `${SIZE}px ${SCREEN_FONT}`,
      labelSize: 20,
      stroke: ink,
      grid: { stroke: colour("--picture-grid"), width: 1 },
      ticks: { stroke: colour("--picture-frame"), width: 1, size: 5 },
      border: { show: true, stroke: colour("--picture-frame"), width: 1 },
      values: (_, splits) => splits.map((value) => minus(String(Number(value.toPrecision(10))))),
      ...(size === undefined ? {} : { size }),
    });
    const series: uPlot.Series[] = [
      { label: plainText(chart.xLabel).replace(/ \(.*/, ""), value: (_, value) => plain(value) },
    ];
    const bands: uPlot.Band[] = [];
    for (const curve of chart.curves) {
      series.push({
        label: curve.label,
        stroke: colour(curve.colour),
        width: 1.6,
        pxAlign: 0,
        ...(curve.dash === undefined ? {} : { dash: [...curve.dash] }),
        points: { show: curve.points === true, size: 5, fill: colour(curve.colour) },
        value: (_, value: number | null) => plain(value),
      });
      if (curve.error === undefined) continue;
      const at = series.length;
      const [red, green, blue] = parseColour(colour(curve.colour));
      const edge: uPlot.Series = { stroke: "transparent", width: 0, points: { show: false } };
      series.push({ ...edge, label: "upper" }, { ...edge, label: "lower" });
      bands.push({ series: [at, at + 1], fill: `rgba(${red}, ${green}, ${blue}, 0.25)` });
    }
    return {
      width,
      height,
      // Points between pixels keep curves smooth.
      pxAlign: 0,
      series,
      bands,
      scales: {
        x: { time: false, range: () => (this.chart ?? chart).xRange },
        y: { range: () => (this.chart ?? chart).yRange },
      },
      axes: [axis(chart.xLabel, 34), axis(chart.yLabel, 56)],
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      legend: {
        show: true,
        live: true,
        // A line like that of the curve, for those who do not tell the colours apart.
        markers: { width: 2, fill: () => "", dash: (plot, index) => (plot.series[index]?.dash ? "dashed" : "solid") },
      },
      padding: [10, 12, 0, 0],
      hooks: {
        drawAxes: [(plot) => this.extras(plot, colour)],
        ready: [(plot) => hideEdges(plot)],
      },
    };
  }

  private extras(plot: uPlot, colour: Colours): void {
    const { chart } = this;
    if (chart === null) return;
    const ratio = uPlot.pxRatio;
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.scale(ratio, ratio);
    const area: Plot = {
      left: bbox.left / ratio,
      top: bbox.top / ratio,
      width: bbox.width / ratio,
      height: bbox.height / ratio,
      x: { label: "", scale: linearScale(chart.xRange) },
      y: { label: "", scale: linearScale(chart.yRange) },
      xTicks: { major: [], minor: [] },
      yTicks: { major: [], minor: [] },
      size: SIZE,
    };
    const pen = new CanvasPen(ctx);
    pen.clipped(area.left, area.top, area.width, area.height, () => paintExtras(pen, chart, area, colour));
    ctx.restore();
  }
}

/** "time (s) 0.25: speed 1.2 ± 0.1": the values of one place with their standard errors. */
function readingOf(chart: Chart, index: number): string {
  const values = chart.curves.map(({ label, y, error }) => {
    const value = y[index];
    return `${label} ${withError(value === undefined ? null : value, error?.[index] ?? null)}`;
  });
  return `${plainText(chart.xLabel)} ${plain(chart.x[index])}: ${values.join(", ")}`;
}

/** The edges of bands are series to uPlot, but nothing to a reader. */
function hideEdges(plot: uPlot): void {
  const rows = plot.root.querySelectorAll<HTMLElement>(".u-legend .u-series");
  rows.forEach((row, index) => {
    const label = plot.series[index]?.label;
    if (label === "upper" || label === "lower") row.hidden = true;
  });
}

function columns(chart: Chart): uPlot.AlignedData {
  const data: (number | null)[][] = [Array.from(chart.x)];
  for (const curve of chart.curves) {
    data.push(gaps(curve));
    if (curve.error !== undefined) data.push(gaps(curve, 2), gaps(curve, -2));
  }
  return data as uPlot.AlignedData;
}

/** uPlot knows a gap as null. */
function gaps(curve: Curve, errors = 0): (number | null)[] {
  return Array.from(curve.y, (value, index) => {
    const shown = value + errors * (errors === 0 ? 0 : (curve.error?.[index] ?? NaN));
    return Number.isFinite(shown) ? shown : null;
  });
}
