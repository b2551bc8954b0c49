/** A motion that the library computed: states at equal times, and what happened in between; and its charts. */

import { extent, padded, prefixed, type Axis } from "../../drawing/axes";
import type { Chart, Curve } from "../../drawing/chart";
import { rowsOf } from "../../drawing/files";
import { EVENT_COLUMNS, MODES, MOTION_COLUMNS } from "../../protocol";
import type { MotionJson, Range, Response, SystemParameters } from "../../protocol";
import { WORDS } from "../../words";

const WIDTH = MOTION_COLUMNS.length;
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
  readonly energy: MotionJson["energy"];
  private readonly duration: number;
  private readonly samples: Float64Array;
  private readonly modes: Uint8Array;
  private readonly count: number;
  private readonly extents = new Map<string, Range>();

  constructor(
    { json, numbers, bytes }: Response<MotionJson>,
    readonly periods: number,
    readonly system: Readonly<SystemParameters>,
  ) {
    this.count = json.samples;
    this.energy = json.energy;
    this.samples = numbers.subarray(0, json.samples * WIDTH);
    this.modes = bytes.subarray(0, json.samples);
    this.duration = this.value(json.samples - 1, 0);
    const events = [...rowsOf(numbers.subarray(json.samples * WIDTH), EVENT_COLUMNS.length)];
    this.impacts = events.flatMap(([time = NaN, phase = NaN, normalised_speed = NaN]) =>
      Number.isNaN(normalised_speed) ? [] : [{ time, phase, normalised_speed }],
    );
  }

  /** Of the platform, in seconds. */
  get period(): number {
    return (2 * Math.PI) / this.system.angular_frequency;
  }

  /** The state at a time, between two samples on the straight line between them. */
  at(time: number): Moment {
    const place = this.place(time);
    const low = Math.floor(place);
    const high = Math.min(low + 1, this.count - 1);
    const share = place - low;
    const between = (column: number) => this.value(low, column) * (1 - share) + this.value(high, column) * share;
    const columns = MOTION_COLUMNS.map((name, column) => [name, between(column)]);
    return { ...Object.fromEntries(columns), mode: this.mode(low) } as Moment;
  }

  /** A column between two times; a time that is a sample's but for rounding is that sample. */
  span(name: Column, from: number, to: number): Float64Array {
    const [first, last] = [Math.floor(this.place(from) + 1e-6), Math.ceil(this.place(to) - 1e-6)];
    const column = MOTION_COLUMNS.indexOf(name);
    return Float64Array.from({ length: last - first + 1 }, (_, index) => this.value(first + index, column));
  }

  /** Least and greatest of some columns over all of it. */
  extent(...names: Column[]): Range {
    const key = names.join();
    const found = (name: Column) => extent(this.samples, MOTION_COLUMNS.indexOf(name), WIDTH) ?? [];
    const range = this.extents.get(key) ?? extent(names.flatMap(found)) ?? [0, 0];
    this.extents.set(key, range);
    return range;
  }

  /** The number itself, or 0 where it is no more than what rounding leaves of the largest of these columns. */
  settled(value: number, ...names: Column[]): number {
    const largest = Math.max(...this.extent(...names).map(Math.abs));
    return Math.abs(value) <= ROUNDING * largest ? 0 : value;
  }

  impactsUntil(time: number): number {
    let [low, high] = [0, this.impacts.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.impacts[middle] as Impact).time <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Row by row, with the mode last. */
  *table(): Iterable<(number | string)[]> {
    for (let row = 0; row < this.count; row += 1)
      yield [...this.samples.subarray(row * WIDTH, (row + 1) * WIDTH), this.mode(row)];
  }

  private mode(row: number): string {
    return MODES[this.modes[row] ?? 0] ?? MODES[0];
  }

  private value(row: number, column: number): number {
    return this.samples[row * WIDTH + column] ?? 0;
  }

  /** The number of the sample at a time, with the share of the way to the next one. */
  private place(time: number): number {
    const step = this.duration / Math.max(this.count - 1, 1);
    return Math.min(Math.max(step > 0 ? time / step : 0, 0), this.count - 1);
  }
}

const TEXTS = WORDS.toss;

/** A number as wide as those of usual ranges, so that charts above each other have one axis of time. */
export const WIDEST = "−00.00";

/** A motion with the names of its curves; a platform without one is that of the motion before. */
export type Named = Readonly<{ motion: Recording; disk: string; platform: string | null }>;

/** Heights and angular speeds of motions that were sampled alike, over periods and up to one of them. */
export function traces(named: readonly [Named, ...Named[]], range: Range, end: number): [Chart, Chart] {
  const spanOf = (motion: Recording, name: Column) => motion.span(name, range[0] * motion.period, end * motion.period);
  const { motion: first } = named[0];
  const at = spanOf(first, "time").map((time) => time / first.period);
  const chart = (title: string, axisOf: (range: Range) => Axis, own: Column, below: Column): Chart => {
    const curves = named.flatMap(({ motion, disk, platform }, index): Curve[] => {
      const colour = index + 1 < named.length ? "--picture-muted" : "--platform-line";
      const lower = { y: spanOf(motion, below), colour, dash: [6, 3] };
      const style = index === 0 ? { colour: "--disk" } : { colour: "--curve-power", dash: [7, 3] };
      const upper = { y: spanOf(motion, own), ...style };
      return [...(platform === null ? [] : [{ label: platform, ...lower }]), { label: disk, ...upper }];
    });
    const ends = extent(named.flatMap(({ motion }) => motion.extent(own, below))) ?? [0, 1];
    const x = { label: WORDS.axes.time, range };
    return { title, x, y: { ...axisOf(padded(ends)), widest: WIDEST }, at, curves };
  };
  const plainAxis = (range: Range) => ({ label: WORDS.axes.angular_speed, range });
  return [
    chart(TEXTS.heights, (range) => prefixed(WORDS.axes.height, range), "height", "platform_height"),
    chart(TEXTS.angular_speeds, plainAxis, "angular_speed", "platform_angular_speed"),
  ];
}
