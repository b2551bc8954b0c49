/** What draws lines, areas and words: on a canvas, or into SVG. Lengths are in CSS pixels or, printed, in points. */

import { parseRichText } from "./rich_text";
import type { Run } from "./rich_text";

export interface PathStyle {
  stroke?: string;
  width?: number;
  dash?: readonly number[];
  fill?: string;
  opacity?: number;
  close?: boolean;
}

export interface TextStyle {
  colour: string;
  size: number;
  anchor?: "start" | "middle" | "end";
  baseline?: "top" | "middle" | "bottom";
  /** Turned by a quarter against the clock. */
  upwards?: boolean;
  bold?: boolean;
  /** The colour of a margin round the letters. */
  halo?: string;
}

export interface Pen {
  /** On paper lines stand where they belong, on a screen in the middle of pixels. */
  readonly printed: boolean;
  /** A polyline through x, y, x, y, ...; NaN lifts the pen. */
  path(points: ArrayLike<number>, style: PathStyle): void;
  circle(x: number, y: number, radius: number, style: PathStyle): void;
  rect(x: number, y: number, width: number, height: number, style: PathStyle): void;
  /** Words with *italic* letters and subscripts_{like this}. */
  text(text: string, x: number, y: number, style: TextStyle): void;
  measure(text: string, size: number): number;
  image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number, smooth: boolean): void;
  clipped(x: number, y: number, width: number, height: number, draw: () => void): void;
}

/** The size of a subscript relative to its line, and how far it hangs below. */
export const SUBSCRIPT_SIZE = 0.74;
export const SUBSCRIPT_DROP = 0.22;

/** Where the first line's baseline is, relative to the place asked for. */
export function baselineShift(baseline: TextStyle["baseline"], size: number): number {
  return baseline === "top"
    ? 0.8 * size
    : baseline === "middle"
      ? 0.34 * size
      : baseline === "bottom"
        ? -0.2 * size
        : 0;
}

/** Lines of print are finer than those of screens. */
export const PRINT_WEIGHT = 0.6;

export const SCREEN_FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif';
export const PRINT_FONT = '"STIX Two Text", "Times New Roman", Tinos, "Liberation Serif", "DejaVu Serif", serif';

let ruler: CanvasRenderingContext2D | null = null;

export function fontOf(run: Run, size: number, family: string, bold = false): string {
  const points = run.subscript ? size * SUBSCRIPT_SIZE : size;
  return `${run.italic ? "italic " : ""}${bold ? "600 " : ""}${points}px ${family}`;
}

export function measureRuns(text: string, size: number, family: string): number {
  ruler ??= document.createElement("canvas").getContext("2d");
  if (ruler === null) return 0.55 * size * text.length;
  let width = 0;
  for (const run of parseRichText(text)) {
    ruler.font = fontOf(run, size, family);
    width += ruler.measureText(run.text).width;
  }
  return width;
}

/** The same pen with its sheet moved down, or to the right: for pictures below each other, or in a corner. */
export function shifted(pen: Pen, down: number, right = 0): Pen {
  const moved = (points: ArrayLike<number>) =>
    Float64Array.from(points, (value, index) => value + (index % 2 === 1 ? down : right));
  return {
    printed: pen.printed,
    path: (points, style) => pen.path(moved(points), style),
    circle: (x, y, radius, style) => pen.circle(x + right, y + down, radius, style),
    rect: (x, y, width, height, style) => pen.rect(x + right, y + down, width, height, style),
    text: (text, x, y, style) => pen.text(text, x + right, y + down, style),
    measure: (text, size) => pen.measure(text, size),
    image: (source, x, y, width, height, smooth) => pen.image(source, x + right, y + down, width, height, smooth),
    clipped: (x, y, width, height, draw) => pen.clipped(x + right, y + down, width, height, draw),
  };
}
