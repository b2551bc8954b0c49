/** What stands around the views: tabs, the stage and dialogs. */

import { VIEW_NAMES, type Context, type State, type View, type ViewClass, type ViewName } from "./contract";
import { darkness } from "./drawing/pen";
import { button, closeButton, div, element, kept, oncePerFrame, rove } from "./elements";
import { say, WORDS } from "./words";

/** The tabs of the views: arrow keys move between them, as everywhere. */
export class Tabs {
  private readonly buttons: readonly HTMLButtonElement[];

  constructor(list: HTMLElement, choose: (name: ViewName) => void) {
    this.buttons = VIEW_NAMES.map((name) => {
      const attributes = { role: "tab", id: `tab-${name}`, "aria-controls": `view-${name}` };
      return button(WORDS.views[name].title, () => choose(name), attributes);
    });
    list.append(...this.buttons);
    rove(list, (tab) => tab.click());
  }

  show(present: ViewName): void {
    this.buttons.forEach((tab, index) => {
      const shown = VIEW_NAMES[index] === present;
      const was = tab.getAttribute("aria-selected") === "true";
      tab.setAttribute("aria-selected", String(shown));
      tab.tabIndex = shown ? 0 : -1;
      // Only a tab that was not chosen before: a change of a parameter leaves the page where it is.
      if (shown && !was) tab.scrollIntoView({ block: "nearest", inline: "nearest" });
    });
  }
}

/** Shows one view at a time, and keeps it at the size of its place. */
export class Stage {
  private readonly hosts: ReadonlyMap<ViewName, HTMLElement>;
  private readonly made = new Map<ViewName, View>();
  private present: ViewName | null = null;
  /** Once in the next frame, however often it is asked for. */
  readonly redraw = oncePerFrame(() => this.view?.redraw());

  constructor(
    place: HTMLElement,
    private readonly classes: Readonly<Record<ViewName, ViewClass>>,
    private readonly context: Context,
  ) {
    this.hosts = new Map(
      VIEW_NAMES.map((name) => {
        const said = { "aria-labelledby": `tab-${name}`, "aria-description": WORDS.views[name].description };
        const own = { class: `view view-${name}`, id: `view-${name}`, role: "tabpanel", tabindex: -1, hidden: true };
        return [name, element("div", { ...own, ...said })];
      }),
    );
    place.append(...this.hosts.values());
    const observer = new ResizeObserver(() => this.redraw());
    for (const host of this.hosts.values()) observer.observe(host);
    darkness().addEventListener("change", this.redraw);
  }

  get view(): View | undefined {
    return this.present === null ? undefined : this.made.get(this.present);
  }

  get host(): HTMLElement | undefined {
    return this.present === null ? undefined : this.hosts.get(this.present);
  }

  show(state: State): void {
    if (this.present !== state.view) {
      this.view?.hide();
      this.present = state.view;
      for (const [name, host] of this.hosts) host.hidden = name !== state.view;
      this.context.status("");
    }
    const { host, classes, context } = this;
    if (this.view === undefined && host) this.made.set(state.view, new classes[state.view](host, context));
    this.view?.show(state);
  }
}

function dialog(title: string, name: string, ...content: Node[]): HTMLDialogElement {
  const made = element("dialog", { class: name, "aria-labelledby": `${name}-title` });
  const heading = element("h2", { id: `${name}-title` }, title);
  const close = closeButton(WORDS.shell.close, () => made.close());
  made.append(div("sheet", heading, close, ...content));
  // A click beside the sheet closes it.
  made.addEventListener("click", (event) => {
    if (event.target === made) made.close();
  });
  document.body.append(made);
  return made;
}

interface Choice {
  readonly label: string;
  readonly note: string;
  readonly attributes?: Readonly<Record<string, string>>;
  act(): void;
}

/** A dialog of things to choose from, made anew whenever it is opened; arrow keys move between them, too. */
export function choices(title: string, name: string, words: string, choicesNow: () => Choice[]): () => void {
  const cards = div("cards");
  const made = dialog(title, name, element("p", {}, words), cards);
  rove(cards);
  // It is closed before the choice acts, which may open another one.
  cards.addEventListener("click", (event) => event.target !== cards && made.close(), { capture: true });
  return () => {
    const card = ({ label, note, attributes, act }: Choice) =>
      button([element("b", {}, label), element("span", {}, note)], act, { class: "card", ...attributes });
    cards.replaceChildren(...choicesNow().map(card));
    made.showModal();
  };
}

/** Single keys get in the way of dictation and of some screen readers, so they can be switched off. */
export const shortcutsOn = (): boolean => kept("keys") !== "off";

export function helpDialog(): HTMLDialogElement {
  const texts = WORDS.shell.help;
  const box = element("input", { type: "checkbox", id: "keys-on", checked: shortcutsOn() });
  box.addEventListener("change", () => kept("keys", box.checked ? "on" : "off"));
  const keys = texts.keys.map(([key = "", what = ""]) => {
    const caps = key.split(" ").map((one) => element("kbd", {}, one));
    return element("div", {}, element("dt", {}, ...caps), element("dd", {}, what));
  });
  const paragraph = (...parts: (Node | string)[]): HTMLElement => element("p", {}, ...parts);
  const [before = "", after = ""] = texts.model.split("{paper}");
  const model = paragraph(before, element("cite", {}, texts.paper), after);
  const list = element("dl", { class: "keys" }, ...keys);
  const switched = paragraph(element("label", {}, box, ` ${texts.on}`));
  const what = [element("h3", {}, texts.what), paragraph(say(texts.about, WORDS.opening)), model];
  return dialog(texts.title, "help", list, switched, ...what, paragraph(texts.licence));
}
