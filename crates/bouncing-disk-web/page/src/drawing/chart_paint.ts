/** A chart of curves by a pen: for files, and the shapes that the chart on the screen adds to its curves. */

import { layOut, paintAxes, paintGrid, pixelX, pixelY } from "./axes";
import type { Plot } from "./axes";
import type { Chart, Curve } from "./chart";
import type { Colours } from "./colours";
import type { Pen } from "./pen";
import { linearScale } from "./scale";

/** Where a chart in a box of `width` by `height` has its axes. */
export function layOutChart(pen: Pen, chart: Chart, width: number, height: number, size: number): Plot {
  const x = { label: chart.xLabel, scale: linearScale(chart.xRange) };
  // A legend stands above the curves, not on them.
  const [low, high] = chart.yRange;
  const room = chart.curves.length > 1 ? ((1.3 * chart.curves.length + 2) * size) / height : 0;
  const y = { label: chart.yLabel, scale: linearScale([low, high + room * 1.4 * (high - low)]) };
  const widest = chart.widest === undefined ? {} : { widest: chart.widest };
  return layOut(pen, width, height, x, { ...y, ...widest }, size);
}

/** The whole chart with its legend, in a box of `width` by `height`. */
export function paintChart(pen: Pen, chart: Chart, colour: Colours, width: number, height: number, size: number): void {
  const plot = layOutChart(pen, chart, width, height, size);
  paintGrid(pen, plot, colour);
  pen.clipped(plot.left, plot.top, plot.width, plot.height, () => {
    paintExtras(pen, chart, plot, colour);
    for (const curve of chart.curves) paintCurve(pen, chart, curve, plot, colour);
  });
  paintAxes(pen, plot, colour);
  if (chart.curves.length > 1) paintLegend(pen, chart, plot, colour);
}

/** Shaded stretches, lines and marks. */
export function paintExtras(pen: Pen, chart: Chart, plot: Plot, colour: Colours): void {
  const bottom = plot.top + plot.height;
  const zero = pixelY(plot, 0);
  if (chart.shade !== undefined) {
    const from = pixelX(plot, chart.shade.range[0]);
    const to = pixelX(plot, chart.shade.range[1]);
    pen.rect(from, plot.top, to - from, plot.height, { fill: colour("--runaway") });
    const middle = Math.max(Math.min((from + Math.min(to, plot.left + plot.width)) / 2, to), from);
    // Away from the zero, where the marks of runaway loads stand.
    const below = zero < plot.top + plot.height / 2;
    const end = below ? bottom - plot.size * 0.5 : plot.top + plot.size * 0.5;
    const anchor = below ? "start" : "end";
    const style = { colour: colour("--picture-text"), size: plot.size, anchor, upwards: true } as const;
    if (to - from > plot.size) pen.text(chart.shade.label, middle, end, style);
  }
  if (zero > plot.top && zero < bottom) {
    pen.path([plot.left, zero, plot.left + plot.width, zero], { stroke: colour("--picture-muted"), width: 1 });
  }
  for (const line of chart.lines ?? []) {
    const at = pixelX(plot, line.x);
    if (line.error !== undefined) {
      const low = pixelX(plot, line.x - 2 * line.error);
      const band = { fill: colour(line.colour), opacity: 0.25 };
      pen.rect(low, plot.top, pixelX(plot, line.x + 2 * line.error) - low, plot.height, band);
    }
    pen.path([at, plot.top, at, bottom], { stroke: colour(line.colour), width: 1.2, dash: [5, 3] });
    const nearRight = at > plot.left + plot.width * 0.6;
    pen.text(line.label, at + (nearRight ? -4 : 4), bottom - plot.size * 0.5, {
      colour: colour(line.colour),
      size: plot.size,
      anchor: nearRight ? "end" : "start",
      baseline: "bottom",
      halo: colour("--picture-paper"),
    });
  }
  for (const mark of chart.marks ?? []) {
    const at = pixelX(plot, mark.x);
    const level = pixelY(plot, mark.y);
    const stroke = { stroke: colour(mark.colour), width: 1.6 };
    const arm = plot.size * 0.4;
    if (mark.form === "circle") pen.circle(at, level, arm, { ...stroke, fill: colour("--picture-paper") });
    else
      pen.path(
        [at - arm, level - arm, at + arm, level + arm, NaN, NaN, at - arm, level + arm, at + arm, level - arm],
        stroke,
      );
  }
}

function paintCurve(pen: Pen, chart: Chart, curve: Curve, plot: Plot, colour: Colours): void {
  const points: number[] = [];
  const band: number[] = [];
  const back: number[] = [];
  for (let index = 0; index < chart.x.length; index += 1) {
    const x = pixelX(plot, chart.x[index] as number);
    const value = curve.y[index] as number;
    const finite = Number.isFinite(value);
    points.push(finite ? x : NaN, finite ? pixelY(plot, value) : NaN);
    const error = curve.error?.[index] ?? NaN;
    if (!finite || !Number.isFinite(error)) continue;
    band.push(x, pixelY(plot, value + 2 * error));
    back.unshift(x, pixelY(plot, value - 2 * error));
  }
  if (band.length > 2) pen.path([...band, ...back], { fill: colour(curve.colour), opacity: 0.25, close: true });
  pen.path(points, { stroke: colour(curve.colour), width: 1.3, dash: curve.dash ?? [] });
  if (curve.points !== true) return;
  for (let index = 0; index < points.length; index += 2) {
    const x = points[index] as number;
    if (!Number.isNaN(x)) pen.circle(x, points[index + 1] as number, 1.6, { fill: colour(curve.colour) });
  }
}

function paintLegend(pen: Pen, chart: Chart, plot: Plot, colour: Colours): void {
  const { size } = plot;
  const widest = Math.max(...chart.curves.map((curve) => pen.measure(curve.label, size)));
  const width = widest + size * 3.6;
  const left = plot.left + plot.width - width - size * 0.6;
  const top = plot.top + size * 0.6;
  const paper = { fill: colour("--picture-paper"), stroke: colour("--picture-frame"), width: 0.6 };
  pen.rect(left, top, width, chart.curves.length * size * 1.3 + size * 0.5, paper);
  chart.curves.forEach((curve, index) => {
    const y = top + size * (0.9 + 1.3 * index);
    const style = { stroke: colour(curve.colour), width: 1.4, dash: curve.dash ?? [] };
    pen.path([left + size * 0.5, y, left + size * 2.4, y], style);
    pen.text(curve.label, left + size * 2.9, y, { colour: colour("--picture-text"), size, baseline: "middle" });
  });
}
