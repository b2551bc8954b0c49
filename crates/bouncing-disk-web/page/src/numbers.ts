/** Numbers as people type and read them. The value itself is never rounded: only what is shown of it is. */

import { DECIMAL, isLost } from "./state";
import type { WORDS } from "./words";

/** About so many significant digits, without zeros that say nothing. */
export const shown = (value: number, digits = 5): string =>
  plain(value, digits).replace(/(\.\d*?)0+(?= ×|$)/, "$1").replace(/\.(?= ×|$)/, "");

/** For a field that is eight characters wide: as short as it can be read back, five or six digits at most. */
export function abridged(value: number): string {
  const rounded = (digits: number): string => {
    const number = Number(value.toPrecision(digits));
    return number !== 0 && Math.abs(number) < 1e-3 ? number.toExponential() : String(number);
  };
  return rounded(rounded(6).length > 8 ? 5 : 6);
}

/** A value as people would write it: a short multiple of π where it is one of an angle. */
export function written(value: number, angle = false): string {
  const factor = Number((value / Math.PI).toPrecision(3));
  return angle && value !== 0 && Math.abs(factor * Math.PI - value) < 1e-15 ? `${factor}π` : abridged(value);
}

/** What people write behind a number, and how many of the field's units it is. */
const UNITS: Readonly<Record<string, Readonly<Record<string, number>>>> = {
  m: { m: 1, km: 1e3, cm: 1e-2, mm: 1e-3, "µm": 1e-6, um: 1e-6, nm: 1e-9, pm: 1e-12 },
  kg: { kg: 1, g: 1e-3, mg: 1e-6, "µg": 1e-9 },
  rad: { rad: 1, mrad: 1e-3, "µrad": 1e-6, "°": Math.PI / 180, deg: Math.PI / 180 },
  "rad/s": {
    "rad/s": 1, "krad/s": 1e3, Hz: 2 * Math.PI, kHz: 2e3 * Math.PI, MHz: 2e6 * Math.PI, rpm: Math.PI / 30, "1/s": 1,
  },
  "m/s²": { "m/s²": 1, "m/s^2": 1, "m/s2": 1, "mm/s²": 1e-3 },
  "rad/s²": { "rad/s²": 1, "rad/s^2": 1, "rad/s2": 1 },
  "": { "%": 1e-2 },
}; // prettier-ignore

/** Why a text is no number that a field takes: the name of the sentence in `words.json`. */
export type Untold = Exclude<keyof typeof WORDS.fields, "numbers" | "doubt">;

/**
 * A typed number in the unit of its field: `0.5`, `0,5`, `1e-8`, `62 mm`, with a true minus sign, and `0.26π` or `pi/2` where
 * multiples of pi are meant.
 */
export function typed(text: string, unit = "none", multiplesOfPi = false): number | Untold {
  const plain = text.trim().replaceAll("−", "-").replaceAll("μ", "µ").replace(/\s+/g, " ");
  if (/^[+-]?[1-9]\d{0,2}(,\d{3})+(?!\d)/.test(plain)) return "thousands"; // In English, and decimals elsewhere.
  const pointed = plain.includes(".") ? plain : plain.replace(",", ".");
  if (DECIMAL.test(pointed)) return held(Number(pointed), pointed);
  const [, factor = "", unitOf = ""] = /^([+-]?[\d.]+(?:e[+-]?\d+)?) ?(\D.*)$/i.exec(pointed) ?? [];
  const sizes = UNITS[unit] ?? {};
  const size = Object.hasOwn(sizes, unitOf) ? (sizes[unitOf] as number) : NaN;
  // 62 mm is 0.062 to the bit, and 15 digits are more than anybody types before a unit.
  if (DECIMAL.test(factor) && size > 0)
    return held(size === 1 ? Number(factor) : Number((Number(factor) * size).toPrecision(15)), factor);
  if (!multiplesOfPi) return "no_number";
  const [, sign, times = "", divisor = "1"] = /^([+-]?)([\d.e+-]*) ?\*? ?(?:π|pi)(?: ?\/ ?([\d.]+))?$/i.exec(pointed) ?? [];
  const number = times || "1";
  if (sign === undefined || !DECIMAL.test(number) || !(Number(divisor) > 0)) return "no_angle";
  return held(((sign === "-" ? -1 : 1) * Number(number) * Math.PI) / Number(divisor), number);
}

/** The value of these digits, unless a double cannot hold it: 1e400, or 1e-400, which would be 0. */
function held(value: number, digits: string): number | Untold {
  if (!Number.isFinite(value)) return "too_large";
  return value === 0 && isLost(digits) ? "too_small" : value;
}

export const minus = (text: string): string => text.replace("-", "\u2212");

export const superscript = (power: number): string =>
  [...String(power)].map((digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)])).join("");

/** About `digits` significant digits; powers of ten where a plain number would be long. */
export function plain(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "\u2212∞";
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  if (size >= 6 || size < -4) {
    const [lead = "", power = "0"] = value.toExponential(digits - 1).split("e");
    return `${minus(lead)} × 10${superscript(Number(power))}`;
  }
  return minus(grouped(value.toFixed(Math.max(0, digits - 1 - size))));
}

/** A number that people chose, without zeros that say nothing. */
export const brief = (value: number, digits = 6): string => minus(String(Number(value.toPrecision(digits))));

export function grouped(text: string): string {
  const [whole = "", part] = text.split(".");
  const spaced = whole.replace(/\B(?=(\d{3})+$)/g, ",");
  return part === undefined ? spaced : `${spaced}.${part}`;
}

/** Value and standard error to two digits of the error: "0.4860 ± 0.0012". */
export function withError(value: number | null, error: number | null, factor = 1): string {
  if (value === null || Number.isNaN(value)) return "–";
  if (error === null || !Number.isFinite(error) || error <= 0) return plain(value * factor);
  const [own, by] = [value * factor, error * factor];
  const decimals = Math.max(0, 1 - Math.floor(Math.log10(by)));
  // What the error hides altogether has neither digits nor a sign.
  if (Math.abs(own) < 0.5 * 10 ** -decimals) return `0 ± ${plain(by, 2)}`;
  if (decimals <= 8) return `${minus(grouped(own.toFixed(decimals)))} ± ${grouped(by.toFixed(decimals))}`;
  const power = Math.floor(Math.log10(Math.max(Math.abs(own), by)));
  const told = (one: number) => minus((one / 10 ** power).toFixed(Math.max(0, decimals + power)));
  return `(${told(own)} ± ${told(by)}) × 10${superscript(power)}`;
}

export const percent = (share: number, decimals = 1): string => `${(100 * share).toFixed(decimals)} %`;

const PREFIXES = ["p", "n", "µ", "m", "", "k", "M", "G"] as const;

/** The prefix with which the greatest value of an axis reads best; a value times `factor` is the number with it. */
export function prefixOf(greatest: number): { factor: number; symbol: string } {
  if (!(greatest > 0) || !Number.isFinite(greatest)) return { factor: 1, symbol: "" };
  const thousands = Math.min(Math.max(Math.floor(Math.log10(greatest) / 3 + 1e-9), -4), 3);
  return { factor: 10 ** (-3 * thousands), symbol: PREFIXES[thousands + 4] ?? "" };
}

/** A quantity with its unit, and with its standard error where there is one: "12.3 µs", "(12.3 ± 0.4) µs". */
export function quantity(value: number | null, unit: string, digits = 3, error: number | null = null): string {
  if (value === null || !Number.isFinite(value)) return "–";
  const { factor, symbol } = prefixOf(Math.abs(value));
  const text = error === null ? plain(value * factor, digits) : withError(value, error, factor);
  return `${text.includes("±") ? `(${text})` : text} ${symbol}${unit}`;
}

/** The next double upwards. */
export function nextDouble(value: number): number {
  if (value === 0) return Number.MIN_VALUE;
  const bits = new BigInt64Array(Float64Array.of(value).buffer);
  bits[0] = (bits[0] as bigint) + (value > 0 ? 1n : -1n);
  return new Float64Array(bits.buffer)[0] as number;
}
