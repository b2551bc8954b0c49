/** What is drawn over the forcing, and the columns of a window. */

import type { Context, Drive, Quantity } from "../../contract";
import { rounded, rowsOf } from "../../drawing/files";
import { DIAGRAM_COLUMNS, type DiagramJson, type ImpactStart, type Range, type Request, type SystemParameters } from "../../protocol";
import { WORDS } from "../../words";

export interface Described {
  /** With markup and unit. */
  readonly label: string;
  /** A number as wide as those of usual ranges: the plot's width, and with it the columns, must not depend on these. */
  readonly widest: string;
  /** How wide a window may be, and between which values it lies. */
  readonly widths: Range;
  readonly bounds: Range;
}

/** In the order in which they are offered. */
export const DESCRIBED: Readonly<Record<Quantity, Described>> = {
  impact_phase: { label: WORDS.axes.phase, widest: "0.0", widths: [1e-9, 1], bounds: [-1, 2] },
  normalised_speed: { label: WORDS.axes.speed, widest: "00.0", widths: [1e-9, 1000], bounds: [0, 1000] },
  angular_speed: { label: WORDS.axes.spin, widest: "−00.0", widths: [1e-9, 100], bounds: [-100, 100] },
};

/** Where the quantity is in a row of `DIAGRAM_COLUMNS` and, but for the last one, of `BRANCH_COLUMNS`. */
export const columnOf = (quantity: Quantity): number => 1 + Object.keys(DESCRIBED).indexOf(quantity);

/** The value of the axis: phases in periods, of which that in `[low, low + 1)` is taken. */
export function axisValue(quantity: Quantity, value: number, low: number): number {
  if (quantity !== "impact_phase") return value;
  const periods = value / (2 * Math.PI);
  return periods - Math.floor(periods - low);
}

export type Columns = Readonly<{ numbers: Float64Array; from: number; to: number }>;

export interface Wanted {
  readonly system: SystemParameters;
  readonly start: ImpactStart;
  readonly axial_forcing: Range;
  readonly count: number;
  readonly rotation: boolean;
  readonly drive: Drive;
}

/** A shape as the library has it: the sawtooth rises for a quarter of the period. */
const shapeOf = (drive: Drive) => (drive === "sawtooth" ? { sawtooth: 0.25 } : drive);

export const TRANSIENT = 300;
export const RECORDED = 200;
/** An orbit that has not settled is followed for so many impacts; near a doubling it would take any number. */
export const LENGTHS = { transient: TRANSIENT, recorded: RECORDED, patience: 3000 };
/** Columns of a request: some 10 ms of work, so that one that is not wanted any more is soon over; their way between the
 * workers takes longer than 32 columns of the vertical motion. */
const CHUNK = { vertical: 256, rotation: 64 };

/** Gives each answer to `take`; what there is to tell of the orbits when all are there. */
export async function computeColumns(
  { client }: Context,
  wanted: Wanted,
  take: (columns: Columns) => void,
): Promise<DiagramJson> {
  const { count, rotation, drive } = wanted;
  const chunk = rotation ? CHUNK.rotation : CHUNK.vertical;
  const parts = Array.from({ length: Math.ceil(count / chunk) }, (_, part): [number, number] => {
    return [part * chunk, Math.min((part + 1) * chunk, count)];
  });
  const requests = parts.map((columns): Request => {
    return { call: "diagram", ...wanted, drive: shapeOf(drive), columns, ...LENGTHS };
  });
  let told: DiagramJson = { resting: 0, unsettled: 0, left_out: TRANSIENT };
  await client.series<DiagramJson>("diagram", requests, ({ json, numbers }, index) => {
    const { resting, unsettled, left_out } = told;
    told = {
      resting: resting + json.resting,
      unsettled: unsettled + json.unsettled,
      left_out: Math.max(left_out, json.left_out),
    };
    const [from, to] = parts[index] as [number, number];
    take({ numbers, from, to });
  });
  return told;
}

/** The impacts of each forcing, those that are equal when rounded in one row with their number: most orbits repeat few. */
export function* distinctImpacts(columns: readonly Columns[], step: number): Iterable<number[]> {
  const found = new Map<string, number[]>();
  let forcing = NaN;
  for (const { numbers } of columns) {
    for (const [present = NaN, ...impact] of rowsOf(numbers, DIAGRAM_COLUMNS.length)) {
      if (present !== forcing) {
        yield* found.values();
        found.clear();
        forcing = present;
      }
      const row = impact.map((value) => rounded(value, step));
      const known = found.get(row.join());
      if (known === undefined) found.set(row.join(), [forcing, ...row, 1]);
      else known.push((known.pop() ?? 0) + 1);
    }
  }
  yield* found.values();
}
