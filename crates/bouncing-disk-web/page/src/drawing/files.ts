/** Files that people take away: tables, parameters and pictures at the width of a journal's column. */

import { isLocal, link } from "../address";
import type { Offer, State } from "../contract";
import { element } from "../elements";
import { PARAMETERS, type Parameter } from "../form";
import { shown } from "../numbers";
import { SYSTEM_NAMES } from "../protocol";
import { toHash } from "../state";
import { say, WORDS } from "../words";
import { layOut, paintAxes, type Axes, type Plot } from "./axes";
import { contextOf, marked, plainText, SvgPen, wrapped, type Pen } from "./pen";

/** One column of a journal, 8.6 cm, and two with their gap, 17.8 cm, in points. */
export const ONE_COLUMN = 243.8;
export const TWO_COLUMNS = 504.6;
/** Letters of captions and labels, in points. */
export const PRINT_SIZE = 8;
const PRINT_DOTS_PER_POINT = 600 / 72;
/** Of the parameters below a picture. */
const SMALL_SIZE = 6;
const SMALL_LINE = 1.3 * SMALL_SIZE;

/** What a picture was computed with: parameters of a state, and sentences about what is no parameter. */
export interface Basis {
  readonly state: State;
  readonly names: readonly Parameter["name"][];
  readonly more?: readonly string[];
}

const SYSTEM = ["axial_forcing", ...SYSTEM_NAMES] as const;
const IMPACT = ["impact_phase", "normalised_speed"] as const;
/** Parts of the parameters: the system, with its mass, with the impact that its motion begins with, and so on. */
export const PARTS = {
  rotor: [...SYSTEM, "mass"],
  motion: [...SYSTEM, ...IMPACT, "angular_speed"],
  system: SYSTEM,
  platform: ["amplitude", "twist_amplitude", "angular_frequency", "phase_lag"],
  vertical: ["restitution", "contact_time", ...IMPACT],
  rotation: [...SYSTEM_NAMES.filter((name) => name !== "amplitude"), ...IMPACT],
  map: ["axial_forcing", "restitution", "contact_time"],
  all: [...SYSTEM, "mass", ...IMPACT, "angular_speed"],
} satisfies Record<string, Basis["names"]>;

/** The sentence on a stator that yields. */
export const statorWords = ({ motor: { stator } }: State): string[] =>
  stator === null ? [] : [say(WORDS.files.stator, { stator: JSON.stringify(stator) })];

/** Parameters as in the form, with their symbols in the markup of labels, and their values with units. */
export function valuesOf({ state, names }: Basis): { parameter: Parameter; symbol: string; value: string }[] {
  return PARAMETERS.filter(({ name }) => names.includes(name)).map((parameter) => {
    const number = parameter.value(state) ?? NaN;
    // Units that are themselves quantities are factors.
    const unit = parameter.unit === "" || number === 0 ? "" : `${/[ωπ]/.test(parameter.unit) ? " ×" : ""} ${parameter.unit}`;
    const value = `${shown(number, 6)}${unit}`;
    return { parameter, symbol: marked(parameter.symbol), value };
  });
}

interface Picture {
  readonly basis: Basis;
  readonly name: string;
  readonly title: string;
  readonly width: number;
  readonly height: number;
  /** Stands below it: what colours mean. */
  readonly legend?: readonly { readonly colour: string; readonly text: string }[];
  paint(pen: Pen, width: number, height: number): void;
}

export function pictureOffers(picture: Picture): Offer[] {
  const { name, title, width, height, basis, legend = [] } = picture;
  const values = valuesOf(basis).map(({ symbol, value }) => `${symbol} = ${value}`.replaceAll(" ", "\u00a0"));
  const words = [values.join(", "), ...(basis.more ?? [])].join("; ");
  const lines = [...legend, { colour: null, text: words }].flatMap(({ colour, text }) => {
    const left = colour === null ? SMALL_SIZE : 3 * SMALL_SIZE;
    return wrapped(text, SMALL_SIZE, width - left - SMALL_SIZE).map((line, row) => {
      return { line, left, colour: row === 0 ? colour : null };
    });
  });
  const whole = height + (lines.length + 0.5) * SMALL_LINE;
  const svg = () => {
    const pen = new SvgPen(width, whole);
    picture.paint(pen, width, height);
    const style = { colour: "--picture-muted", size: SMALL_SIZE, baseline: "top" } as const;
    lines.forEach(({ line, left, colour }, index) => {
      const top = height + index * SMALL_LINE;
      const swatch = { stroke: "--picture-frame", width: 0.6 };
      if (colour !== null) pen.rect(SMALL_SIZE, top, 1.5 * SMALL_SIZE, 0.9 * SMALL_SIZE, { fill: colour, ...swatch });
      pen.text(line, left, top, style);
    });
    // The folders of this computer are nobody's business.
    return pen.finish(title, plainText(words), isLocal() ? toHash(basis.state) : link(basis.state));
  };
  return [
    { name, kind: "svg", make: async () => new Blob([svg()], { type: "image/svg+xml" }) },
    { name, kind: "png", make: () => pngOf(svg(), width, whole) },
  ];
}

type PlotPicture = Omit<Picture, "paint"> & { axes: Axes; paint(pen: Pen, plot: Plot): void };

/** A picture that is one plot with its axes. */
export function plotOffers({ axes, paint, ...picture }: PlotPicture): Offer[] {
  return pictureOffers({
    ...picture,
    paint(pen, width, height) {
      const plot = layOut(pen, width, height, axes, PRINT_SIZE);
      pen.clipped(plot, () => paint(pen, plot));
      paintAxes(pen, plot);
    },
  });
}

/** The browser draws the SVG. A page on the disk may read back what an address has all of in itself. */
async function pngOf(svg: string, ...points: [width: number, height: number]): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await image.decode();
  const [width, height] = points.map((length) => Math.round(length * PRINT_DOTS_PER_POINT)) as [number, number];
  const canvas = element("canvas", { width, height });
  contextOf(canvas).drawImage(image, 0, 0, width, height);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  if (blob === null) throw new Error("the picture is too large");
  return blob;
}

type Row = ArrayLike<number | string>;

export interface Table {
  readonly name: string;
  /** What it is and what it was computed with. */
  readonly parameters: unknown;
  /** Names with units: "time_s". */
  readonly columns: readonly string[];
  /** Row by row. */
  rows(): Iterable<Row>;
}

/** For a spreadsheet, from the clipboard. */
export const tabbed = ({ columns, rows }: Table): string =>
  [columns, ...rows()].map((row) => Array.from(row).join("\t")).join("\n");

export function tableOffers(table: Table): Offer[] {
  const { name, parameters, columns } = table;
  const comma = (row: Row) => Array.from(row, csvCell).join(",");
  const list = (row: Row) => JSON.stringify(Array.from(row));
  const csv = [`# ${JSON.stringify(parameters)}\n${comma(columns)}\n`, "\n", "\n", "text/csv"] as const;
  const head = `${JSON.stringify({ parameters, columns }).slice(0, -1)},"rows":[\n`;
  const json = [head, ",\n", "\n]}\n", "application/json"] as const;
  return [
    { name, kind: "csv", make: () => written(table, comma, ...csv) },
    { name, kind: "json", make: () => written(table, list, ...json) },
  ];
}

function csvCell(value: number | string): string {
  if (typeof value === "number") return Number.isNaN(value) ? "" : String(value);
  return /[",\n]/.test(value) ? `"${value.replace(/"/g, '""')}"` : value;
}

/** How long (ms) rows are written before the page gets its turn again. */
const AT_ONCE = 10;

type Frame = [head: string, between: string, end: string, type: string];

async function written(table: Table, line: (row: Row) => string, ...[head, between, end, type]: Frame): Promise<Blob> {
  // A blob of a few long parts is made at once, one of every row in half a second.
  const parts: string[] = [];
  let text = head;
  let before = "";
  let began = performance.now();
  for (const row of table.rows()) {
    text += before + line(row);
    before = between;
    if (performance.now() - began < AT_ONCE) continue;
    parts.push(text);
    text = "";
    await new Promise((resolve) => setTimeout(resolve, 0));
    began = performance.now();
  }
  return new Blob([...parts, text, end], { type });
}

/** The decimals of this step: digits that no picture shows would be most of a file. */
export const rounded = (value: number, step: number): number =>
  Number(value.toFixed(Math.min(Math.max(Math.ceil(-Math.log10(step)), 0), 20)));

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
