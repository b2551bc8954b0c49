/** Colours of the theme and of the printed page. */

/** Gives the colour of a custom property that `theme.css` lists. */
export type Colours = (name: string) => string;

function colourIn(scheme: string | undefined, name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return value.replace(/^light-dark\(([^,]*), *(.*)\)$/, scheme === "dark" ? "$2" : "$1");
}

/** The colours of the present theme, and those of print, which are the light ones whatever the theme is. */
export const themeColour: Colours = (name) => colourIn(document.documentElement.dataset["scheme"], name);
export const printedColour: Colours = (name) => colourIn("light", name);
