/** The cells of one window of starts, coloured by what became of them. */

import type { Colours } from "../../drawing/colours";
import { parseColour, pixelWord } from "../../drawing/colours";
import type { Range } from "../../protocol";

/** The label of a cell of which no row has come. */
const UNKNOWN = 255;
/** What no attractor is called: the undecided ones. */
const UNDECIDED = 0;
const CATEGORIES = 8;
/** Pixels from stripe to stripe of the pattern of undecided cells. */
const STRIPES = 6;

export interface Grid {
  readonly phase_periods: Range;
  readonly phases: number;
  readonly normalised_speed: Range;
  readonly speeds: number;
}

export class Cells {
  readonly canvas = document.createElement("canvas");
  private readonly labels: Uint8Array;

  /** A cell has `scale` by `scale` pixels, so that the pattern of undecided cells is seen. */
  constructor(
    readonly grid: Grid,
    private readonly scale: number,
  ) {
    this.labels = new Uint8Array(grid.phases * grid.speeds).fill(UNKNOWN);
    this.canvas.width = grid.phases * scale;
    this.canvas.height = grid.speeds * scale;
  }

  get window(): { x: Range; y: Range } {
    return { x: this.grid.phase_periods, y: this.grid.normalised_speed };
  }

  add(labels: Uint8Array, from: number, known: readonly number[], colour: Colours): void {
    this.labels.set(labels, from * this.grid.phases);
    this.paint(from, from + labels.length / this.grid.phases, known, colour);
  }

  /** Colours rows of cells; the lowest speed is at the bottom. */
  paint(from: number, to: number, known: readonly number[], colour: Colours): void {
    const { scale, grid, labels } = this;
    const context = this.canvas.getContext("2d");
    if (context === null || to <= from) return;
    const width = grid.phases * scale;
    const image = context.createImageData(width, (to - from) * scale);
    const words = new Uint32Array(image.data.buffer);
    const table = new Uint32Array(256);
    const undecided = pixelWord(parseColour(colour("--undecided")));
    const stripe = pixelWord(parseColour(colour("--undecided-line")));
    table.fill(undecided);
    known.forEach((label, index) => {
      table[label] = pixelWord(parseColour(colour(categoryColour(index))));
    });
    table[UNKNOWN] = 0;
    const decided = new Uint8Array(256);
    for (const label of known) decided[label] = 1;
    decided[UNKNOWN] = 1;
    const top = (grid.speeds - to) * scale;
    for (let y = 0; y < image.height; y += 1) {
      const row = grid.speeds - 1 - Math.floor((top + y) / scale);
      for (let x = 0; x < width; x += 1) {
        const label = labels[row * grid.phases + Math.floor(x / scale)] as number;
        const isStripe = decided[label] === 0 && (x + top + y) % STRIPES < 2;
        words[y * width + x] = isStripe ? stripe : (table[label] as number);
      }
    }
    context.putImageData(image, 0, top);
  }

  repaint(known: readonly number[], colour: Colours): void {
    this.paint(0, this.grid.speeds, known, colour);
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
    for (let label = 0; label < UNKNOWN; label += 1) {
      if (counts[label] !== 0) shares.set(label, (counts[label] as number) / all);
    }
    return shares;
  }

  /** Row by row from the lowest speed: phase, speed, label. */
  *rows(): Iterable<[number, number, number]> {
    const { phase_periods: x, normalised_speed: y, phases, speeds } = this.grid;
    for (let row = 0; row < speeds; row += 1) {
      const speed = y[0] + ((row + 0.5) / speeds) * (y[1] - y[0]);
      for (let column = 0; column < phases; column += 1) {
        const label = this.labels[row * phases + column] as number;
        if (label === UNKNOWN) continue;
        yield [x[0] + ((column + 0.5) / phases) * (x[1] - x[0]), speed, label];
      }
    }
  }
}

export function isUndecided(label: number, known: readonly number[]): boolean {
  return label === UNDECIDED || !known.includes(label);
}

/** Colours repeat only after eight attractors; the first one is mostly the disk at rest. */
export function categoryColour(index: number): string {
  return `--category-${index < CATEGORIES ? index : 1 + ((index - 1) % (CATEGORIES - 1))}`;
}
