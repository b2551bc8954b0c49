/** Numbers as people type and read them. The value itself is never rounded: only what is shown of it is. */

import { readNumber } from "./state";

const MINUS = "−";

/** About so many significant digits, with a true minus sign and 10ⁿ where it is easier to read. */
export function shown(value: number, digits = 5): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "not a number" : value > 0 ? "∞" : `${MINUS}∞`;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e6) return String(Number(value.toPrecision(digits))).replace("-", MINUS);
  const [mantissa = "", exponent = ""] = value.toExponential(digits - 1).split("e");
  const power = [...String(Number(exponent))].map((digit) => SUPERSCRIPT[digit] ?? digit).join("");
  const factor = String(Number(mantissa)).replace("-", MINUS);
  return factor === "1" ? `10${power}` : `${factor} × 10${power}`;
}

const SUPERSCRIPT: Readonly<Record<string, string>> = {
  "-": "⁻", "0": "⁰", "1": "¹", "2": "²", "3": "³", "4": "⁴", "5": "⁵", "6": "⁶", "7": "⁷", "8": "⁸", "9": "⁹",
}; // prettier-ignore

/** For a field: as short as it can be read back, at most five digits. */
export const abridged = (value: number): string => String(Number(value.toPrecision(5)));

/** A typed number: `0.5`, `1e-8`, with a true minus sign, and `0.26π` or `pi/2` where multiples of pi are meant. */
export function typed(text: string, multiplesOfPi: boolean): number | null {
  const plain = text.trim().replaceAll(MINUS, "-").replace(/\s+/g, " ");
  const direct = readNumber(plain);
  if (direct !== null || !multiplesOfPi) return direct;
  const parts = /^([+-]?)([\d.e+-]*) ?\*? ?(?:π|pi)(?: ?\/ ?([\d.]+))?$/i.exec(plain);
  if (parts === null) return null;
  const [, sign, factorText, divisorText] = parts;
  const factor = factorText ? readNumber(factorText) : 1;
  const divisor = divisorText ? readNumber(divisorText) : 1;
  if (factor === null || divisor === null || divisor === 0) return null;
  return ((sign === "-" ? -1 : 1) * factor * Math.PI) / divisor;
}

/** The next number of three significant digits, up or down; `coarse` makes ten such steps. */
export function stepped(value: number, direction: 1 | -1, coarse: boolean, smallest: number): number {
  const size = Math.abs(value);
  const exponent = size > 0 ? Math.floor(Math.log10(size)) - 2 : Math.log10(smallest);
  const step = 10 ** exponent * (coarse ? 10 : 1);
  return Number((Math.round(value / step + direction) * step).toPrecision(12));
}
