/** What stands around the views: tabs, the stage and dialogs. */

import { VIEW_NAMES, type Context, type State, type View, type ViewClass, type ViewName } from "./contract";
import { darkness } from "./drawing/pen";
import { button, closeButton, div, element, oncePerFrame, rove } from "./elements";
import { say, WORDS } from "./words";

/** The tabs, between which arrow keys move, and one view at a time, at the size of its place. */
export class Stage {
  private readonly parts: ReadonlyMap<ViewName, { tab: HTMLButtonElement; host: HTMLElement }>;
  private readonly made = new Map<ViewName, View>();
  private present: ViewName = "toss";
  /** Once in the next frame, however often it is asked for. */
  private readonly redraw = oncePerFrame(() => this.made.get(this.present)?.redraw());

  constructor(
    list: HTMLElement,
    place: HTMLElement,
    private readonly classes: Readonly<Record<ViewName, ViewClass>>,
    private readonly context: Context,
    choose: (name: ViewName) => void,
  ) {
    this.parts = new Map(
      VIEW_NAMES.map((name) => {
        const { title, description } = WORDS.views[name];
        const own = { class: `view view-${name}`, id: `view-${name}`, role: "tabpanel", tabindex: -1, hidden: true };
        const said = { "aria-labelledby": `tab-${name}`, "aria-description": description };
        const head = { role: "tab", id: `tab-${name}`, "aria-controls": `view-${name}` };
        return [name, { tab: button(title, () => choose(name), head), host: element("div", { ...own, ...said }) }];
      }),
    );
    const observer = new ResizeObserver(this.redraw);
    for (const { tab, host } of this.parts.values()) {
      list.append(tab);
      place.append(host);
      observer.observe(host);
    }
    rove(list, (tab) => tab.click());
    darkness().addEventListener("change", this.redraw);
  }

  get view(): View | undefined {
    return this.made.get(this.present);
  }

  focus(): void {
    this.parts.get(this.present)?.host.focus();
  }

  show(state: State, fresh: boolean): void {
    const { tab, host } = this.parts.get(state.view) as { tab: HTMLButtonElement; host: HTMLElement };
    // A change of a parameter leaves the page where it is.
    if (host.hidden) {
      this.view?.hide();
      this.present = state.view;
      for (const other of this.parts.values()) {
        other.host.hidden = other.tab !== tab;
        other.tab.setAttribute("aria-selected", String(other.tab === tab));
        other.tab.tabIndex = other.tab === tab ? 0 : -1;
      }
      tab.scrollIntoView({ block: "nearest", inline: "nearest" });
      this.context.status("");
    }
    if (this.view === undefined) this.made.set(state.view, new this.classes[state.view](host, this.context));
    this.view?.show(state, fresh);
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

export function helpDialog(): HTMLDialogElement {
  const texts = WORDS.shell.help;
  const keys = texts.keys.map(([key = "", what = ""]) => {
    const caps = key.split(" ").map((one) => element("kbd", {}, one));
    return element("div", {}, element("dt", {}, ...caps), element("dd", {}, what));
  });
  const paragraph = (...parts: (Node | string)[]): HTMLElement => element("p", {}, ...parts);
  const list = element("dl", { class: "keys" }, ...keys);
  const what = [element("h3", {}, texts.what), paragraph(say(texts.about, WORDS.opening)), paragraph(texts.model)];
  return dialog(texts.title, "help", list, ...what, paragraph(texts.licence));
}
