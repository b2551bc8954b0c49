/** A few lines instead of a framework: elements with their attributes and children, and when to draw. */

import type { Context } from "./contract";

type Child = Node | string | null;

type Attributes = Readonly<Record<string, string | boolean | number | null | ((event: never) => void)>>;

/** `on...` attributes are listeners, `true` is an attribute without a value, `false` and `null` are none. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name.replace(/^on/, ""), value as EventListener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null) made.setAttribute(name, String(value));
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

export const div = (name: string, ...children: Child[]): HTMLElement => element("div", { class: name }, ...children);

/** A part of a view, with its name for screen readers; `panel` is the class of those that consist of words. */
export const section = (label: string, name: "panel" | null, ...children: Child[]): HTMLElement =>
  element("section", { class: name, "aria-label": label }, ...children);

/** An element of `index.html`, which is there, or the page is not ours. */
export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no element #${id}`);
  return found as Kind;
}

/** A symbol of the paper with its subscript: `a_e` has an upright small e. */
export const symbol = (text: string): HTMLElement => element("i", { class: "symbol" }, ...rich(text));

/** Running text with the paper's subscripts: `φ_L`. */
export function rich(text: string): Node[] {
  return text
    .split(/(_[A-Za-z]+)/)
    .map((part) => (part.startsWith("_") ? element("sub", {}, part.slice(1)) : document.createTextNode(part)));
}

export const button = (label: string | Node[], press: () => void, attributes: Attributes = {}): HTMLButtonElement =>
  element("button", { type: "button", onclick: press, ...attributes }, ...[label].flat());

/** The cross in the corner of what can be closed. */
export const closeButton = (label: string, close: () => void): HTMLButtonElement =>
  button("×", close, { class: "close", "aria-label": label });

/** Lets arrow keys, Home and End move between the buttons of a row; `arrived` is called where they lead. */
export function rove(row: HTMLElement, arrived: (button: HTMLButtonElement) => void = () => {}): void {
  row.addEventListener("keydown", (event) => {
    const buttons = [...row.querySelectorAll("button")];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const [next, previous, last] = [at + 1, at - 1 + buttons.length, buttons.length - 1];
    const arrows = { ArrowRight: next, ArrowDown: next, ArrowLeft: previous, ArrowUp: previous };
    const target = { ...arrows, Home: 0, End: last }[event.key];
    const found = buttons[(target ?? 0) % buttons.length];
    if (at < 0 || target === undefined || found === undefined) return;
    event.preventDefault();
    arrived(found);
    found.focus();
  });
}

/** Puts text into the clipboard, and says what has come of it. */
export async function copy(text: string, status: Context["status"], done: string, failed: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    status(done);
  } catch {
    status(failed, "error");
  }
}

/** Sets text only where it differs, so that screen readers and layout are left in peace. */
export function setText(target: Node, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** Values beside their names, in a list. */
export class Facts<Name extends string> {
  readonly root = element("dl", { class: "facts" });
  private readonly values = new Map<string, HTMLElement>();

  constructor(names: Readonly<Record<Name, string>>, label: string) {
    this.root.setAttribute("aria-label", label);
    for (const [name, text] of Object.entries<string>(names)) {
      const value = element("dd", {}, "–");
      this.values.set(name, value);
      this.root.append(element("div", {}, element("dt", {}, ...rich(text)), value));
    }
  }

  text(): string {
    const told = ({ firstChild, lastChild }: Node) => `${firstChild?.textContent}: ${lastChild?.textContent}`;
    return [...this.root.children].map(told).join(". ");
  }

  clear(text: string): void {
    for (const value of this.values.values()) setText(value, text);
  }

  set(facts: Readonly<Partial<Record<Name, string>>>): void {
    for (const [name, text = ""] of Object.entries<string | undefined>(facts)) setText(this.values.get(name) as Node, text);
  }
}

/** Calls at most once in a frame, and only as long as the page is shown. */
export function oncePerFrame(draw: () => void): () => void {
  let waiting = 0;
  return () => {
    if (waiting !== 0) return;
    waiting = requestAnimationFrame(() => {
      waiting = 0;
      draw();
    });
  };
}

/** Where an event is on an element, in its pixels. */
export function placeOn(surface: HTMLElement, event: MouseEvent): { x: number; y: number } {
  const box = surface.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

/** Calls when `milliseconds` have gone by without another call; `stop` forgets what waits. */
export function debounced<Values extends unknown[]>(
  milliseconds: number,
  call: (...values: Values) => void,
): { (...values: Values): void; stop(): void } {
  let timer: number | undefined;
  const later = (...values: Values) => {
    clearTimeout(timer);
    timer = window.setTimeout(() => call(...values), milliseconds);
  };
  later.stop = () => clearTimeout(timer);
  return later;
}

export const labelled = (text: string, ...field: HTMLElement[]): HTMLElement =>
  element("label", {}, `${text} `, ...field);

/** A labelled choice among names with their texts. */
export function choice<Name extends string>(
  label: string,
  texts: Readonly<Record<Name, string>>,
  choose: (name: Name) => void,
): { root: HTMLElement; select: HTMLSelectElement } {
  const options = Object.entries<string>(texts).map(([value, text]) => element("option", { value }, text));
  const select = element("select", { onchange: () => choose(select.value as Name) }, ...options);
  return { root: labelled(label, select), select };
}

/** Whether the form stands below the view, as in `screens.css`. */
export const isNarrow = (): boolean => window.matchMedia("(max-width: 860px)").matches;

/** How far the window reaches below the top of an element, wherever it has been scrolled to. */
export const roomBelow = (place: Element): number =>
  window.innerHeight - place.getBoundingClientRect().top - window.scrollY - byId("main").scrollTop;

/** Whether settings would leave no room for a picture: on a narrow screen, and below the words of a lesson. */
export const isCrowded = (): boolean => isNarrow() || document.querySelector(".tour:not([hidden])") !== null;
