/** Asks for the columns of a window: where they take long, every eighth first, then all. */

import type { Context } from "../../contract";
import type { DiagramJson, ImpactStart, Range, Request, SystemParameters } from "../../protocol";
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
/** An orbit that has not settled is followed for so many impacts; near a doubling it would take any number. */
export const PATIENCE = 3000;
/** Columns of a request: some 10 ms of work, so that one that is not wanted any more is soon over; their way between the
 * workers takes longer than 32 columns of the vertical motion. */
const CHUNK = { vertical: 256, rotation: 64 };

/** What is known of all orbits of the diagram. */
export interface Told {
  resting: number;
  unsettled: number;
  /** Most impacts that were left out of an orbit. */
  leftOut: number;
}

/** Gives each answer to `take`; what there is to tell of the orbits when all are there. */
export async function computeColumns(
  context: Context,
  wanted: Wanted,
  take: (columns: Columns) => void,
): Promise<Told> {
  const places: Omit<Columns, "numbers">[] = [];
  const requests: Request[] = [];
  const chunk = wanted.rotation ? CHUNK.rotation : CHUNK.vertical;
  const add = (count: number, coarse: boolean) => {
    for (let from = 0; from < count; from += chunk) {
      const to = Math.min(from + chunk, count);
      places.push({ from, to, coarse });
      requests.push({
        call: "diagram",
        ...wanted,
        count,
        columns: [from, to],
        transient: TRANSIENT,
        recorded: RECORDED,
        patience: coarse ? TRANSIENT : PATIENCE,
      });
    }
  };
  // The vertical motion of all columns is there before a coarse picture of it could be looked at.
  if (wanted.rotation) add(Math.ceil(wanted.count / COARSE), true);
  add(wanted.count, false);
  const told: Told = { resting: 0, unsettled: 0, leftOut: TRANSIENT };
  await context.client.series("diagram", requests, (response, index) => {
    const place = places[index];
    if (place === undefined) return;
    if (!place.coarse) {
      const { resting, unsettled, left_out } = response.json as DiagramJson;
      told.resting += resting;
      told.unsettled += unsettled;
      told.leftOut = Math.max(told.leftOut, left_out);
    }
    take({ ...place, numbers: response.numbers });
  });
  return told;
}
