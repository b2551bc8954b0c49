/** The dots of the diagram: the columns that have come, the picture of them, and the last one until it is replaced. */

import type { Quantity, State } from "../../contract";
import { clamp, extent, padded, type Plot } from "../../drawing/axes";
import { colourScale, pixelWord } from "../../drawing/colours";
import type { Pen } from "../../drawing/pen";
import { Raster } from "../../drawing/raster";
import type { Window2 } from "../../drawing/window";
import { DIAGRAM_COLUMNS, type Range } from "../../protocol";
import { axisValue, COARSE, columnOf, RECORDED, type Columns } from "./columns";

type Diagram = State["diagram"];

const WIDTH = DIAGRAM_COLUMNS.length;
/** A range that is narrower than this would show rounding. */
const NARROWEST = 1e-9;

export class Dots {
  /** All answers for the present columns, coarse and fine. */
  columns: Columns[] = [];
  count = 0;
  private complete = false;
  private name = "";
  private drawn = "";
  private shown: OrbitPicture | null = null;
  private previous: OrbitPicture | null = null;
  /** The range of the axis that nobody chose: that of the dots. */
  private automatic: Range = [0, 1];

  range({ range, quantity }: Diagram): Range {
    return range ?? (quantity === "impact_phase" ? [0, 1] : this.automatic);
  }

  /** Others are on their way; the picture of the last ones stays until they come. */
  begin(name: string, count: number): void {
    Object.assign(this, { name, count, columns: [], complete: false, drawn: "" });
  }

  take(columns: Columns, diagram: Diagram, rows: number): void {
    this.columns.push(columns);
    if (!this.arrange(diagram, rows)) this.shown?.add(columns);
  }

  end(diagram: Diagram, rows: number): void {
    this.complete = true;
    this.previous = null;
    this.arrange(diagram, rows);
  }

  /** Makes the picture of the present quantity and range with all that has come, unless it is there: true if made. */
  arrange(diagram: Diagram, rows: number): boolean {
    const { quantity } = diagram;
    this.automatic = this.followed(quantity);
    const range = this.range(diagram);
    const key = JSON.stringify([this.name, quantity, range, rows]);
    if (key === this.drawn || this.count === 0) return false;
    if (this.drawn === "" || this.shown?.quantity !== quantity) this.previous = this.complete ? null : this.shown;
    this.drawn = key;
    this.shown = new OrbitPicture({ x: diagram.axial_forcing, y: range }, quantity, this.count, rows);
    for (const columns of this.columns) this.shown.add(columns);
    return true;
  }

  /** Pictures of another quantity do not stand on this one's axis. */
  paint(pen: Pen, plot: Plot, quantity: Quantity): void {
    for (const picture of [this.previous, this.shown]) if (picture?.quantity === quantity) picture.paint(pen, plot);
  }

  /**
   * The range that the dots ask for, whatever was seen before, when all are there. While they come it changes only as
   * often as it has to, for each change draws all of them anew.
   */
  private followed(quantity: Quantity): Range {
    const wanted = rangeOf(this.columns, quantity);
    // Where there is nothing to see: of spins, between those that the platform has.
    if (this.complete) return wanted ?? (quantity === "angular_speed" ? [-1, 1] : [0, 1]);
    if (wanted === null) return this.automatic;
    const [low, high] = this.automatic;
    const wider = wanted[0] < low || wanted[1] > high;
    const finer = wanted[1] - wanted[0] < 0.7 * (high - low);
    return wider || finer ? wanted : this.automatic;
  }
}

function rangeOf(columns: readonly Columns[], quantity: Quantity): Range | null {
  const parts = columns.flatMap(({ numbers }) => extent(numbers, columnOf(quantity), WIDTH) ?? []);
  const all = extent(parts);
  if (all === null) return null;
  const [low, high] = all[1] - all[0] < NARROWEST ? [all[0] - NARROWEST, all[1] + NARROWEST] : all;
  // An impact speed is none below zero.
  return quantity === "normalised_speed" ? [0, padded([0, high])[1]] : padded([low, high]);
}

/** The dots of one window of the orbit diagram, counted in pixels: coarse columns at once, fine ones as they come. */
class OrbitPicture {
  private readonly fine: Density;
  private readonly coarse: Density;

  constructor(
    private readonly window: Window2,
    readonly quantity: Quantity,
    columns: number,
    rows: number,
  ) {
    this.fine = new Density(columns, rows);
    this.coarse = new Density(Math.ceil(columns / COARSE), rows);
  }

  /** Counts an answer with the columns `[from, to)`, fine or coarse. */
  add({ numbers, from, to, coarse }: Columns): void {
    const density = coarse ? this.coarse : this.fine;
    const { x, y } = this.window;
    const field = columnOf(this.quantity);
    const columnScale = density.width / (x[1] - x[0]);
    const rowScale = density.height / (y[1] - y[0]);
    density.open(from, to);
    for (let row = 0; row + WIDTH <= numbers.length; row += WIDTH) {
      // The last column is that of the upper end itself; the half keeps rounding from moving a column to its neighbour.
      const place = ((numbers[row] as number) - x[0]) * columnScale * ((density.width - 1) / density.width);
      const value = axisValue(this.quantity, numbers[row + field] as number, y[0]);
      if (Number.isNaN(value)) continue;
      density.count(clamp(Math.floor(place + 0.5), from, to - 1), Math.floor((y[1] - value) * rowScale));
    }
  }

  paint(pen: Pen, plot: Plot): void {
    for (const { raster } of [this.coarse, this.fine]) raster.paint(pen, plot, this.window);
  }
}

const SHADES = 64;
/** All of an orbit in one pixel has the last colour. */
const SCALE = (SHADES - 1) / Math.log1p(RECORDED);

/** Dots counted in the pixels of a picture and shown as densities: a cloud of dots costs no more than its pixels. */
class Density {
  readonly raster: Raster;
  /** Columns that are taken as empty paper, in which dots are then counted; the others stay transparent. */
  private readonly opened: Uint8Array;
  private readonly counts: Uint16Array;

  constructor(
    readonly width: number,
    readonly height: number,
  ) {
    const opened = (this.opened = new Uint8Array(width));
    const counts = (this.counts = new Uint16Array(width * height));
    this.raster = new Raster(width, height, (colour) => {
      const shades = colourScale([0, 1, 2, 3, 4].map((index) => colour(`--density-${index}`)), SHADES); // prettier-ignore
      const paper = pixelWord(colour("--picture-paper"));
      return (x, y) => {
        const count = counts[y * width + x] as number;
        if (count === 0) return opened[x] === 0 ? 0 : paper;
        return shades[Math.min(Math.round(Math.log1p(count) * SCALE), SHADES - 1)] as number;
      };
    });
  }

  open(from: number, to: number): void {
    this.opened.fill(1, from, to);
    this.raster.change(from, 0, to, this.height);
  }

  /** One dot; what is outside is left out. */
  count(column: number, row: number): void {
    if (column < 0 || column >= this.width || row < 0 || row >= this.height) return;
    const index = row * this.width + column;
    this.counts[index] = (this.counts[index] as number) + 1;
  }
}
