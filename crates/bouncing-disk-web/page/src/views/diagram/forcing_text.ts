/** Forcings with as many digits as tell those of a window apart. */

import { minus } from "../../drawing/numbers";
import type { Range } from "../../protocol";

/** Four decimals, or three more than the width of the window has zeros. */
export function forcingText(value: number, [low, high]: Range): string {
  const needed = 3 - Math.floor(Math.log10(high - low) + 1);
  return minus(value.toFixed(Math.min(Math.max(4, needed), 17)));
}

/** The end of a window, without zeros that say nothing. */
export function endText(value: number, window: Range): string {
  return forcingText(value, window).replace(/\.?0+$/, "");
}
