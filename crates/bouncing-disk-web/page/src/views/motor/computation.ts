/** What the motor's view asks for, in the order in which it matters to a reader. */

import type { Context, State } from "../../contract";
import { OPERATION_COLUMNS } from "../../protocol";
import type { MotorSheet, OperationsJson, ReportJson, Request, Response, StallJson, TransientJson } from "../../protocol";

/** The seed of all random numbers, so that everybody gets the same ones. */
export const SEED = 1;
export const MEMBERS = 16;
const TRANSIENT_POINTS = 160;
/** The curve is there soon, roughly, and then sharpens: a motor that settles late takes more impacts. */
export const PASSES = [
  { relative_error: 0.1, most_impacts: 5_000_000 },
  { relative_error: 0.02, most_impacts: 20_000_000 },
] as const;
export type Pass = (typeof PASSES)[number];
const STALL_ERROR = 0.02;

const WIDTH = OPERATION_COLUMNS.length;

/** One load: a row by the names of `OPERATION_COLUMNS`. */
export type Operation = Record<(typeof OPERATION_COLUMNS)[number], number> & {
  readonly shortfall: string | null;
  /** The relative error that was asked for. */
  readonly wanted: number;
};

export interface Transient {
  readonly json: TransientJson;
  readonly numbers: Float64Array;
}

/** The sheet of the shared system. */
export async function sheetOf(context: Context, state: State): Promise<MotorSheet> {
  const request = { call: "sheet_of_system", system: { ...state.system }, mass: state.mass } as const;
  const { json } = await context.client.ask("motor-sheet", request);
  return (json as { sheet: MotorSheet }).sheet;
}

export async function reportOf(context: Context, sheet: MotorSheet): Promise<ReportJson> {
  const response = await one(context, "motor-report", { call: "motor_report", sheet });
  return response.json as ReportJson;
}

export async function transientOf(context: Context, sheet: MotorSheet, rise_times: number): Promise<Transient> {
  const points = TRANSIENT_POINTS;
  const request = { call: "motor_transient", sheet, members: MEMBERS, rise_times, points, seed: SEED } as const;
  const { json, numbers } = await one(context, "motor-transient", request);
  return { json: json as TransientJson, numbers };
}

/** All loads on one vertical motion: points of a curve that share their impacts are told apart best, and cost little
 * more than one of them. */
export async function operate(
  context: Context,
  sheet: MotorSheet,
  load_torques: readonly number[],
  pass: Pass,
): Promise<Operation[]> {
  const request: Request = { call: "motor_loads", sheet, load_torques: [...load_torques], ...pass, seed: SEED };
  const { json, numbers } = await one(context, "motor-loads", request);
  return load_torques.map((_, row) => {
    const operation: Record<string, number | string | null> = { wanted: pass.relative_error };
    OPERATION_COLUMNS.forEach((name, column) => {
      operation[name] = numbers[row * WIDTH + column] ?? NaN;
    });
    operation["shortfall"] = (json as OperationsJson).shortfalls[row] ?? null;
    return operation as unknown as Operation;
  });
}

export async function stallOf(context: Context, sheet: MotorSheet): Promise<StallJson> {
  const request = { call: "motor_stall", sheet, relative_error: STALL_ERROR, seed: SEED } as const;
  return (await one(context, "motor-stall", request)).json as StallJson;
}

async function one(
  context: Context,
  slot: string,
  request: Request,
): Promise<Response> {
  let answer: Response | null = null;
  await context.client.series(slot, [request], (response) => {
    answer = response;
  });
  if (answer === null) throw new Error("no answer came");
  return answer;
}
