/** The dots of the diagram: the columns that have come, the picture of them, and the last one until it is replaced. */

import type { Quantity, State } from "../../contract";
import { clamp, extent, padded, type Plot } from "../../drawing/axes";
import { contextOf, type Pen } from "../../drawing/pen";
import { pixelWord, Raster } from "../../drawing/raster";
import type { Window2 } from "../../drawing/window";
import { element } from "../../elements";
import { DIAGRAM_COLUMNS, type Range } from "../../protocol";
import { axisValue, columnOf, RECORDED, type Columns } from "./columns";

type Diagram = State["diagram"];

const WIDTH = DIAGRAM_COLUMNS.length;
/** A range that is narrower than this would show rounding. */
const NARROWEST = 1e-9;

export class Dots {
  /** All answers for the present columns. */
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
    this.arrange(diagram, rows);
  }

  /** Makes the picture of the present quantity and range with all that has come, unless it is there: true if made. */
  arrange(diagram: Diagram, rows: number): boolean {
    const { quantity } = diagram;
    // Where there is nothing to see: of spins, between those that the platform has.
    const nothing: Range = quantity === "angular_speed" ? [-1, 1] : [0, 1];
    this.automatic = rangeOf(this.columns, quantity) ?? (this.complete ? nothing : this.automatic);
    const range = this.range(diagram);
    const key = JSON.stringify([this.name, quantity, range, rows]);
    if (key === this.drawn || this.count === 0) return false;
    if (this.drawn === "") this.previous = this.shown;
    this.drawn = key;
    this.shown = new OrbitPicture({ x: diagram.axial_forcing, y: range }, quantity, this.count, rows);
    for (const columns of this.columns) this.shown.add(columns);
    return true;
  }

  /** Pictures of another quantity do not stand on this one's axis. */
  paint(pen: Pen, plot: Plot, quantity: Quantity): void {
    for (const picture of [this.previous, this.shown]) if (picture?.quantity === quantity) picture.paint(pen, plot);
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

/** So many that no step between two of them is seen. */
const SHADES = 64;
/** All of an orbit in one pixel has the last colour. */
const SCALE = (SHADES - 1) / Math.log1p(RECORDED);

/** The dots of one window, counted in pixels and shown as densities: a cloud of dots costs no more than its pixels. */
class OrbitPicture {
  private readonly raster: Raster;
  /** Columns that have come, as empty paper in which dots are then counted; the others stay transparent. */
  private readonly known: Uint8Array;
  private readonly counts: Uint16Array;

  constructor(
    private readonly window: Window2,
    readonly quantity: Quantity,
    private readonly width: number,
    private readonly height: number,
  ) {
    const known = (this.known = new Uint8Array(width));
    const counts = (this.counts = new Uint16Array(width * height));
    this.raster = new Raster(width, height, (colour) => {
      const context = contextOf(element("canvas", { width: SHADES, height: 1 }));
      const gradient = context.createLinearGradient(0.5, 0, SHADES - 0.5, 0);
      for (let stop = 0; stop < 5; stop += 1) gradient.addColorStop(stop / 4, colour(`--density-${stop}`));
      context.fillStyle = gradient;
      context.fillRect(0, 0, SHADES, 1);
      const shades = new Uint32Array(context.getImageData(0, 0, SHADES, 1).data.buffer);
      const paper = pixelWord(colour("--picture-paper"));
      return (x, y) => {
        const count = counts[y * width + x] as number;
        if (count === 0) return known[x] === 0 ? 0 : paper;
        return shades[Math.min(Math.round(Math.log1p(count) * SCALE), SHADES - 1)] as number;
      };
    });
  }

  /** Counts an answer with the columns `[from, to)`. */
  add({ numbers, from, to }: Columns): void {
    const { x, y } = this.window;
    const field = columnOf(this.quantity);
    const [columnScale, rowScale] = [this.width / (x[1] - x[0]), this.height / (y[1] - y[0])];
    this.known.fill(1, from, to);
    this.raster.change({ x: [from, to] });
    for (let at = 0; at + WIDTH <= numbers.length; at += WIDTH) {
      // The last column is that of the upper end itself; the half keeps rounding from moving a column to its neighbour.
      const place = ((numbers[at] as number) - x[0]) * columnScale * ((this.width - 1) / this.width);
      const row = Math.floor((y[1] - axisValue(this.quantity, numbers[at + field] as number, y[0])) * rowScale);
      // What is outside is left out, as an angular speed that is not a number is.
      if (!(row >= 0 && row < this.height)) continue;
      const index = row * this.width + clamp(Math.floor(place + 0.5), from, to - 1);
      this.counts[index] = (this.counts[index] as number) + 1;
    }
  }

  paint(pen: Pen, plot: Plot): void {
    this.raster.paint(pen, plot, this.window);
  }
}
