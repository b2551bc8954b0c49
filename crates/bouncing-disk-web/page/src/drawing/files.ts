/** Files that people take away: tables, parameters and pictures at the width of a journal's column. */

import type { Offer } from "../contract";
import { CanvasPen } from "./canvas_pen";
import type { Colours } from "./colours";
import { printedColours } from "./colours";
import { PRINT_FONT, PRINT_WEIGHT } from "./pen";
import type { Pen } from "./pen";
import { SvgPen } from "./svg_pen";

/** One column of a journal, 8.6 cm, and two with their gap, 17.8 cm, in points. */
export const ONE_COLUMN = 243.8;
export const TWO_COLUMNS = 504.6;
/** Letters of captions and labels, in points. */
export const PRINT_SIZE = 8;
const PRINT_DOTS_PER_POINT = 600 / 72;

export interface Picture {
  readonly name: string;
  readonly title: string;
  readonly width: number;
  readonly height: number;
  paint(pen: Pen, colour: Colours, width: number, height: number): void;
}

export function pictureOffers(picture: Picture): Offer[] {
  return [
    { name: picture.name, kind: "svg", make: () => Promise.resolve(svgOf(picture)) },
    { name: picture.name, kind: "png", make: () => pngOf(picture) },
  ];
}

function svgOf(picture: Picture): Blob {
  const colour = printedColours();
  const pen = new SvgPen(picture.width, picture.height);
  picture.paint(pen, colour, picture.width, picture.height);
  return new Blob([pen.finish(picture.title, colour("--picture-paper"))], { type: "image/svg+xml" });
}

async function pngOf(picture: Picture): Promise<Blob> {
  const colour = printedColours();
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(picture.width * PRINT_DOTS_PER_POINT);
  canvas.height = Math.round(picture.height * PRINT_DOTS_PER_POINT);
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser gives no canvas to draw on");
  context.fillStyle = colour("--picture-paper");
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.scale(PRINT_DOTS_PER_POINT, PRINT_DOTS_PER_POINT);
  picture.paint(new CanvasPen(context, PRINT_FONT, PRINT_WEIGHT), colour, picture.width, picture.height);
  return new Promise((resolve, reject) => {
    canvas.toBlob(
      (blob) => (blob === null ? reject(new Error("the picture is too large")) : resolve(blob)),
      "image/png",
    );
  });
}

export interface Table {
  readonly name: string;
  /** What it is and what it was computed with. */
  readonly parameters: unknown;
  /** Names with units: "time_s". */
  readonly columns: readonly string[];
  /** Row by row. */
  rows(): Iterable<ArrayLike<number | string>>;
}

export function tableOffers(table: Table): Offer[] {
  return [
    { name: table.name, kind: "csv", make: () => csvOf(table) },
    { name: table.name, kind: "json", make: () => jsonOf(table) },
  ];
}

/** Rows that are written before the page gets its turn again. */
const ROWS_AT_ONCE = 4000;

async function csvOf(table: Table): Promise<Blob> {
  const parts = [
    `# ${JSON.stringify(table.parameters)}\n`,
    `${table.columns.map((name) => (name.includes(",") ? `"${name}"` : name)).join(",")}\n`,
  ];
  await inChunks(table, (row) => Array.from(row, csvCell).join(","), "\n", parts);
  parts.push("\n");
  return new Blob(parts, { type: "text/csv" });
}

function csvCell(value: number | string): string {
  if (typeof value === "number") return Number.isNaN(value) ? "" : String(value);
  return /[",\n]/.test(value) ? `"${value.replace(/"/g, '""')}"` : value;
}

async function jsonOf(table: Table): Promise<Blob> {
  const head = JSON.stringify({ parameters: table.parameters, columns: table.columns }).slice(0, -1);
  const parts = [`${head},"rows":[\n`];
  await inChunks(table, (row) => JSON.stringify(Array.from(row)), ",\n", parts);
  parts.push("\n]}\n");
  return new Blob(parts, { type: "application/json" });
}

async function inChunks(
  table: Table,
  write: (row: ArrayLike<number | string>) => string,
  between: string,
  parts: string[],
): Promise<void> {
  let lines: string[] = [];
  let first = true;
  const flush = () => {
    if (lines.length === 0) return;
    parts.push((first ? "" : between) + lines.join(between));
    first = false;
    lines = [];
  };
  for (const row of table.rows()) {
    lines.push(write(row));
    if (lines.length >= ROWS_AT_ONCE) {
      flush();
      await new Promise((resolve) => setTimeout(resolve, 0));
    }
  }
  flush();
}

/** The rows of a flat array. */
export function* rowsOf(numbers: Float64Array, width: number): Iterable<Float64Array> {
  for (let index = 0; index + width <= numbers.length; index += width) yield numbers.subarray(index, index + width);
}
