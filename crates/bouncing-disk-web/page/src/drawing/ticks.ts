/** Ticks of an axis and what stands beside them. */

import type { Range } from "../protocol";
import { minus, superscript } from "./numbers";
import type { Scale } from "./scale";

export interface Ticks {
  readonly major: readonly { readonly value: number; readonly label: string }[];
  readonly minor: readonly number[];
}

/** At most about `count` labelled ticks. `factor` turns a value into the unit of the label. */
export function ticks(scale: Scale, count: number, factor = 1): Ticks {
  return scale.kind === "log" ? logTicks(scale.domain, count, factor) : linearTicks(scale.domain, count, factor);
}

function linearTicks([low, high]: Range, count: number, factor: number): Ticks {
  const width = (high - low) * factor;
  if (!(width > 0)) return { major: [], minor: [] };
  const raw = width / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  const [step, parts] = lead <= 1 ? [1, 5] : lead <= 2 ? [2, 4] : lead <= 5 ? [5, 5] : [10, 5];
  const size = step * power;
  const decimals = Math.max(0, -Math.floor(Math.log10(size) + 1e-9));
  const at = (index: number, by: number) => (index * by) / factor;
  const slack = 1e-9;
  const between = (by: number) => {
    const first = Math.ceil((low * factor) / by - slack);
    const last = Math.floor((high * factor) / by + slack);
    return Array.from({ length: Math.max(last - first + 1, 0) }, (_, index) => first + index);
  };
  return {
    major: between(size).map((index) => ({ value: at(index, size), label: tickLabel(index * size, size, decimals) })),
    minor: between(size / parts)
      .filter((index) => index % parts !== 0)
      .map((index) => at(index, size / parts)),
  };
}

function tickLabel(value: number, step: number, decimals: number): string {
  const bound = Math.abs(value) < step * 1e-6 ? 0 : value;
  // More decimals than a double has next to 1 are powers of ten of a small number.
  return decimals <= 17 ? minus(bound.toFixed(decimals)) : minus(bound.toPrecision(6));
}

function logTicks([low, high]: Range, count: number, factor: number): Ticks {
  const first = Math.floor(Math.log10(low * factor));
  const last = Math.ceil(Math.log10(high * factor));
  const every = Math.max(1, Math.ceil((last - first) / Math.max(count, 1)));
  const major: { value: number; label: string }[] = [];
  const minor: number[] = [];
  for (let power = first; power <= last; power += 1) {
    for (let digit = 1; digit < 10; digit += 1) {
      const value = (digit * 10 ** power) / factor;
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
      if (digit === 1 && (power - first) % every === 0) major.push({ value, label: `10${superscript(power)}` });
      else minor.push(value);
    }
  }
  return { major, minor };
}
