/** Colours of the theme, of the printed page, and scales between them that are even to the eye. */

import { element } from "../elements";

/** Gives the colour of a custom property that `theme.css` lists. */
export type Colours = (name: string) => string;

function colourIn(scheme: string | undefined, name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return value.replace(/^light-dark\(([^,]*), *(.*)\)$/, scheme === "dark" ? "$2" : "$1");
}

/** The colours of the present theme, and those of print, which are the light ones whatever the theme is. */
export const themeColour: Colours = (name) => colourIn(document.documentElement.dataset["scheme"], name);
export const printedColour: Colours = (name) => colourIn("light", name);

/** The four bytes of an opaque pixel of a colour `#rrggbb` as one word, in the order of this machine. */
export function pixelWord(colour: string): number {
  const value = parseInt(colour.slice(1), 16);
  return new Uint32Array(Uint8Array.of(value >> 16, value >> 8, value, 255).buffer)[0] as number;
}

/** The words of `count` colours from the first stop to the last, evenly spaced in Oklab, as the browser mixes them. */
export function colourScale(stops: readonly string[], count: number): Uint32Array {
  const context = element("canvas", { width: count, height: 1 }).getContext("2d", { willReadFrequently: true });
  if (context === null) return new Uint32Array(count);
  for (let index = 0; index < count; index += 1) {
    const place = (index / (count - 1)) * (stops.length - 1);
    const low = Math.min(Math.floor(place), stops.length - 2);
    context.fillStyle = `color-mix(in oklab, ${stops[low + 1]} ${100 * (place - low)}%, ${stops[low]})`;
    context.fillRect(index, 0, 1, 1);
  }
  return new Uint32Array(context.getImageData(0, 0, count, 1).data.buffer);
}
