/** Asks for attractors, and for the cells of a window: coarse ones first. */

import type { Context } from "../../contract";
import type { AttractorsJson } from "../../protocol";
import type { Grid } from "./cells";

/** A coarse cell stands for so many in both directions. */
const COARSE = 4;
const MOST_PHASES = 600;
const MOST_SPEEDS = 450;
/** Cells of one request: some ten milliseconds of the worker. */
const CELLS_AT_ONCE = 12_000;

export interface Wanted {
  readonly axial_forcing: number;
  readonly restitution: number;
}

export async function findAttractors(context: Context, wanted: Wanted): Promise<AttractorsJson> {
  let found: AttractorsJson | null = null;
  await context.client.series("basins-attractors", [{ call: "attractors", ...wanted }], ({ json }) => {
    found = json as AttractorsJson;
  });
  if (found === null) throw new Error("no answer came");
  return found;
}

/** The fine grid of a plot of so many device pixels, and the coarse one. */
export function gridsOf(
  window: Pick<Grid, "phase_periods" | "normalised_speed">,
  columns: number,
  rows: number,
): [Grid, Grid] {
  const phases = Math.max(Math.min(columns, MOST_PHASES), 2);
  const speeds = Math.max(Math.min(rows, MOST_SPEEDS), 2);
  const coarse = { phases: Math.ceil(phases / COARSE), speeds: Math.ceil(speeds / COARSE) };
  return [
    { ...window, ...coarse },
    { ...window, phases, speeds },
  ];
}

/** Gives the labels of rows of the grids, one grid after the other, to `take`. */
export async function computeCells(
  context: Context,
  wanted: Wanted,
  grids: readonly Grid[],
  take: (labels: Uint8Array, grid: number, from: number) => void,
): Promise<void> {
  const parts = grids.flatMap((grid, index) => {
    const step = Math.max(Math.floor(CELLS_AT_ONCE / grid.phases), 1);
    return Array.from({ length: Math.ceil(grid.speeds / step) }, (_, part) => ({
      grid: index,
      rows: [part * step, Math.min((part + 1) * step, grid.speeds)] as [number, number],
    }));
  });
  const requests = parts.map(({ grid, rows }) => ({
    call: "basins" as const,
    ...wanted,
    ...(grids[grid] as Grid),
    rows,
  }));
  await context.client.series("basins", requests, ({ bytes }, index) => {
    const part = parts[index];
    if (part !== undefined) take(bytes, part.grid, part.rows[0]);
  });
}
