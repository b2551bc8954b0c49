/** What the motor's view asks for, in the order in which it matters to a reader. */

import type { Context, State } from "../../contract";
import { plain } from "../../numbers";
import type { AxialMotionJson, MotorSheet, OperationJson, ReportJson, Request } from "../../protocol";
import type { RowJson, SheetJson, StallJson, TransientJson } from "../../protocol";
import { say, WORDS } from "../../words";

/** Of all that is asked of a motor, one after the other. */
export const SLOT = "motor";
/** The seed of all random numbers, so that everybody gets the same ones. */
export const SEED = 1;
/** Motors of a run-up: fewer where contacts take time or the stator yields, which takes longer and differs less. */
export const membersOf = (sheet: MotorSheet | null): number =>
  sheet?.contact?.time === undefined && !sheet?.stator ? 16 : 5;
const TRANSIENT_POINTS = 160;
/** The curve is there soon, roughly, and then sharpens: a motor that settles late takes more impacts. */
export const PASSES = [
  { relative_error: 0.1, most_impacts: 5_000_000 },
  { relative_error: 0.02, most_impacts: 20_000_000 },
] as const;
export type Pass = (typeof PASSES)[number];
const STALL_ERROR = 0.02;
const LACKING: Readonly<Record<string, string>> = WORDS.motor.lacking;

/** What is known of a load with its error. */
export const ESTIMATES = ["speed", "mechanical_power", "input_power", "efficiency"] as const;
export type Estimated = (typeof ESTIMATES)[number];

/** One load; its status is 0 (steady), 1 (unsettled) or 2 (runaway). */
export type Operation = Record<"load_torque" | "status" | Estimated | `${Estimated}_error`, number> & {
  readonly shortfall: string | null;
  readonly motion: AxialMotionJson | null;
  /** Of a stator that yields (m). */
  readonly amplitude: number | null;
  /** The relative error that was asked for. */
  readonly wanted: number;
};

/** The operation that most rotors reach from rest, and those that coexist with it. */
export type Row = Operation & { readonly others: readonly Operation[] };

export interface Transient {
  readonly json: TransientJson;
  readonly numbers: Float64Array;
}

/** What is known of a motor so far. */
export class Known {
  sheet: MotorSheet | null = null;
  text = "";
  report: ReportJson | null = null;
  transient: Transient | null = null;
  operations: readonly Row[] = [];
  /** The operation under the load of the sheet. */
  own: Row | null = null;
  /** How many of the passes are done: what a view that was left has, it does not compute again. */
  passes = 0;
  /** Why there is none of these, where they cannot be computed. */
  problems: { runUp?: string; curve?: string; stall?: string } = {};
  stall: StallJson | null = null;
}

/** Asks for the sheet of the motor of a state. */
export const sheetRequest = ({ system, mass, motor: { stator } }: State): Request =>
  ({ call: "sheet_of_system", system, mass, stator });

export const sheetOf = async ({ client }: Context, state: State): Promise<SheetJson> =>
  (await client.ask<SheetJson>(SLOT, sheetRequest(state))).json;

export async function reportOf({ client }: Context, sheet: MotorSheet): Promise<ReportJson> {
  return (await client.series<ReportJson>(SLOT, [{ call: "motor_report", sheet }])).json;
}

export function transientOf({ client }: Context, sheet: MotorSheet, rise_times: number): Promise<Transient> {
  const request = { sheet, members: membersOf(sheet), rise_times, points: TRANSIENT_POINTS, seed: SEED };
  return client.series<TransientJson>(SLOT, [{ call: "motor_transient", ...request }]);
}

/** All loads on one vertical motion: points of a curve that share their impacts are told apart best, and cost little
 * more than one of them. */
export async function operate(
  { client }: Context,
  sheet: MotorSheet,
  load_torques: readonly number[],
  pass: Pass,
): Promise<Row[]> {
  const request = { call: "motor_loads", sheet, load_torques, ...pass, seed: SEED } as const;
  const { json } = await client.series<RowJson[]>(SLOT, [request]);
  return json.map((row) => rowOf(row, pass.relative_error));
}

/** A load has one branch at least. */
export function rowOf({ branches }: RowJson, wanted: number): Row {
  const [first = {}, ...others] = branches;
  return { ...operationOf(first, wanted), others: others.map((other) => operationOf(other, wanted)) };
}

/** Without a number where the library has none. */
function operationOf({ Steady, Unsettled, Runaway }: OperationJson, wanted: number): Operation {
  const point = Steady ?? Unsettled?.[0];
  const estimates = ESTIMATES.flatMap((name) => {
    const { value, standard_error } = point?.[name] ?? { value: NaN, standard_error: NaN };
    return [[name, value], [`${name}_error`, standard_error]];
  });
  const lacks = Unsettled?.[1] ?? (Runaway && { Runaway });
  return {
    load_torque: (point ?? Runaway)?.load_torque,
    ...Object.fromEntries(estimates),
    status: Steady ? 0 : Unsettled ? 1 : 2,
    shortfall: lacks === undefined ? null : shortfallOf(lacks),
    motion: point?.motion ?? null,
    amplitude: point?.stator?.amplitude.value ?? null,
    wanted,
  } as Operation;
}

/** What a motor lacks. */
function shortfallOf(reason: Readonly<Record<string, Readonly<Record<string, number>>>>): string {
  const [name, numbers] = Object.entries(reason)[0] ?? ["", {}];
  const values = Object.entries(numbers).map(([key, number]) => [key, plain(number, 3)]);
  return say(LACKING[name] ?? name, Object.fromEntries(values) as Record<string, string>);
}

export async function stallOf({ client }: Context, sheet: MotorSheet): Promise<StallJson> {
  const request = { call: "motor_stall", sheet, relative_error: STALL_ERROR, seed: SEED } as const;
  return (await client.series<StallJson>(SLOT, [request])).json;
}
