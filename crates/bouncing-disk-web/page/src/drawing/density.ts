/** Dots counted in the pixels of a picture and shown as densities: a cloud of dots costs no more than its pixels. */

import { colourScale, pixelWord } from "./colours";
import type { Colours } from "./colours";

const SHADES = 64;

export class Density {
  readonly canvas = document.createElement("canvas");
  private readonly counts: Uint16Array;
  private readonly image: ImageData;
  private readonly words: Uint32Array;
  private readonly filled: Uint8Array;

  /** `most` dots in one pixel have the last colour. */
  constructor(
    readonly width: number,
    readonly height: number,
    private readonly most: number,
  ) {
    this.canvas.width = width;
    this.canvas.height = height;
    this.counts = new Uint16Array(width * height);
    this.image = new ImageData(width, height);
    this.words = new Uint32Array(this.image.data.buffer);
    this.filled = new Uint8Array(width);
  }

  /** Takes a column as empty paper, in which dots are then counted. */
  open(column: number): void {
    this.filled[column] = 1;
  }

  /** One dot; what is outside is left out. */
  count(column: number, row: number): void {
    if (column < 0 || column >= this.width || row < 0 || row >= this.height) return;
    const index = row * this.width + column;
    this.counts[index] = (this.counts[index] as number) + 1;
  }

  /** Colours the columns `[from, to)`; those that are not open stay transparent. */
  paint(from: number, to: number, colour: Colours): void {
    const shades = densityShades(colour);
    const paper = pixelWordOf(colour("--picture-paper"));
    const { width, height, counts, words, filled } = this;
    const scale = (SHADES - 1) / Math.log1p(this.most);
    for (let row = 0; row < height; row += 1) {
      for (let index = row * width + from, column = from; column < to; column += 1, index += 1) {
        if (filled[column] === 0) continue;
        const count = counts[index] as number;
        words[index] =
          count === 0 ? paper : (shades[Math.min(Math.round(Math.log1p(count) * scale), SHADES - 1)] as number);
      }
    }
    this.canvas.getContext("2d")?.putImageData(this.image, 0, 0, from, 0, to - from, height);
  }
}

let shadesKey = "";
let shadesNow: Uint32Array = new Uint32Array(SHADES);

/** The words of the shades, made anew only when the theme changes. */
function densityShades(colour: Colours): Uint32Array {
  const stops = [0, 1, 2, 3, 4].map((index) => colour(`--density-${index}`));
  const key = stops.join();
  if (key !== shadesKey) {
    shadesKey = key;
    shadesNow = Uint32Array.from(colourScale(stops, SHADES), pixelWord);
  }
  return shadesNow;
}

function pixelWordOf(text: string): number {
  const [first] = colourScale([text, text], 1);
  return first === undefined ? 0 : pixelWord(first);
}
