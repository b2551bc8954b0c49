/** The card that says what a preset shows, as long as the page shows it, and offers its panels. */

import type { State } from "./contract";
import { element, rich } from "./elements";
import { PRESETS, stateOf, type Panel, type Preset } from "./presets";
import { toHash } from "./state";

/** The preset and panel of a state, so that links, reloads and going back show the card as well. */
const BY_HASH = new Map<string, { preset: Preset; panel: Panel }>(
  [...PRESETS].reverse().flatMap((preset) => preset.panels.map((panel) => [toHash(stateOf(panel)), { preset, panel }])),
);

/** Whether a note still speaks of this state: the same view, with no more of the system changed than is left of it. */
function isNear(state: State, shown: State): boolean {
  const names = Object.keys(shown.system) as (keyof State["system"])[];
  const changes = names.filter((name) => state.system[name] !== shown.system[name]).length;
  return state.view === shown.view && 2 * changes <= names.length;
}

export class Notes {
  private preset: Preset | null = null;
  /** The panel that was shown last. */
  private panel: Panel | null = null;

  constructor(
    private readonly host: HTMLElement,
    private readonly open: (preset: Preset, panel: Panel) => void,
  ) {}

  /** Two panels may show the same state: the one that was asked for counts. */
  choose(preset: Preset, panel: Panel): void {
    this.preset = preset;
    this.panel = panel;
  }

  /** Nothing while the tour explains the same states in its own way. */
  show(state: State, quiet: boolean): void {
    if (quiet) {
      this.close();
      return;
    }
    const hash = toHash(state);
    const own = this.preset?.panels.find((panel) => toHash(stateOf(panel)) === hash);
    const found = this.preset && own ? { preset: this.preset, panel: own } : BY_HASH.get(hash);
    if (found !== undefined) {
      this.preset = found.preset;
      this.panel = found.panel;
      this.draw(found.preset, found.panel);
    } else if (this.preset !== null && this.panel !== null && isNear(state, stateOf(this.panel))) {
      this.draw(this.preset, null);
    } else {
      this.close();
    }
  }

  /** `active` is null where the parameters have been changed since. */
  private draw(preset: Preset, active: Panel | null): void {
    const panels = preset.panels.length > 1 || active === null ? preset.panels : [];
    const chips = panels.map((panel) =>
      element("button", { type: "button", class: "chip", "aria-pressed": panel === active ? "true" : "false",
        onclick: () => this.open(preset, panel) }, ...rich(panel.label)),
    ); // prettier-ignore
    const close = element("button", { type: "button", class: "quiet close", "aria-label": "Close this note",
      onclick: () => this.close() }, "×"); // prettier-ignore
    // The focus stays on the panel that was just chosen.
    const focused = [...this.host.querySelectorAll(".chip")].indexOf(document.activeElement as HTMLElement);
    this.host.hidden = false;
    this.host.classList.toggle("left", active === null);
    this.host.replaceChildren(
      element("h2", {}, element("span", { class: "place" }, preset.place), ` ${preset.title}`,
        active === null ? element("span", { class: "changed" }, "changed since") : null),
      close,
      element("p", {}, ...rich(preset.text)),
      chips.length > 0 ? element("div", { class: "chips", role: "group", "aria-label": "Panels" }, ...chips) : "",
    ); // prettier-ignore
    if (focused >= 0) chips[focused]?.focus({ preventScroll: true });
  }

  close(): void {
    this.preset = null;
    this.panel = null;
    this.host.hidden = true;
    this.host.replaceChildren();
  }
}
