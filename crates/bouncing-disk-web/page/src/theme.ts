/** Light, dark, or as the system has it. `data-scheme` on the root element is what the style sheet looks at. */

import { kept } from "./elements";

export type Theme = "automatic" | "light" | "dark";

const THEMES: readonly Theme[] = ["automatic", "light", "dark"];
const dark = window.matchMedia("(prefers-color-scheme: dark)");

export class Themes {
  private theme: Theme;

  constructor(private readonly changed: () => void) {
    const name = kept.read("theme");
    this.theme = THEMES.find((theme) => theme === name) ?? "automatic";
    dark.addEventListener("change", () => this.apply());
    this.apply();
  }

  get present(): Theme {
    return this.theme;
  }

  next(): Theme {
    this.theme = THEMES[(THEMES.indexOf(this.theme) + 1) % THEMES.length] ?? "automatic";
    kept.write("theme", this.theme);
    this.apply();
    return this.theme;
  }

  private apply(): void {
    const scheme = this.theme === "automatic" ? (dark.matches ? "dark" : "light") : this.theme;
    const { dataset } = document.documentElement;
    if (dataset["scheme"] === scheme) return;
    dataset["scheme"] = scheme;
    this.changed();
  }
}
