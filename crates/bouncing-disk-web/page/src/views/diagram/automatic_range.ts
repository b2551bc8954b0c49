/** The range of the axis that nobody chose: that of the dots. */

import type { Quantity } from "../../contract";
import { extent, padded } from "../../drawing/scale";
import type { Range } from "../../protocol";
import { DIAGRAM_COLUMNS } from "../../protocol";
import type { Columns } from "./computation";
import { columnOf } from "./quantity";

/** The axis where there is nothing to see: of spins, between those that the platform has. */
const nothing = (quantity: Quantity): Range => (quantity === "angular_speed" ? [-1, 1] : [0, 1]);
/** A range that is narrower than this would show rounding. */
const NARROWEST = 1e-9;

export class AutomaticRange {
  private range: Range = [0, 1];

  get value(): Range {
    return this.range;
  }

  /** While dots come: only as often as it has to, for each change draws all of them anew. */
  follow(columns: readonly Columns[], quantity: Quantity): void {
    const wanted = rangeOf(columns, quantity);
    if (wanted === null) return;
    const [low, high] = this.range;
    const wider = wanted[0] < low || wanted[1] > high;
    const finer = wanted[1] - wanted[0] < 0.7 * (high - low);
    if (wider || finer) this.range = wanted;
  }

  /** When all dots are there: what they ask for, whatever was seen before. */
  settle(columns: readonly Columns[], quantity: Quantity): void {
    this.range = rangeOf(columns, quantity) ?? nothing(quantity);
  }
}

function rangeOf(columns: readonly Columns[], quantity: Quantity): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (const { numbers } of columns) {
    const part = extent(numbers, columnOf(quantity), DIAGRAM_COLUMNS.length);
    if (part === null) continue;
    low = Math.min(low, part[0]);
    high = Math.max(high, part[1]);
  }
  if (!(low <= high)) return null;
  if (high - low < NARROWEST) [low, high] = [low - NARROWEST, high + NARROWEST];
  // An impact speed is none below zero.
  return quantity === "normalised_speed" ? [0, padded([0, high])[1]] : padded([low, high]);
}
