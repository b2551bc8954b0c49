/** What a chart of curves shows; drawn on the screen by `chart_screen.ts` and for files by `chart-paint.ts`. */

import type { Range } from "../protocol";

export interface Curve {
  /** "disk"; the legend adds the value under the cursor. */
  readonly label: string;
  readonly y: ArrayLike<number>;
  /** Standard errors: a band of twice this is drawn. */
  readonly error?: ArrayLike<number>;
  /** The name of a custom property of `colours.css`. */
  readonly colour: string;
  readonly dash?: readonly number[];
  readonly points?: boolean;
}

/** A vertical line with a word. */
export interface Line {
  readonly x: number;
  readonly error?: number;
  readonly label: string;
  readonly colour: string;
}

/** A point apart from the curves: a hollow circle or a cross. */
export interface Mark {
  readonly x: number;
  readonly y: number;
  readonly form: "circle" | "cross";
  readonly label: string;
  readonly colour: string;
}

export interface Chart {
  readonly title: string;
  /** Rich labels with units. */
  readonly xLabel: string;
  readonly yLabel: string;
  readonly x: ArrayLike<number>;
  readonly curves: readonly Curve[];
  readonly xRange: Range;
  readonly yRange: Range;
  /** The numbers beside the vertical axis have at least the place of this one: charts below each other are aligned. */
  readonly widest?: string;
  readonly lines?: readonly Line[];
  readonly marks?: readonly Mark[];
  /** A grey stretch of the x axis. */
  readonly shade?: { readonly range: Range; readonly label: string };
}
