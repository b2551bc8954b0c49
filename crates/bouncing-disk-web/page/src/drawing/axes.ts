/** The frame of a picture: where it lies, its ticks, numbers and labels. */

import { minus, prefixOf, superscript } from "../numbers";
import type { Range } from "../protocol";
import { say } from "../words";
import type { Box, Pen } from "./pen";

export interface Axis {
  /** With its unit: "load (µN m)". */
  readonly label: string;
  readonly range: Range;
  /** From the values of the range to the numbers beside the ticks. */
  readonly factor?: number;
  /** The values are exponents of ten: ticks stand at whole ones. */
  readonly powers?: boolean;
  /** The numbers beside a vertical axis have at least the place of this one. */
  readonly widest?: string;
}

/** An axis in the prefix of its unit that reads best; the label has a place for it: "height ({prefix}m)". */
export function prefixed(label: string, range: Range): Axis {
  const { factor, symbol } = prefixOf(Math.max(...range.map(Math.abs)));
  return { label: say(label, { prefix: symbol }), range, factor };
}

export type Axes = Readonly<Record<"x" | "y", Axis>>;

type Ticks = readonly { readonly value: number; readonly label: string }[];

export interface Plot extends Box, Axes {
  readonly xTicks: Ticks;
  readonly yTicks: Ticks;
  readonly size: number;
}

/** Finds the margins that numbers and labels need, in a picture of `width` by `height` with letters of `size`. */
export function layOut(pen: Pen, width: number, height: number, { x, y }: Axes, size: number): Plot {
  const top = Math.round(size * 0.9);
  const bottom = Math.round(size * 3.4);
  const plotHeight = Math.max(height - top - bottom, 20);
  const rows = Math.max(Math.floor(plotHeight / (size * 3.2)), 2);
  const yTicks = y.powers === true ? powersOfTen(y.range, rows) : ticks(y.range, rows, y.factor);
  const labels = [y.widest ?? "", ...yTicks.map((tick) => tick.label)];
  const numbers = Math.max(...labels.map((label) => pen.measure(label, size)), size);
  const left = Math.ceil(numbers + size * 2.5);
  const right = Math.ceil(size * 1.1);
  const plotWidth = Math.max(width - left - right, 20);
  let xTicks: Ticks = [];
  for (let count = Math.max(Math.floor(plotWidth / (size * 5)), 1); count >= 1; count -= 1) {
    xTicks = ticks(x.range, count, x.factor);
    const widest = Math.max(...xTicks.map((tick) => pen.measure(tick.label, size)), 0);
    if (xTicks.length * (widest + size) <= plotWidth) break;
  }
  return { left, top, width: plotWidth, height: plotHeight, x, y, xTicks, yTicks, size };
}

/** Where a value is in a range: 0 at the low end, 1 at the high end. */
const share = ([low, high]: Range, value: number): number => (value - low) / (high - low || 1);

export const pixelX = (plot: Plot, value: number): number => plot.left + plot.width * share(plot.x.range, value);
export const pixelY = (plot: Plot, value: number): number => plot.top + plot.height * (1 - share(plot.y.range, value));

const valueAt = ([low, high]: Range, share: number): number => low + share * (high - low || 1);
export const valueX = ({ left, width, x }: Plot, pixel: number): number => valueAt(x.range, (pixel - left) / width);
export const valueY = ({ top, height, y }: Plot, pixel: number): number => valueAt(y.range, 1 - (pixel - top) / height);

export const inside = ({ left, top, width, height }: Box, x: number, y: number): boolean =>
  x >= left && x <= left + width && y >= top && y <= top + height;

/** Two lines of this half length through a point, upright or at 45 degrees. */
export function crossAt(x: number, y: number, arm: number, upright = false): number[] {
  return upright
    ? [x - arm, y, x + arm, y, NaN, NaN, x, y - arm, x, y + arm]
    : [x - arm, y - arm, x + arm, y + arm, NaN, NaN, x - arm, y + arm, x + arm, y - arm];
}

/** Two lines through a value, from one side of a plot to the other. */
export function hairsAt(plot: Plot, [x, y]: readonly [number, number]): number[] {
  const [across, down] = [pixelX(plot, x), pixelY(plot, y)];
  const [right, bottom] = [plot.left + plot.width, plot.top + plot.height];
  return [across, plot.top, across, bottom, NaN, NaN, plot.left, down, right, down];
}

/** Frame, ticks inwards on all four sides, numbers and labels. */
export function paintAxes(pen: Pen, plot: Plot): void {
  const { size, xTicks, yTicks } = plot;
  // Ticks begin on the frame and not a pixel beside it.
  const [left, right] = [placed(pen, plot.left), placed(pen, plot.left + plot.width)];
  const [top, bottom] = [placed(pen, plot.top), placed(pen, plot.top + plot.height)];
  const points: number[] = [];
  const length = Math.round(size * 0.45);
  for (const { value } of xTicks) {
    const x = placed(pen, pixelX(plot, value));
    points.push(x, bottom, x, bottom - length, NaN, NaN, x, top, x, top + length, NaN, NaN);
  }
  for (const { value } of yTicks) {
    const y = placed(pen, pixelY(plot, value));
    points.push(left, y, left + length, y, NaN, NaN, right, y, right - length, y, NaN, NaN);
  }
  const frame = { stroke: "--picture-frame", width: 1 };
  pen.path(points, frame);
  pen.rect(left, top, right - left, bottom - top, frame);
  const ink = { colour: "--picture-text", size };
  for (const { value, label } of xTicks) {
    // A long number at an end of the axis stays in the picture.
    const half = pen.measure(label, size) / 2;
    const x = clamp(pixelX(plot, value), half, right + size - half);
    pen.text(label, x, bottom + size * 0.5, { ...ink, anchor: "middle", baseline: "top" });
  }
  for (const { value, label } of yTicks)
    pen.text(label, left - size * 0.5, pixelY(plot, value), { ...ink, anchor: "end", baseline: "middle" });
  const middle = { ...ink, anchor: "middle" } as const;
  pen.text(plot.x.label, (left + right) / 2, bottom + size * 2, { ...middle, baseline: "top" });
  pen.text(plot.y.label, size * 1.05, (top + bottom) / 2, { ...middle, upwards: true });
}

/** On a screen a line of one pixel fills one row of pixels if it runs through their middle. */
const placed = (pen: Pen, place: number): number => pen.printed ? place : Math.round(place - 0.5) + 0.5;

/** The smallest of 1, 2 and 5 times a power of ten that is not below a positive value. */
export function roundUp(value: number): number {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5].find((step) => value / power <= step) ?? 10) * power;
}

/** A range that has some room on both sides; never empty. */
export function padded([low, high]: Range, share = 0.05): Range {
  const room = high > low ? (high - low) * share : Math.abs(low) * 0.1 || 1;
  return [low - room, high + room];
}

/** So many numbers from one end of a range to the other. */
export const evenly = ([low, high]: Range, count: number): number[] =>
  Array.from({ length: count }, (_, index) => low + ((high - low) * index) / (count - 1));

/** The least and the greatest finite number; null if there is none. */
export function extent(values: ArrayLike<number>, start = 0, stride = 1): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (let index = start; index < values.length; index += stride) {
    const value = values[index] as number;
    if (value < low) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return low <= high && low > -Infinity ? [low, high] : null;
}

export const clamp = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);

/** At most about `count` labelled ticks. `factor` turns a value into the unit of the label. */
export function ticks([low, high]: Range, count: number, factor = 1): Ticks {
  const width = (high - low) * factor;
  if (!(width > 0)) return [];
  const size = roundUp(width / Math.max(count, 1));
  const decimals = Math.max(0, -Math.floor(Math.log10(size) + 1e-9));
  const slack = 1e-9;
  const first = Math.ceil((low * factor) / size - slack);
  const last = Math.floor((high * factor) / size + slack);
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, index) => {
    const value = (first + index) * size;
    return { value: value / factor, label: tickLabel(value, size, decimals) };
  });
}

function powersOfTen(range: Range, count: number): Ticks {
  const whole = ticks(range, count).filter(({ value }) => Number.isInteger(value));
  return whole.map(({ value }) => ({ value, label: `10${superscript(value)}` }));
}

function tickLabel(value: number, step: number, decimals: number): string {
  const bound = Math.abs(value) < step * 1e-6 ? 0 : value;
  // More decimals than a double has next to 1 are powers of ten of a small number.
  return minus(decimals <= 17 ? bound.toFixed(decimals) : bound.toPrecision(6));
}
