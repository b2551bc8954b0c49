/** A picture of pixels, whose colours are those of the pen that paints it: of the present theme or of print. */

import { element } from "../elements";
import { pixelX, pixelY, type Plot } from "./axes";
import type { Range } from "../protocol";
import { contextOf, type Colours, type Pen } from "./pen";
import type { Window2 } from "./window";

export class Raster {
  private readonly canvas: HTMLCanvasElement;
  /** The colour of the paper that it was coloured for, and the columns and rows that have changed since. */
  private paper = "";
  private changed = UNCHANGED;

  constructor(
    width: number,
    height: number,
    /** Gives the word of the colour of a pixel; 0 is transparent. */
    private readonly colouring: (colour: Colours) => (x: number, y: number) => number,
  ) {
    this.canvas = element("canvas", { width, height });
  }

  /** Says that these columns and rows of pixels have to be coloured anew. */
  change({ x = [0, this.canvas.width], y = [0, this.canvas.height] }: Partial<Window2>): void {
    const { changed } = this;
    this.changed = { x: joined(changed.x, x), y: joined(changed.y, y) };
  }

  /** Paints it with its window into a plot of another one, stretched as it has to be. */
  paint(pen: Pen, plot: Plot, { x, y }: Window2): void {
    const paper = pen.colour("--picture-paper");
    if (paper !== this.paper) this.change({});
    this.paper = paper;
    const { x: columns, y: rows } = this.changed; // None have changed, at first.
    if (columns[0] < columns[1] && rows[0] < rows[1]) this.colour(pen.colour, this.changed);
    const [left, top] = [pixelX(plot, x[0]), pixelY(plot, y[1])];
    pen.image(this.canvas, left, top, pixelX(plot, x[1]) - left, pixelY(plot, y[0]) - top);
  }

  private colour(colours: Colours, { x: [left, right], y: [top, bottom] }: Window2): void {
    const image = new ImageData(right - left, bottom - top);
    const words = new Uint32Array(image.data.buffer);
    const wordOf = this.colouring(colours);
    let index = 0;
    for (let y = top; y < bottom; y += 1) for (let x = left; x < right; x += 1) words[index++] = wordOf(x, y);
    contextOf(this.canvas).putImageData(image, left, top);
    this.changed = UNCHANGED;
  }
}

const UNCHANGED: Window2 = { x: [Infinity, 0], y: [Infinity, 0] };

const joined = (one: Range, other: Range): Range => [Math.min(one[0], other[0]), Math.max(one[1], other[1])];

/** The four bytes of an opaque pixel of a colour `#rrggbb` as one word, in the order of this machine. */
export function pixelWord(colour: string): number {
  const value = parseInt(colour.slice(1), 16);
  return new Uint32Array(Uint8Array.of(value >> 16, value >> 8, value, 255).buffer)[0] as number;
}
