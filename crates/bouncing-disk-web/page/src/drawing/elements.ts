/** Elements that pictures need around them, and when to draw. */

import { element } from "../elements";

export { element };

type Attributes = Readonly<Record<string, string | boolean | number>>;

/** A button that is not a form's. */
export function button(label: string, press: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const made = element("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", press);
  return made;
}

/** Sets text only where it differs, so that screen readers and layout are left in peace. */
export function setText(target: Node, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** A list of names and values that are filled in later. */
export class Facts {
  readonly root = element("dl", { class: "facts" });
  private readonly values = new Map<string, HTMLElement>();

  constructor(names: readonly string[], label: string) {
    this.root.setAttribute("aria-label", label);
    for (const name of names) {
      const value = element("dd", {}, "–");
      this.values.set(name, value);
      this.root.append(element("div", {}, element("dt", {}, name), value));
    }
  }

  set(name: string, text: string): void {
    const value = this.values.get(name);
    if (value !== undefined) setText(value, text);
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

/** Calls when `milliseconds` have gone by without another call; `stop` forgets what waits. */
export function debounced<Values extends unknown[]>(
  milliseconds: number,
  call: (...values: Values) => void,
): { (...values: Values): void; stop(): void } {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const later = (...values: Values) => {
    clearTimeout(timer);
    timer = setTimeout(() => call(...values), milliseconds);
  };
  later.stop = () => clearTimeout(timer);
  return later;
}

export function prefersLessMotion(): boolean {
  return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}
