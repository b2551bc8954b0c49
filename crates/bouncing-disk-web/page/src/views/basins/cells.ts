/** The cells of one window of starts, coloured by what became of them, and the requests for them. */

import type { Context, State } from "../../contract";
import type { Plot } from "../../drawing/axes";
import { rounded } from "../../drawing/files";
import type { Pen } from "../../drawing/pen";
import { pixelWord, Raster } from "../../drawing/raster";
import type { Range } from "../../protocol";

/** The label of a cell of which no row has come. */
const UNKNOWN = 255;
const CATEGORIES = 8;
/** Cells from stripe to stripe of the pattern of undecided cells. */
const STRIPES = 6;

export interface Grid {
  readonly phase_periods: Range;
  readonly phases: number;
  readonly normalised_speed: Range;
  readonly speeds: number;
}

export class Cells {
  private readonly raster: Raster;
  private readonly labels: Uint8Array;

  /** `known` are the labels of the attractors by their colours; cells with others are undecided. */
  constructor(
    readonly grid: Grid,
    known: readonly number[],
  ) {
    const { phases, speeds } = grid;
    const labels = (this.labels = new Uint8Array(phases * speeds).fill(UNKNOWN));
    this.raster = new Raster(phases, speeds, (colour) => {
      const wordOf = (name: string) => pixelWord(colour(name));
      const [undecided, stripe] = [wordOf("--undecided"), wordOf("--undecided-line")];
      const table = new Map(known.map((label, index) => [label, wordOf(categoryColour(index))]));
      const words = Uint32Array.from({ length: 256 }, (_, label) => (label === UNKNOWN ? 0 : (table.get(label) ?? 1)));
      return (x, y) => {
        const word = words[labels[(speeds - 1 - y) * phases + x] as number] as number;
        return word !== 1 ? word : (x + y) % STRIPES < 2 ? stripe : undecided;
      };
    });
  }

  /** Rows of cells; the lowest speed is at the bottom. */
  add(labels: Uint8Array, from: number): void {
    this.labels.set(labels, from * this.grid.phases);
    const top = this.grid.speeds - from;
    this.raster.change({ y: [top - labels.length / this.grid.phases, top] });
  }

  paint(pen: Pen, plot: Plot): void {
    this.raster.paint(pen, plot, { x: this.grid.phase_periods, y: this.grid.normalised_speed });
  }

  /** The label of the cell with this start; null where it is not known or outside. */
  at(phase: number, speed: number): number | null {
    const { phase_periods: x, normalised_speed: y, phases, speeds } = this.grid;
    const column = Math.floor(((phase - x[0]) / (x[1] - x[0])) * phases);
    const row = Math.floor(((speed - y[0]) / (y[1] - y[0])) * speeds);
    if (column < 0 || column >= phases || row < 0 || row >= speeds) return null;
    const label = this.labels[row * phases + column] as number;
    return label === UNKNOWN ? null : label;
  }

  /** Shares of the cells that are known, by label. */
  shares(): Map<number, number> {
    const counts = new Uint32Array(256);
    for (const label of this.labels) counts[label] = (counts[label] as number) + 1;
    const all = this.labels.length - (counts[UNKNOWN] as number);
    const shares = new Map<number, number>();
    counts.subarray(0, UNKNOWN).forEach((count, label) => {
      if (count !== 0) shares.set(label, count / all);
    });
    return shares;
  }

  /** Row by row from the lowest speed: phase, speed, label. */
  *rows(): Iterable<[number, number, number]> {
    const { phase_periods: x, normalised_speed: y, phases, speeds } = this.grid;
    const middle = ([low, high]: Range, cell: number, cells: number) =>
      rounded(low + ((cell + 0.5) / cells) * (high - low), (high - low) / cells / 1000);
    const places = Array.from({ length: phases }, (_, column) => middle(x, column, phases));
    for (let row = 0; row < speeds; row += 1) {
      const speed = middle(y, row, speeds);
      for (let column = 0; column < phases; column += 1) {
        const label = this.labels[row * phases + column] as number;
        if (label !== UNKNOWN) yield [places[column] as number, speed, label];
      }
    }
  }
}

/** Colours repeat only after eight attractors; the first one is mostly the disk at rest. */
export const categoryColour = (index: number): string =>
  `--category-${index < CATEGORIES ? index : 1 + ((index - 1) % (CATEGORIES - 1))}`;

const MOST_PHASES = 600;
const MOST_SPEEDS = 450;
/** Cells of one request: some ten milliseconds of the worker. */
const CELLS_AT_ONCE = 12_000;

/** The grid of a plot of so many device pixels. */
export const gridOf = (window: State["basins"], columns: number, rows: number): Grid => ({
  ...window,
  phases: Math.max(Math.min(columns, MOST_PHASES), 2),
  speeds: Math.max(Math.min(rows, MOST_SPEEDS), 2),
});

/** Gives the labels of some rows of the grid after the other to `take`. */
export async function computeCells(
  context: Context,
  { system: map }: State,
  grid: Grid,
  take: (labels: Uint8Array, from: number) => void,
): Promise<void> {
  const step = Math.max(Math.floor(CELLS_AT_ONCE / grid.phases), 1);
  const requests = Array.from({ length: Math.ceil(grid.speeds / step) }, (_, part) => {
    const rows = [part * step, Math.min((part + 1) * step, grid.speeds)];
    return { call: "basins", map, ...grid, rows };
  });
  await context.client.series("basins", requests, ({ bytes }, part) => take(bytes, part * step));
}
