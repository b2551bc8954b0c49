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

/** For a field that is eight characters wide: as short as it can be read back, five or six digits at most. */
export function abridged(value: number): string {
  const rounded = (digits: number): string => {
    const number = Number(value.toPrecision(digits));
    const small = number !== 0 && Math.abs(number) < 1e-3;
    return small ? number.toExponential() : String(number);
  };
  const text = rounded(6);
  return text.length > 8 ? rounded(5) : text;
}

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
