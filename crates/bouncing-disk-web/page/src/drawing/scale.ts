/** Scales of axes: from a value to its share of the axis, and back. */

import type { Range } from "../protocol";

export interface Scale {
  readonly kind: "linear" | "log";
  readonly domain: Range;
  /** 0 at the low end, 1 at the high end. */
  share(value: number): number;
  value(share: number): number;
}

export function linearScale(domain: Range): Scale {
  const [low, high] = domain;
  const width = high - low || 1;
  return { kind: "linear", domain, share: (value) => (value - low) / width, value: (share) => low + share * width };
}

export function logScale(domain: Range): Scale {
  const low = Math.log(domain[0]);
  const width = Math.log(domain[1]) - low || 1;
  return {
    kind: "log",
    domain,
    share: (value) => (Math.log(value) - low) / width,
    value: (share) => Math.exp(low + share * width),
  };
}

/** The smallest of 1, 2 and 5 times a power of ten that is not below a positive value. */
export function roundUp(value: number): number {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  const step = lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10;
  return step * power;
}

/** A range that has some room on both sides; never empty. */
export function padded([low, high]: Range, share = 0.05): Range {
  if (!(high > low)) {
    const room = Math.abs(low) * 0.1 || 1;
    return [low - room, high + room];
  }
  const room = (high - low) * share;
  return [low - room, high + room];
}

/** The least and the greatest finite number; null if there is none. */
export function extent(values: ArrayLike<number>, start = 0, stride = 1): Range | null {
  let low = Infinity;
  let high = -Infinity;
  for (let index = start; index < values.length; index += stride) {
    const value = values[index] as number;
    if (value < low) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return low <= high && low > -Infinity ? [low, high] : null;
}

export function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
