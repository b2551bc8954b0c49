/** What is drawn over the forcing, and between which values. */

import type { Quantity } from "../../contract";
import type { Range } from "../../protocol";

export const QUANTITIES: readonly Quantity[] = ["impact_phase", "normalised_speed", "angular_speed"];

export interface Described {
  readonly name: string;
  /** With markup and unit. */
  readonly label: string;
  readonly unit: string;
  /** A number as wide as those of usual ranges: the plot's width, and with it the columns, must not depend on these. */
  readonly widest: string;
  /** How wide a window may be, and between which values it lies. */
  readonly widths: Range;
  readonly bounds: Range;
}

export const DESCRIBED: Readonly<Record<Quantity, Described>> = {
  impact_phase: {
    name: "phase of impact",
    label: "phase of impact *τ*_{imp}/2π (periods)",
    unit: "periods",
    widest: "0.0",
    widths: [1e-9, 1],
    bounds: [-1, 2],
  },
  normalised_speed: {
    name: "normalised impact speed",
    label: "normalised impact speed |*w*_{A}Γ/(*ωA*)|",
    unit: "",
    widest: "00.0",
    widths: [1e-9, 1000],
    bounds: [0, 1000],
  },
  angular_speed: {
    name: "angular speed after the impact",
    label: "angular speed after the impact / *ω*Φ",
    unit: "ωΦ",
    widest: "\u221200.0",
    widths: [1e-9, 100],
    bounds: [-100, 100],
  },
};

const COLUMN: Readonly<Record<Quantity, number>> = { impact_phase: 1, normalised_speed: 2, angular_speed: 3 };

/** Where the quantity is in a row of `DIAGRAM_COLUMNS` and, but for the last one, of `BRANCH_COLUMNS`. */
export function columnOf(quantity: Quantity): number {
  return COLUMN[quantity];
}

/** The value of the axis: phases in periods, of which that in `[low, low + 1)` is taken. */
export function axisValue(quantity: Quantity, value: number, low: number): number {
  if (quantity !== "impact_phase") return value;
  const periods = value / (2 * Math.PI);
  return periods - Math.floor(periods - low);
}
