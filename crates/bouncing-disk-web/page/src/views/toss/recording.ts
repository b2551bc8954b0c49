/** A motion that the library computed: states at equal times, and what happened in between. */

import { EVENT_COLUMNS, MODES, MOTION_COLUMNS } from "../../protocol";
import type { MotionJson, Response, SystemParameters } from "../../protocol";

const WIDTH = MOTION_COLUMNS.length;
const EVENT_WIDTH = EVENT_COLUMNS.length;
/** A sum of some doubles is rounded by so much of the largest of them. */
export const ROUNDING = 8 * Number.EPSILON;

export type Column = (typeof MOTION_COLUMNS)[number];
export type Moment = Record<Column, number> & { readonly mode: string };

export interface Impact {
  readonly time: number;
  /** Radians. */
  readonly phase: number;
  readonly normalised_speed: number;
}

export class Recording {
  readonly impacts: readonly Impact[];
  readonly duration: number;
  readonly energy: MotionJson["energy"];
  private readonly samples: Float64Array;
  private readonly modes: Uint8Array;
  private readonly count: number;
  private readonly extents = new Map<string, readonly [number, number]>();

  constructor(
    { json, numbers, bytes }: Response,
    readonly period: number,
    readonly periods: number,
    /** What moves. */
    readonly system: Readonly<SystemParameters>,
  ) {
    const told = json as MotionJson;
    this.count = told.samples;
    this.energy = told.energy;
    this.samples = numbers.subarray(0, told.samples * WIDTH);
    this.modes = bytes.subarray(0, told.samples);
    this.duration = this.value(told.samples - 1, 0);
    const events = numbers.subarray(told.samples * WIDTH);
    const impacts: Impact[] = [];
    for (let event = 0; event < told.events; event += 1) {
      const [time = NaN, phase = NaN, speed = NaN] = events.subarray(event * EVENT_WIDTH, event * EVENT_WIDTH + 3);
      if (!Number.isNaN(speed)) impacts.push({ time, phase, normalised_speed: speed });
    }
    this.impacts = impacts;
  }

  /** The state at a time, between two samples on the straight line between them. */
  at(time: number): Moment {
    const place = this.place(time);
    const low = Math.floor(place);
    const high = Math.min(low + 1, this.count - 1);
    const share = place - low;
    const moment: Record<string, number | string> = { mode: MODES[this.modes[low] ?? 0] ?? "flight" };
    MOTION_COLUMNS.forEach((name, column) => {
      moment[name] = this.value(low, column) * (1 - share) + this.value(high, column) * share;
    });
    return moment as unknown as Moment;
  }

  /** A column between two times, times first, in these units. */
  span(name: Column, from: number, to: number, factor: number): Float64Array {
    const [first, last] = this.rows(from, to);
    const column = MOTION_COLUMNS.indexOf(name);
    return Float64Array.from({ length: last - first + 1 }, (_, index) => this.value(first + index, column) * factor);
  }

  /** Least and greatest of some columns over all of it. */
  extent(...names: Column[]): [number, number] {
    const key = names.join();
    const known = this.extents.get(key) ?? this.findExtent(names);
    this.extents.set(key, known);
    return [known[0], known[1]];
  }

  private findExtent(names: readonly Column[]): readonly [number, number] {
    let low = Infinity;
    let high = -Infinity;
    for (const name of names) {
      const column = MOTION_COLUMNS.indexOf(name);
      for (let row = column; row < this.samples.length; row += WIDTH) {
        const value = this.samples[row] as number;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    return [low, high];
  }

  /** The number itself, or 0 where it is no more than what rounding leaves of the largest of these columns. */
  settled(value: number, ...names: Column[]): number {
    return Math.abs(value) <= ROUNDING * this.largest(names) ? 0 : value;
  }

  /** Impacts before this time. */
  impactsUntil(time: number): number {
    let low = 0;
    let high = this.impacts.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.impacts[middle] as Impact).time <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Row by row, with the mode last. */
  *table(): Iterable<(number | string)[]> {
    for (let row = 0; row < this.count; row += 1) {
      yield [...this.samples.subarray(row * WIDTH, (row + 1) * WIDTH), MODES[this.modes[row] ?? 0] ?? ""];
    }
  }

  private largest(names: readonly Column[]): number {
    const [low, high] = this.extent(...names);
    return Math.max(Math.abs(low), Math.abs(high));
  }

  private value(row: number, column: number): number {
    return this.samples[row * WIDTH + column] ?? 0;
  }

  /** The number of the sample at a time, with the share of the way to the next one. */
  private place(time: number): number {
    const step = this.duration / Math.max(this.count - 1, 1);
    return Math.min(Math.max(step > 0 ? time / step : 0, 0), this.count - 1);
  }

  private rows(from: number, to: number): [number, number] {
    return [Math.floor(this.place(from)), Math.ceil(this.place(to))];
  }
}
