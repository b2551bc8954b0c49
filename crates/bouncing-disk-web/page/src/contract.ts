/** What the parts of the page have in common: the state that a link reproduces, and what a view is. */

import type { WORDS } from "./words";
import type { FlightStart, ImpactStart, Range, Refusal, Request, Response, Stator, Summary, SystemParameters } from "./protocol";

/** In the order of their tabs. */
export const VIEW_NAMES = ["toss", "diagram", "basins", "motor", "compare", "scan"] as const;
export type ViewName = (typeof VIEW_NAMES)[number];

/** What is chosen among the texts of `words.json`, in their order: quantity and platform of the orbit diagram... */
export type Quantity = keyof typeof WORDS.diagram.quantities;
export type Drive = keyof typeof WORDS.diagram.drives;
/** ... and what a scan computes at each of its points. */
export type ResultName = keyof typeof WORDS.scan.results;

/**
 * All that the pictures depend on. It is never altered: a change makes another one. In the hash of the address numbers stand
 * as JavaScript prints them, which gives the same bits back.
 */
export interface State {
  readonly view: ViewName;
  readonly system: Readonly<SystemParameters>;
  /** What follows from the system; null until the library has said it. */
  readonly summary: Summary | null;
  /** Mass of the disk (kg), which only the motor's torques and powers depend on. */
  readonly mass: number;
  /** How the motion of the first view and the orbits of the others begin. */
  readonly start: Readonly<ImpactStart & { angular_speed: number }>;
  /** How the motion of the first view begins where the disk was thrown; another start takes its place. */
  readonly thrown: Readonly<FlightStart> | null;
  /** The window of the orbit diagram: the forcing, and the quantity with the range of its axis (null: all of it). */
  readonly diagram: Readonly<
    { axial_forcing: Range; quantity: Quantity; range: Range | null; branches: boolean; drive: Drive }
  >; // prettier-ignore
  /** The window of the basins: phases in periods and normalised speeds. */
  readonly basins: Readonly<{ phase_periods: Range; normalised_speed: Range }>;
  /** The length of a motor's run-up, in rise times, and its stator, where that yields. */
  readonly motor: Readonly<{ rise_times: number; stator: Stator | null }>;
  /** What state B has instead of the shared state A; how many periods both are followed, and from which one on they
   * are shown (null: where they part). */
  readonly compare: Readonly<{ parameter: string; value: number; periods: number; from: number | null }>;
  /** A result at points of a range of one parameter, for some values of a second one (null: none). */
  readonly scan: Readonly<
    { over: string; range: Range; points: number; result: ResultName; family: string | null;
      values: readonly number[] }
  >; // prettier-ignore
}

export type Change = { [Key in keyof Omit<State, "summary">]?: State[Key] extends object ? Partial<State[Key]> : State[Key] };

/** A request that a later one with the same slot has replaced, or whose view is hidden. */
export class Cancelled extends Error {}

/** A request that the library refuses. */
export class Refused extends Error {
  constructor(readonly refusal: Refusal) {
    super(refusal.message);
  }
}

export const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

/** Where answers come from. Nothing here blocks the page. */
export interface Client {
  /** An answer from the quick worker: `check`, `motion`, `orbit` and sheets. A later one of the slot cancels it. */
  ask<Json>(slot: string, request: Request): Promise<Response<Json>>;
  /**
   * Answers from the heavy worker, one after the other, as they come; the last one in the end. A later series of the
   * same slot, or `cancel`, ends it within 100 ms: what is under way is given up with the worker.
   */
  series<Json>(
    slot: string,
    requests: readonly Request[],
    each?: (response: Response<Json>, index: number) => void,
  ): Promise<Response<Json>>;
  cancel(slot: string): void;
}

/** A file that a view offers. SVG and PNG are drawn anew, at the size of a journal's column. */
export interface Offer {
  /** "orbit diagram" makes `orbit-diagram.csv`. */
  name: string;
  kind: "csv" | "json" | "svg" | "png";
  make(): Promise<Blob>;
}

export interface Context {
  readonly client: Client;
  state(): State;
  /** Another state: the page, the address and all views follow. `settled: false` while a drag or a wheel goes on, when
   * the address is replaced and no entry of the history made. */
  change(change: Change, options?: { settled?: boolean; taken?: () => void }): void;
  /** One line under the view, which screen readers say, politely; with errors of computations. */
  status(text: string, kind?: "busy" | "done" | "error"): void;
}

export interface View {
  /** Draws what this state asks for, as soon as it is known; a `fresh` one comes from a lesson or a figure. */
  show(state: State, fresh: boolean): void;
  /** Stops animations and cancels what is under way. */
  hide(): void;
  /** The size of the host or the theme has changed. */
  redraw(): void;
  offers(): Offer[];
}

/** Puts a view into its place, once. */
export type ViewClass = new (host: HTMLElement, context: Context) => View;
