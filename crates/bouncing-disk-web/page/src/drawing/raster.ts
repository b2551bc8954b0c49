/** A picture of pixels, whose colours are those of the pen that paints it: of the present theme or of print. */

import { element } from "../elements";
import { pixelX, pixelY, type Plot } from "./axes";
import type { Colours } from "./colours";
import { contextOf, type Pen } from "./pen";
import type { Window2 } from "./window";

/** The word of the colour of a pixel; 0 is transparent. */
type Colouring = (x: number, y: number) => number;

export class Raster {
  private readonly canvas: HTMLCanvasElement;
  /** The colour of the paper that it was coloured for, and the part that has changed since. */
  private paper = "";
  private changed = { left: Infinity, top: Infinity, right: 0, bottom: 0 };

  constructor(
    width: number,
    height: number,
    private readonly colouring: (colour: Colours) => Colouring,
  ) {
    this.canvas = element("canvas", { width, height });
  }

  /** Says that pixels have to be coloured anew. */
  change(left: number, top: number, right: number, bottom: number): void {
    const { changed } = this;
    this.changed = {
      left: Math.min(left, changed.left),
      top: Math.min(top, changed.top),
      right: Math.max(right, changed.right),
      bottom: Math.max(bottom, changed.bottom),
    };
  }

  /** Paints it with its window into a plot of another one, stretched as it has to be. */
  paint(pen: Pen, plot: Plot, { x, y }: Window2): void {
    const paper = pen.colour("--picture-paper");
    if (paper !== this.paper) this.change(0, 0, this.canvas.width, this.canvas.height);
    this.paper = paper;
    this.colour(pen.colour);
    const [left, top] = [pixelX(plot, x[0]), pixelY(plot, y[1])];
    pen.image(this.canvas, left, top, pixelX(plot, x[1]) - left, pixelY(plot, y[0]) - top);
  }

  private colour(colours: Colours): void {
    const { left, top, right, bottom } = this.changed;
    this.changed = { left: Infinity, top: Infinity, right: 0, bottom: 0 };
    if (right <= left || bottom <= top) return;
    const image = new ImageData(right - left, bottom - top);
    const words = new Uint32Array(image.data.buffer);
    const wordOf = this.colouring(colours);
    let index = 0;
    for (let y = top; y < bottom; y += 1) for (let x = left; x < right; x += 1) words[index++] = wordOf(x, y);
    contextOf(this.canvas).putImageData(image, left, top);
  }
}
