/** Colours of the theme, of the printed page, and scales between them that are even to the eye. */

/** Gives the colour of a custom property that `theme.css` lists. */
export type Colours = (name: string) => string;

function colourIn(scheme: string | undefined, name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return value.replace(/^light-dark\(([^,]*), *(.*)\)$/, scheme === "dark" ? "$2" : "$1");
}

/** The colours of the present theme, and those of print, which are the light ones whatever the theme is. */
export const themeColour: Colours = (name) => colourIn(document.documentElement.dataset["scheme"], name);
export const printedColour: Colours = (name) => colourIn("light", name);

export type Rgb = readonly [number, number, number];

/** Reads `#rrggbb`. */
export function parseColour(text: string): Rgb {
  const value = parseInt(text.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

/** The four bytes of an opaque pixel as one word, in the order of this machine. */
export function pixelWord(colour: Rgb): number {
  return new Uint32Array(Uint8ClampedArray.of(...colour, 255).buffer)[0] as number;
}

/** `count` colours from the first stop to the last, evenly spaced in Oklab. */
export function colourScale(stops: readonly string[], count: number): Rgb[] {
  const laboratory = stops.map((stop) => toOklab(parseColour(stop)));
  return Array.from({ length: count }, (_, index) => {
    const place = (index / Math.max(count - 1, 1)) * (laboratory.length - 1);
    const low = Math.min(Math.floor(place), laboratory.length - 2);
    const from = laboratory[low] ?? [0, 0, 0];
    const to = laboratory[low + 1] ?? from;
    const share = place - low;
    return fromOklab([mix(from[0], to[0], share), mix(from[1], to[1], share), mix(from[2], to[2], share)]);
  });
}

function mix(from: number, to: number, share: number): number {
  return from + (to - from) * share;
}

function toOklab(colour: Rgb): [number, number, number] {
  const [r, g, b] = colour.map((byte) => {
    const share = byte / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function fromOklab([lightness, a, b]: readonly [number, number, number]): Rgb {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return linear.map((share) => {
    const bound = Math.min(Math.max(share, 0), 1);
    return Math.round(255 * (bound <= 0.0031308 ? 12.92 * bound : 1.055 * bound ** (1 / 2.4) - 0.055));
  }) as unknown as Rgb;
}
