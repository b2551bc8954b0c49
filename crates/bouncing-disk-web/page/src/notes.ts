/** What stands above a view: the note on a preset, sentences about what could not be done, and the tour. */

import type { State } from "./contract";
import { button, closeButton, element, kept, rich } from "./elements";
import { PRESETS, stateOf, STEPS, type Panel, type Preset } from "./presets";
import { changed, DEFAULT_STATE, toHash } from "./state";
import { WORDS } from "./words";

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
  private shown: { preset: Preset; panel: Panel } | null = null;

  constructor(
    private readonly host: HTMLElement,
    private readonly open: (preset: Preset, panel: Panel) => void,
  ) {}

  /** Two panels may show the same state: the one that was asked for counts. */
  choose(preset: Preset, panel: Panel): void {
    this.shown = { preset, panel };
  }

  /** Nothing while the tour explains the same states in its own way. */
  show(state: State, quiet: boolean): void {
    const { shown } = this;
    const hash = toHash(state);
    const own = shown?.preset.panels.find((panel) => toHash(stateOf(panel)) === hash);
    const found = shown && own ? { preset: shown.preset, panel: own } : BY_HASH.get(hash);
    const near = shown !== null && isNear(state, stateOf(shown.panel)) ? shown : null;
    this.shown = quiet ? null : (found ?? near);
    if (this.shown === null) this.close();
    else this.draw(this.shown.preset, found?.panel ?? null);
  }

  /** `active` is null where the parameters have been changed since. */
  private draw(preset: Preset, active: Panel | null): void {
    const panels = preset.panels.length > 1 || active === null ? preset.panels : [];
    const chips = panels.map((panel) => {
      const pressed = { class: "chip", "aria-pressed": String(panel === active) };
      return button(rich(panel.label), () => this.open(preset, panel), pressed);
    });
    const place = element("span", { class: "place" }, preset.place);
    const changed = active === null ? element("span", { class: "changed" }, "changed since") : null;
    // The focus stays on the panel that was just chosen.
    const focused = [...this.host.querySelectorAll(".chip")].indexOf(document.activeElement as HTMLElement);
    this.host.hidden = false;
    this.host.replaceChildren(
      element("h2", {}, place, ` ${preset.title}`, changed),
      closeButton("Close this note", () => this.close()),
      element("p", {}, ...rich(preset.text)),
    );
    if (chips.length > 0)
      this.host.append(element("div", { class: "chips", role: "group", "aria-label": "Panels" }, ...chips));
    if (focused >= 0) chips[focused]?.focus({ preventScroll: true });
  } // prettier-ignore

  close(): void {
    this.shown = null;
    this.host.hidden = true;
    this.host.replaceChildren();
  }
}

/** What a first visit reads: one sentence, and where to begin. Once closed, it stays so. */
export class Opening {
  constructor(
    private readonly host: HTMLElement,
    private readonly ways: readonly (readonly [string, () => void])[],
  ) {}

  show(): void {
    this.host.hidden = kept("opening") === "closed";
    const close = (): void => {
      this.host.hidden = true;
      kept("opening", "closed");
    };
    const ways = this.ways.map(([name, go]) => {
      const begin = (): void => {
        close();
        go();
      };
      return button(name, begin, { class: "primary" });
    });
    const { sentence: what, examples } = WORDS.opening;
    const sentence = element("p", {}, what, element("span", {}, ` ${examples}`));
    this.host.replaceChildren(sentence, ...ways, closeButton(WORDS.opening.close, close));
  }
}

/** More than these at once tell nobody anything. */
const MOST = 8;

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
    const shown = this.messages.slice(-MOST);
    const rest = this.messages.length - shown.length;
    if (rest > 0) shown.unshift(`${rest} more.`);
    this.host.hidden = shown.length === 0;
    const close = closeButton("Close these messages", () => this.replace([]));
    this.host.replaceChildren(...shown.map((message) => element("p", {}, message)), close);
  }
}

/** The panel of the tour: it lies beside the picture and leaves everything in reach. */
export class TourPanel {
  readonly element: HTMLElement;
  private readonly place = element("p", { class: "place" });
  private readonly title = element("h2", { tabindex: -1 });
  private readonly text = element("p", { class: "text" });
  private readonly back = button("Back", () => this.go(this.step - 1));
  private readonly next = button("Next", () => this.go(this.step + 1), { class: "primary" });
  private step = 0;
  private opener: HTMLElement | null = null;

  constructor(private readonly open: (state: State) => void) {
    const end = button("End", () => this.end());
    const buttons = [end, this.back, this.next];
    const parts = [this.place, this.title, this.text, element("div", { class: "buttons" }, ...buttons)];
    this.element = element("section", { class: "tour", hidden: true, "aria-label": "Guided tour" }, ...parts);
    this.element.addEventListener("keydown", (event) => this.pressed(event));
  }

  get running(): boolean {
    return !this.element.hidden;
  }

  begin(): void {
    if (this.running) {
      this.title.focus();
      return;
    }
    this.opener = document.activeElement as HTMLElement | null;
    this.element.hidden = false;
    this.go(0);
  }

  end(): void {
    this.element.hidden = true;
    this.opener?.focus();
  }

  private go(step: number): void {
    const shown = STEPS[step];
    if (shown === undefined) {
      if (step >= STEPS.length) this.end();
      return;
    }
    this.step = step;
    this.place.textContent = `Step ${step + 1} of ${STEPS.length}`;
    this.title.textContent = shown.title;
    this.text.replaceChildren(...rich(shown.text));
    this.back.disabled = step === 0;
    this.next.textContent = step === STEPS.length - 1 ? "Finish" : "Next";
    this.open(changed(DEFAULT_STATE, shown.change));
    // A screen reader begins with the new step; the arrow keys work from here.
    this.title.focus({ preventScroll: true });
  }

  private pressed(event: KeyboardEvent): void {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (event.key === "Escape") this.end();
    else if (by !== undefined && STEPS[this.step + by] !== undefined) this.go(this.step + by);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
