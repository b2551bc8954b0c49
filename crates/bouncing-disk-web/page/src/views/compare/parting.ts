/** How two motions part: what is read from the difference of their heights, as a share of the amplitude. */

/** From this share on the heights count as different. */
export const APART = 0.01;
/** Below the first one rounding makes the difference, above the second one the bounds of the motion do. */
export const GROWING = [1e-13, 1e-2] as const;
/** A growth needs so many periods, and so many powers of ten between its ends. */
const LEAST_PERIODS = 5;
const LEAST_DECADES = 1;

export interface Growth {
  /** The mean factor of a period, by a straight line through the logarithms of the largest differences of each. */
  readonly factor: number;
  /** Periods from the first to the last of them, and the height of the line in a period. */
  readonly from: number;
  readonly to: number;
  log(period: number): number;
}

export interface Parting {
  /** Of each period. */
  readonly largest: readonly number[];
  /** Periods until the heights differ by more than 1 % of the amplitude; null if they never do. */
  readonly first: number | null;
  readonly growth: Growth | null;
}

/** `apart` has so many values in each period. */
export function partingOf(apart: Float64Array, perPeriod: number): Parting {
  const first = apart.findIndex((value) => value > APART);
  const periods = Math.floor((apart.length - 1) / perPeriod);
  const largest = Array.from({ length: periods }, (_, period) =>
    Math.max(...apart.subarray(period * perPeriod, (period + 1) * perPeriod)),
  );
  return { largest, first: first < 0 ? null : first / perPeriod, growth: growthOf(largest) };
}

/** The longest stretch of periods in which neither rounding nor saturation makes the difference. */
function growthOf(largest: readonly number[]): Growth | null {
  let [from, to] = [0, 0];
  for (let start = 0, end = 0; end <= largest.length; end += 1) {
    const value = largest[end] ?? NaN;
    if (value > GROWING[0] && value < GROWING[1]) continue;
    if (end - start > to - from) [from, to] = [start, end];
    start = end + 1;
  }
  const logs = largest.slice(from, to).map(Math.log10);
  if (logs.length < LEAST_PERIODS) return null;
  const middle = (logs.length - 1) / 2;
  const mean = logs.reduce((sum, log) => sum + log, 0) / logs.length;
  const up = logs.reduce((sum, log, period) => sum + (period - middle) * (log - mean), 0);
  const slope = up / logs.reduce((sum, _, period) => sum + (period - middle) ** 2, 0);
  if (Math.abs(slope) * (logs.length - 1) < LEAST_DECADES) return null;
  return { factor: 10 ** slope, from, to: to - 1, log: (period) => mean + slope * (period - from - middle) };
}

/** The next double upwards. */
export function nextDouble(value: number): number {
  if (value === 0) return Number.MIN_VALUE;
  const bits = new BigInt64Array(Float64Array.of(value).buffer);
  bits[0] = (bits[0] as bigint) + (value > 0 ? 1n : -1n);
  return new Float64Array(bits.buffer)[0] as number;
}
