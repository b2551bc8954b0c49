/** The dots of one window of the orbit diagram, counted in pixels: coarse columns at once, fine ones as they come. */

import type { Quantity } from "../../contract";
import type { Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import { Density } from "../../drawing/density";
import type { Pen } from "../../drawing/pen";
import { clamp } from "../../drawing/scale";
import { paintStretched } from "../../drawing/window_picture";
import type { Range } from "../../protocol";
import { DIAGRAM_COLUMNS } from "../../protocol";
import { axisValue, columnOf } from "./quantity";

const WIDTH = DIAGRAM_COLUMNS.length;
/** A coarse column stands for so many. */
export const COARSE = 8;

export class OrbitPicture {
  readonly window: { readonly x: Range; readonly y: Range };
  private readonly fine: Density;
  private readonly coarse: Density;

  constructor(
    forcing: Range,
    readonly quantity: Quantity,
    range: Range,
    readonly columns: number,
    readonly rows: number,
    recorded: number,
  ) {
    this.window = { x: forcing, y: range };
    this.fine = new Density(columns, rows, recorded);
    this.coarse = new Density(Math.ceil(columns / COARSE), rows, recorded);
  }

  /** Counts an answer with the columns `[from, to)`, fine or coarse, and colours them. */
  add(numbers: Float64Array, from: number, to: number, isCoarse: boolean, colour: Colours): void {
    const density = isCoarse ? this.coarse : this.fine;
    const { x, y } = this.window;
    const field = columnOf(this.quantity);
    const columnScale = density.width / (x[1] - x[0]);
    const rowScale = density.height / (y[1] - y[0]);
    for (let column = from; column < to; column += 1) density.open(column);
    for (let row = 0; row + WIDTH <= numbers.length; row += WIDTH) {
      // The last column is that of the upper end itself; the half keeps rounding from moving a column to its neighbour.
      const place = ((numbers[row] as number) - x[0]) * columnScale * ((density.width - 1) / density.width);
      const value = axisValue(this.quantity, numbers[row + field] as number, y[0]);
      if (Number.isNaN(value)) continue;
      density.count(clamp(Math.floor(place + 0.5), from, to - 1), Math.floor((y[1] - value) * rowScale));
    }
    density.paint(from, to, colour);
  }

  recolour(colour: Colours): void {
    this.coarse.paint(0, this.coarse.width, colour);
    this.fine.paint(0, this.fine.width, colour);
  }

  paint(pen: Pen, plot: Plot): void {
    paintStretched(pen, plot, this.coarse.canvas, this.window);
    paintStretched(pen, plot, this.fine.canvas, this.window);
  }
}
