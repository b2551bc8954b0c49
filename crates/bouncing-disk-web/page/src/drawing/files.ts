/** Files that people take away: tables, parameters and pictures at the width of a journal's column. */

import type { Offer } from "../contract";
import { element } from "../elements";
import { layOut, paintAxes, type Axes, type Plot } from "./axes";
import { contextOf, SvgPen, type Pen } from "./pen";

/** One column of a journal, 8.6 cm, and two with their gap, 17.8 cm, in points. */
export const ONE_COLUMN = 243.8;
export const TWO_COLUMNS = 504.6;
/** Letters of captions and labels, in points. */
export const PRINT_SIZE = 8;
const PRINT_DOTS_PER_POINT = 600 / 72;

interface Picture {
  readonly name: string;
  readonly title: string;
  readonly width: number;
  readonly height: number;
  paint(pen: Pen, width: number, height: number): void;
}

export function pictureOffers(picture: Picture): Offer[] {
  const { name, title, width, height } = picture;
  const svg = () => {
    const pen = new SvgPen(width, height);
    picture.paint(pen, width, height);
    return pen.finish(title);
  };
  return [
    { name, kind: "svg", make: async () => new Blob([svg()], { type: "image/svg+xml" }) },
    { name, kind: "png", make: () => pngOf(svg(), width, height) },
  ];
}

/** A picture that is one plot with its axes. */
export function plotOffers(
  { axes, paint, ...picture }: Omit<Picture, "paint"> & { axes: Axes; paint(pen: Pen, plot: Plot): void },
): Offer[] {
  return pictureOffers({
    ...picture,
    paint(pen, width, height) {
      const plot = layOut(pen, width, height, axes, PRINT_SIZE);
      pen.clipped(plot, () => paint(pen, plot));
      paintAxes(pen, plot);
    },
  });
} // prettier-ignore

/** The browser draws the SVG. A page on the disk may read back what an address has all of in itself. */
async function pngOf(svg: string, ...points: [width: number, height: number]): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await image.decode();
  const [width, height] = points.map((length) => Math.round(length * PRINT_DOTS_PER_POINT)) as [number, number];
  const canvas = element("canvas", { width, height });
  contextOf(canvas).drawImage(image, 0, 0, width, height);
  return new Promise((resolve, reject) => {
    canvas.toBlob(
      (blob) => (blob === null ? reject(new Error("the picture is too large")) : resolve(blob)),
      "image/png",
    );
  });
}

type Row = ArrayLike<number | string>;

interface Table {
  readonly name: string;
  /** What it is and what it was computed with. */
  readonly parameters: unknown;
  /** Names with units: "time_s". */
  readonly columns: readonly string[];
  /** Row by row. */
  rows(): Iterable<Row>;
}

export function tableOffers(table: Table): Offer[] {
  const { name, parameters, columns } = table;
  const comma = (row: Row) => Array.from(row, csvCell).join(",");
  const csv = () => written(table, `# ${JSON.stringify(parameters)}\n${comma(columns)}\n`, comma, "\n", "\n", "text/csv");
  const head = () => `${JSON.stringify({ parameters, columns }).slice(0, -1)},"rows":[\n`;
  const list = (row: Row) => JSON.stringify(Array.from(row));
  const json = () => written(table, head(), list, ",\n", "\n]}\n", "application/json");
  return [
    { name, kind: "csv", make: csv },
    { name, kind: "json", make: json },
  ];
} // prettier-ignore

function csvCell(value: number | string): string {
  if (typeof value === "number") return Number.isNaN(value) ? "" : String(value);
  return /[",\n]/.test(value) ? `"${value.replace(/"/g, '""')}"` : value;
}

/** Rows that are written before the page gets its turn again. */
const ROWS_AT_ONCE = 4000;

async function written(
  table: Table, head: string, line: (row: Row) => string, between: string, end: string, type: string,
): Promise<Blob> {
  const parts = [head];
  let count = 0;
  for (const row of table.rows()) {
    parts.push(count === 0 ? "" : between, line(row));
    count += 1;
    if (count % ROWS_AT_ONCE === 0) await new Promise((resolve) => setTimeout(resolve, 0));
  }
  return new Blob([...parts, end], { type });
} // prettier-ignore

export function* rowsOf(numbers: Float64Array, width: number): Iterable<Float64Array> {
  for (let index = 0; index + width <= numbers.length; index += width) yield numbers.subarray(index, index + width);
}

export const fileName = ({ name, kind }: Offer): string => `${name.trim().replace(/\s+/g, "-").toLowerCase()}.${kind}`;

/** How long (ms) a browser may take to begin with saving. */
const PATIENCE = 60_000;

export function save(blob: Blob, download: string): void {
  const href = URL.createObjectURL(blob);
  element("a", { href, download }).click();
  setTimeout(() => URL.revokeObjectURL(href), PATIENCE);
}
