/** A few lines instead of a framework: elements with their attributes and children. */

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

/** An element of `index.html`, which is there, or the page is not ours. */
export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no element #${id}`);
  return found as Kind;
}

/** A symbol of the paper with its subscript: `a_e` has an upright small e. */
export function symbol(text: string): HTMLElement {
  const [base = "", below] = text.split("_");
  return element("i", { class: "symbol" }, base, below === undefined ? null : element("sub", {}, below));
}

/** Running text with the paper's subscripts: `φ_L`. */
export function rich(text: string): Node[] {
  return text
    .split(/(_[A-Za-z]+)/)
    .map((part) => (part.startsWith("_") ? element("sub", {}, part.slice(1)) : document.createTextNode(part)));
}

/** Something kept from visit to visit; a page on the disk may not be allowed to. */
export const kept = {
  read(name: string): string | null {
    try {
      return localStorage.getItem(`bouncing-disk ${name}`);
    } catch {
      return null;
    }
  },
  write(name: string, value: string): void {
    try {
      localStorage.setItem(`bouncing-disk ${name}`, value);
    } catch {
      // It lasts until the page is closed, then.
    }
  },
};
