/** What a scan computes: the requests of its points, and the numbers in the answers. */

import { Refused, type Change, type Context, type ResultName, type State } from "../../contract";
import type { Request, Response, RowJson, SheetJson } from "../../protocol";
import type { AttractorsJson, TossJson, VerdictJson } from "../../protocol";
import { say, WORDS } from "../../words";
import { REST } from "../../presets";
import { impactOf } from "../asking";
import { rowOf, SEED, sheetRequest } from "../motor/requests";

type Answer = Response<unknown>;

/** A number with its standard error or its interval of 95 %; or why there is none. */
export interface Reading {
  readonly value: number;
  readonly error?: number;
  readonly between?: readonly [low: number, high: number];
  /** Why it is not to be relied on, or missing. */
  readonly lacks?: string;
  /** Whether a disk at rest is thrown onto another attractor, which has all starts of both. */
  readonly moved?: boolean;
}

const missing = (lacks: string): Reading => ({ value: NaN, lacks });

interface Result {
  request(state: State): Request;
  /** The request that counts, where the first one prepares it. */
  then?(answer: Answer): Request;
  /** The view that shows a point, and what it needs besides the point's state. */
  readonly opens: Change;
  readonly unit: string;
  read(answer: Answer): Reading;
}

/** Steady speeds have this relative error, or the one that so many impacts leave: a second or so for each point. */
const OPERATION = { relative_error: 0.02, most_impacts: 4_000_000, seed: SEED } as const;

const ofToss = (unit: string, name: keyof TossJson): Result => ({
  unit,
  opens: { view: "toss", start: REST },
  request: ({ system }) => ({ call: "toss", system }),
  read({ json }) {
    const value = (json as TossJson)[name];
    return value === null ? missing(WORDS.scan.noTwist) : { value };
  },
});

const ofOrbit = (read: (verdict: VerdictJson) => Reading | null): Result => ({
  unit: "",
  opens: { view: "diagram" },
  request: (state) => ({ call: "orbit", map: state.system, start: impactOf(state) }),
  read({ json }) {
    const verdict = json as VerdictJson;
    return read(verdict) ?? missing(say(WORDS.scan.orbitIs, { kind: WORDS.scan.kinds[verdict.kind] }));
  },
});

const ofShare = (kind: keyof AttractorsJson["kinds"]): Result => ({
  unit: "",
  opens: { view: "basins" },
  request: ({ system }) => ({ call: "attractors", map: system }),
  read({ json }) {
    const { kinds, attractors } = json as AttractorsJson;
    const { value, low, high } = kinds[kind];
    return { value, between: [low, high], moved: attractors.some(({ leads_to }) => leads_to !== null) };
  },
});

const ofMotor = (unit: string, name: "speed" | "mechanical_power" | "efficiency"): Result => ({
  unit,
  opens: { view: "motor" },
  request: sheetRequest,
  then: ({ json }) => {
    const { sheet } = json as SheetJson;
    return { call: "motor_loads", sheet, load_torques: [sheet.load_torque], ...OPERATION };
  },
  read({ json }) {
    const [row = { branches: [] }] = json as RowJson[];
    const { [name]: value, [`${name}_error` as const]: error, shortfall: lacks } = rowOf(row, NaN);
    return { value, error, ...(lacks !== null && { lacks }) };
  },
});

export const RESULT: Readonly<Record<ResultName, Result>> = {
  toss_speed: ofToss("rad/s", "airborne_speed"),
  toss_efficiency: ofToss("", "efficiency"),
  toss_ratio: ofToss("", "speed_ratio"),
  orbit_exponent: ofOrbit(({ kind, exponent: value, exponent_error: error }) =>
    value === null || kind === "undecided" ? null : error === null ? { value } : { value, error },
  ),
  orbit_period: ofOrbit(({ kind, impacts }) => (kind === "periodic" && impacts !== null ? { value: impacts } : null)),
  share_periodic: ofShare("periodic"),
  share_chaotic: ofShare("chaotic"),
  share_rest: ofShare("rest"),
  motor_speed: ofMotor("rad/s", "speed"),
  motor_power: ofMotor("W", "mechanical_power"),
  motor_efficiency: ofMotor("", "efficiency"),
};

/** The answer of a point, or the sentence with which the library refuses it. */
export type Outcome = Answer | string;

/** Answers for these states, one by one, each with its number. */
export async function compute(
  context: Context,
  { request, then }: Result,
  states: readonly State[],
  take: (outcome: Outcome, index: number) => void,
): Promise<void> {
  const first = states.map((state) => request(state));
  if (then === undefined) return askEach(context, first, take);
  const prepared: [Request, number][] = [];
  await askEach(context, first, (outcome, index) => {
    if (typeof outcome === "string") take(outcome, index);
    else prepared.push([then(outcome), index]);
  });
  const second = prepared.map(([wanted]) => wanted);
  return askEach(context, second, (outcome, place) => take(outcome, prepared[place]?.[1] ?? NaN));
}

/** A refused request ends a series; the one that follows begins behind it. */
async function askEach(
  { client }: Context,
  requests: readonly Request[],
  take: (outcome: Outcome, index: number) => void,
): Promise<void> {
  let next = 0;
  while (next < requests.length) {
    try {
      await client.series("scan", requests.slice(next), (answer) => take(answer, next++));
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      take(error.refusal.message, next++);
    }
  }
}
