/** A button that opens a list of things to do, by mouse, touch and keyboard. */

import { element } from "./elements";

export interface Item {
  readonly label: string;
  /** Set apart at the end of the line. */
  readonly note?: string;
  act(): void;
}

export class Menu {
  readonly element: HTMLElement;
  private readonly list = element("div", { class: "items", role: "menu", hidden: true });

  constructor(
    private readonly button: HTMLButtonElement,
    private readonly items: () => Item[],
  ) {
    button.setAttribute("aria-haspopup", "menu");
    button.setAttribute("aria-expanded", "false");
    button.addEventListener("click", () => (this.list.hidden ? this.open() : this.close()));
    button.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowDown") return;
      event.preventDefault();
      this.open();
    });
    this.list.addEventListener("keydown", (event) => this.pressed(event));
    this.element = element("div", { class: "menu" }, button, this.list);
    document.addEventListener("pointerdown", (event) => {
      if (!this.list.hidden && !this.element.contains(event.target as Node)) this.close(false);
    });
    this.element.addEventListener("focusout", (event) => {
      if (event.relatedTarget !== null && !this.element.contains(event.relatedTarget as Node)) this.close(false);
    });
  }

  private open(): void {
    const buttons = this.items().map(({ label, note, act }) =>
      element(
        "button",
        {
          type: "button",
          role: "menuitem",
          tabindex: -1,
          onclick: () => {
            this.close();
            act();
          },
        },
        element("span", {}, label),
        note === undefined ? null : element("span", { class: "kind" }, note),
      ),
    );
    if (buttons.length === 0)
      buttons.push(element("button", { type: "button", role: "menuitem", disabled: true }, "Nothing yet"));
    this.list.replaceChildren(...buttons);
    this.list.hidden = false;
    this.button.setAttribute("aria-expanded", "true");
    buttons[0]?.focus();
  }

  private close(focus = true): void {
    if (this.list.hidden) return;
    this.list.hidden = true;
    this.button.setAttribute("aria-expanded", "false");
    if (focus) this.button.focus();
  }

  private pressed(event: KeyboardEvent): void {
    const buttons = [...this.list.querySelectorAll("button")];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    const targets: Readonly<Record<string, number>> = {
      ArrowDown: (at + 1) % buttons.length,
      ArrowUp: (at - 1 + buttons.length) % buttons.length,
      Home: 0,
      End: buttons.length - 1,
    };
    const target = targets[event.key];
    if (event.key === "Escape") this.close();
    else if (target !== undefined) buttons[target]?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
