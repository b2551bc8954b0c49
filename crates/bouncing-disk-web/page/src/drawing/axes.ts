/** The frame of a picture: where it lies, its ticks, numbers and labels. */

import type { Colours } from "./colours";
import type { Pen } from "./pen";
import type { Scale } from "./scale";
import { ticks } from "./ticks";
import type { Ticks } from "./ticks";

export interface Axis {
  /** With its unit: "load (µN m)". */
  readonly label: string;
  readonly scale: Scale;
  /** From the values of the scale to the numbers beside the ticks. */
  readonly factor?: number;
  /** The numbers beside a vertical axis have at least the place of this one. */
  readonly widest?: string;
}

export interface Plot {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
  readonly x: Axis;
  readonly y: Axis;
  readonly xTicks: Ticks;
  readonly yTicks: Ticks;
  readonly size: number;
}

/** Finds the margins that numbers and labels need, in a picture of `width` by `height` with letters of `size`. */
export function layOut(pen: Pen, width: number, height: number, x: Axis, y: Axis, size: number): Plot {
  const top = Math.round(size * 0.9);
  const bottom = Math.round(size * 3.4);
  const plotHeight = Math.max(height - top - bottom, 20);
  const yTicks = ticks(y.scale, Math.max(Math.floor(plotHeight / (size * 3.2)), 2), y.factor);
  const labels = [y.widest ?? "", ...yTicks.major.map((tick) => tick.label)];
  const numbers = Math.max(...labels.map((label) => pen.measure(label, size)), size);
  const left = Math.ceil(numbers + size * 2.5);
  const right = Math.ceil(size * 1.1);
  const plotWidth = Math.max(width - left - right, 20);
  let xTicks: Ticks = { major: [], minor: [] };
  for (let count = Math.max(Math.floor(plotWidth / (size * 5)), 1); count >= 1; count -= 1) {
    xTicks = ticks(x.scale, count, x.factor);
    const widest = Math.max(...xTicks.major.map((tick) => pen.measure(tick.label, size)), 0);
    if (xTicks.major.length * (widest + size) <= plotWidth) break;
  }
  return { left, top, width: plotWidth, height: plotHeight, x, y, xTicks, yTicks, size };
}

export function pixelX(plot: Plot, value: number): number {
  return plot.left + plot.width * plot.x.scale.share(value);
}

export function pixelY(plot: Plot, value: number): number {
  return plot.top + plot.height * (1 - plot.y.scale.share(value));
}

export function valueX(plot: Plot, pixel: number): number {
  return plot.x.scale.value((pixel - plot.left) / plot.width);
}

export function valueY(plot: Plot, pixel: number): number {
  return plot.y.scale.value(1 - (pixel - plot.top) / plot.height);
}

export function inside(plot: Plot, x: number, y: number): boolean {
  return x >= plot.left && x <= plot.left + plot.width && y >= plot.top && y <= plot.top + plot.height;
}

/** Faint lines behind the data. */
export function paintGrid(pen: Pen, plot: Plot, colour: Colours): void {
  const points: number[] = [];
  for (const { value } of plot.xTicks.major) {
    const x = placed(pen, pixelX(plot, value));
    points.push(x, plot.top, x, plot.top + plot.height, NaN, NaN);
  }
  for (const { value } of plot.yTicks.major) {
    const y = placed(pen, pixelY(plot, value));
    points.push(plot.left, y, plot.left + plot.width, y, NaN, NaN);
  }
  pen.path(points, { stroke: colour("--picture-grid"), width: 1 });
}

/** Frame, ticks inwards on all four sides, numbers and labels. */
export function paintAxes(pen: Pen, plot: Plot, colour: Colours): void {
  const { size } = plot;
  // Ticks begin on the frame and not a pixel beside it.
  const [left, right] = [placed(pen, plot.left), placed(pen, plot.left + plot.width)];
  const [top, bottom] = [placed(pen, plot.top), placed(pen, plot.top + plot.height)];
  const [width, height] = [right - left, bottom - top];
  const long = Math.round(size * 0.45);
  const short = Math.round(size * 0.25);
  const points: number[] = [];
  const tickX = (value: number, length: number) => {
    const x = placed(pen, pixelX(plot, value));
    points.push(x, bottom, x, bottom - length, NaN, NaN, x, top, x, top + length, NaN, NaN);
  };
  const tickY = (value: number, length: number) => {
    const y = placed(pen, pixelY(plot, value));
    points.push(left, y, left + length, y, NaN, NaN, right, y, right - length, y, NaN, NaN);
  };
  for (const tick of plot.xTicks.major) tickX(tick.value, long);
  for (const value of plot.xTicks.minor) tickX(value, short);
  for (const tick of plot.yTicks.major) tickY(tick.value, long);
  for (const value of plot.yTicks.minor) tickY(value, short);
  const frame = colour("--picture-frame");
  pen.path(points, { stroke: frame, width: 1 });
  pen.rect(left, top, width, height, { stroke: frame, width: 1 });
  const ink = colour("--picture-text");
  for (const { value, label } of plot.xTicks.major) {
    // A long number at an end of the axis stays in the picture.
    const half = pen.measure(label, size) / 2;
    const x = Math.max(Math.min(pixelX(plot, value), right + size - half), half);
    pen.text(label, x, bottom + size * 0.5, { colour: ink, size, anchor: "middle", baseline: "top" });
  }
  for (const { value, label } of plot.yTicks.major) {
    pen.text(label, left - size * 0.5, pixelY(plot, value), { colour: ink, size, anchor: "end", baseline: "middle" });
  }
  const middle = left + width / 2;
  pen.text(plot.x.label, middle, bottom + size * 2, { colour: ink, size, anchor: "middle", baseline: "top" });
  const edge = size * 1.05;
  pen.text(plot.y.label, edge, top + height / 2, { colour: ink, size, anchor: "middle", upwards: true });
}

/** On a screen a line of one pixel fills one row of pixels if it runs through their middle. */
function placed(pen: Pen, place: number): number {
  return pen.printed ? place : Math.round(place - 0.5) + 0.5;
}
