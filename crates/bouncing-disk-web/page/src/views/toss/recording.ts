/** A motion that the library computed: states at equal times, and what happened in between; and its charts. */

import { extent, padded } from "../../drawing/axes";
import type { Chart, Curve } from "../../drawing/chart";
import { rowsOf } from "../../drawing/files";
import { prefixOf } from "../../numbers";
import { EVENT_COLUMNS, MODES, MOTION_COLUMNS } from "../../protocol";
import type { MotionJson, Range, Response, SystemParameters } from "../../protocol";
import { say, WORDS } from "../../words";

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

  /** A column between two times, times first, in these units. */
  span(name: Column, from: number, to: number, factor = 1): Float64Array {
    const [first, last] = [Math.floor(this.place(from)), Math.ceil(this.place(to))];
    const column = MOTION_COLUMNS.indexOf(name);
    return Float64Array.from({ length: last - first + 1 }, (_, index) => this.value(first + index, column) * factor);
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

/** Periods of a chart. */
const SHOWN = 8;
/** A number as wide as those of usual ranges, so that both charts have one axis of time. */
const WIDEST = "−00.00";

/** Heights and angular speeds of a recording up to a time in periods, for the last few of these. */
export function traces(recording: Recording, now: number): [Chart, Chart] {
  const { period } = recording;
  const from = Math.max(0, now - SHOWN + 1);
  const [start, end] = [from * period, now * period];
  const x = { label: WORDS.axes.time, range: [from, from + SHOWN] as Range };
  const at = recording.span("time", start, end, 1 / period);
  const heights = recording.extent("height", "platform_height");
  const metre = prefixOf(Math.max(...heights.map(Math.abs)));
  const chart = (title: string, label: string, disk: Column, platform: Column, factor = 1): Chart => {
    const [low, high] = recording.extent(disk, platform);
    const curves: Curve[] = [
      { label: TEXTS.disk, y: recording.span(disk, start, end, factor), colour: "--disk" },
      { label: TEXTS.platform, y: recording.span(platform, start, end, factor), colour: "--platform-line", dash: [6, 3] },
    ];
    return { title, x, y: { label, range: padded([low * factor, high * factor]), widest: WIDEST }, at, curves };
  };
  const height = say(WORDS.axes.height, { prefix: metre.symbol });
  return [
    chart(TEXTS.heights, height, "height", "platform_height", metre.factor),
    chart(TEXTS.angular_speeds, WORDS.axes.angular_speed, "angular_speed", "platform_angular_speed"),
  ];
}
