/** Asks for the columns of a window: every eighth first, then all. */

import type { Context } from "../../contract";
import type { ImpactStart, Range, Request, SystemParameters } from "../../protocol";
import { COARSE } from "./orbit_picture";

export interface Columns {
  readonly numbers: Float64Array;
  readonly from: number;
  readonly to: number;
  readonly coarse: boolean;
}

export interface Wanted {
  readonly system: SystemParameters;
  readonly start: ImpactStart;
  readonly axial_forcing: Range;
  readonly count: number;
  readonly rotation: boolean;
}

export const TRANSIENT = 300;
export const RECORDED = 200;
const CHUNK = 32;

/** Gives each answer to `take`; the number of orbits at rest when all are there. */
export async function computeColumns(
  context: Context,
  wanted: Wanted,
  take: (columns: Columns) => void,
): Promise<number> {
  const places: Omit<Columns, "numbers">[] = [];
  const requests: Request[] = [];
  const add = (count: number, coarse: boolean) => {
    for (let from = 0; from < count; from += CHUNK) {
      const to = Math.min(from + CHUNK, count);
      places.push({ from, to, coarse });
      requests.push({
        call: "diagram",
        ...wanted,
        count,
        columns: [from, to],
        transient: TRANSIENT,
        recorded: RECORDED,
      });
    }
  };
  add(Math.ceil(wanted.count / COARSE), true);
  add(wanted.count, false);
  let resting = 0;
  await context.client.series("diagram", requests, (response, index) => {
    const place = places[index];
    if (place === undefined) return;
    if (!place.coarse) resting += (response.json as { resting: number }).resting;
    take({ ...place, numbers: response.numbers });
  });
  return resting;
}
