/** A picture of pixels, whose colours are those of the pen that paints it: of the present theme or of print. */

import { element } from "../elements";
import { pixelX, pixelY, type Plot } from "./axes";
import type { Range } from "../protocol";
import { contextOf, type Colours, type Pen } from "./pen";
import type { Window2 } from "./window";

export class Raster {
  private readonly canvas: HTMLCanvasElement;
  /** The colour of the paper that it was coloured for, and the rows that have changed since. */
  private paper = "";
  private rows = [Infinity, 0] as Range;

  constructor(
    width: number,
    height: number,
    /** Gives the word of the colour of a pixel; 0 is transparent. */
    private readonly colouring: (colour: Colours) => (x: number, y: number) => number,
  ) {
    this.canvas = element("canvas", { width, height });
  }

  /** Says that rows of pixels have to be coloured anew. */
  change(from = 0, to = this.canvas.height): void {
    this.rows = [Math.min(from, this.rows[0]), Math.max(to, this.rows[1])];
  }

  /** Paints it with its window into a plot of another one, stretched as it has to be. */
  paint(pen: Pen, plot: Plot, { x, y }: Window2): void {
    const paper = pen.colour("--picture-paper");
    if (paper !== this.paper) this.change();
    this.paper = paper;
    if (this.rows[1] > this.rows[0]) this.colour(pen.colour, this.rows);
    const [left, top] = [pixelX(plot, x[0]), pixelY(plot, y[1])];
    pen.image(this.canvas, left, top, pixelX(plot, x[1]) - left, pixelY(plot, y[0]) - top);
  }

  private colour(colours: Colours, [from, to]: Range): void {
    const { width } = this.canvas;
    const image = new ImageData(width, to - from);
    const words = new Uint32Array(image.data.buffer);
    const wordOf = this.colouring(colours);
    let index = 0;
    for (let y = from; y < to; y += 1) for (let x = 0; x < width; x += 1) words[index++] = wordOf(x, y);
    contextOf(this.canvas).putImageData(image, 0, from);
    this.rows = [Infinity, 0];
  }
}

/** The four bytes of an opaque pixel of a colour `#rrggbb` as one word, in the order of this machine. */
export function pixelWord(colour: string): number {
  const value = parseInt(colour.slice(1), 16);
  return new Uint32Array(Uint8Array.of(value >> 16, value >> 8, value, 255).buffer)[0] as number;
}
