/** What stands above a view: the note on a preset, and sentences about what could not be done. */

import type { State } from "./contract";
import { button, closeButton, element, isNarrow, rich } from "./elements";
import { PRESETS, stateOf, type Panel, type Preset } from "./presets";
import { DEFAULT_STATE, toHash } from "./state";
import { WORDS } from "./words";

/** What a note speaks of: settings of comparisons and scans change none of it, nor does the last digit of a number. */
const keyOf = (state: State): string => {
  const { compare, scan } = DEFAULT_STATE;
  return toHash({ ...state, compare, scan }).replace(/\d+\.\d{14,}/g, (number) => Number(number).toPrecision(14));
};

/** The preset and panel of a state, so that links, reloads and going back show the card as well. */
const BY_KEY = new Map<string, { preset: Preset; panel: Panel }>(
  [...PRESETS].reverse().flatMap((preset) => preset.panels.map((panel) => [keyOf(stateOf(panel)), { preset, panel }])),
);

export class Notes {
  private shown: { preset: Preset; panel: Panel } | null = null;

  constructor(
    private readonly host: HTMLElement,
    private readonly open: (preset: Preset, panel: Panel) => void,
  ) {}

  /** Two panels may show the same state: the one that was asked for counts. */
  choose(preset: Preset, panel: Panel): void {
    this.shown = { preset, panel };
  }

  /** Nothing while a course explains the same states in its own way. */
  show(state: State, quiet: boolean): void {
    const { shown } = this;
    const key = keyOf(state);
    const own = shown?.preset.panels.find((panel) => keyOf(stateOf(panel)) === key);
    const found = shown && own ? { preset: shown.preset, panel: own } : BY_KEY.get(key);
    const near = shown !== null && state.view === stateOf(shown.panel).view ? shown : null;
    this.shown = quiet ? null : (found ?? near);
    if (this.shown === null) this.close();
    else this.draw(this.shown.preset, found?.panel ?? null);
  }

  /** `active` is null where the parameters have been changed since. On a narrow screen the picture comes first. */
  private draw(preset: Preset, active: Panel | null): void {
    const panels = preset.panels.length > 1 || active === null ? preset.panels : [];
    const chips = panels.map((panel) => {
      const pressed = { class: "chip", "aria-pressed": String(panel === active) };
      return button(rich(panel.label), () => this.open(preset, panel), pressed);
    });
    const place = element("span", { class: "place" }, preset.place);
    const changed = active === null ? element("span", { class: "changed" }, WORDS.notes.changed) : null;
    const { host } = this;
    // What is chosen or folded stays so.
    const focused = [...host.querySelectorAll(".chip")].indexOf(document.activeElement as HTMLElement);
    const open = host.querySelector("details")?.open ?? !isNarrow();
    const heading = element("h2", {}, place, ` ${preset.title}`, changed);
    const group = { class: "chips", role: "group", "aria-label": WORDS.notes.panels };
    const parts = [element("p", {}, ...rich(preset.text)), chips.length > 0 ? element("div", group, ...chips) : null];
    host.hidden = false;
    host.replaceChildren(
      element("details", { open }, element("summary", {}, heading), ...parts),
      closeButton(WORDS.notes.close, () => this.close()),
    );
    if (focused >= 0) chips[focused]?.focus({ preventScroll: true });
  }

  close(): void {
    this.shown = null;
    this.host.hidden = true;
    this.host.replaceChildren();
  }
}

/** What a visit begins with: one sentence, and where to begin. */
export function showOpening(host: HTMLElement, ways: readonly (readonly [name: string, go: () => void])[]): void {
  host.hidden = false;
  const close = (go?: () => void): void => {
    host.hidden = true;
    go?.();
  };
  const { sentence, examples, close: label } = WORDS.opening;
  const words = element("p", {}, sentence, element("span", {}, ` ${examples}`));
  const buttons = ways.map(([name, go]) => button(name, () => close(go), { class: "primary" }));
  host.replaceChildren(words, ...buttons, closeButton(label, () => close()));
}

/** Sentences about what could not be done, until somebody closes them. */
export class Problems {
  private messages: string[] = [];

  constructor(private readonly host: HTMLElement) {}

  replace(messages: readonly string[]): void {
    this.messages = [...messages];
    this.draw();
  }

  add(message: string): void {
    if (!this.messages.includes(message)) this.messages.push(message);
    this.draw();
  }

  private draw(): void {
    this.host.hidden = this.messages.length === 0;
    const close = closeButton(WORDS.notes.close_messages, () => this.replace([]));
    this.host.replaceChildren(...this.messages.map((message) => element("p", {}, message)), close);
  }
}
