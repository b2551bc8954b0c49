/** The tabs of the views: arrow keys move between them, as everywhere. */

import type { View, ViewName } from "./contract";
import { element } from "./elements";

export class Tabs {
  private readonly buttons: ReadonlyMap<ViewName, HTMLButtonElement>;

  constructor(list: HTMLElement, views: readonly View[], choose: (name: ViewName) => void) {
    this.buttons = new Map(
      views.map(({ name, title }) => [
        name,
        element("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `view-${name}`,
          onclick: () => choose(name) }, title),
      ]),
    ); // prettier-ignore
    list.append(...this.buttons.values());
    const names = views.map((view) => view.name);
    list.addEventListener("keydown", (event) => {
      const at = names.findIndex((name) => this.buttons.get(name) === document.activeElement);
      const targets: Readonly<Record<string, number>> = {
        ArrowRight: (at + 1) % names.length,
        ArrowLeft: (at - 1 + names.length) % names.length,
        Home: 0,
        End: names.length - 1,
      };
      const name = names[targets[event.key] ?? -1];
      if (at < 0 || name === undefined) return;
      event.preventDefault();
      choose(name);
      this.buttons.get(name)?.focus();
    });
  }

  show(present: ViewName): void {
    for (const [name, button] of this.buttons) {
      button.setAttribute("aria-selected", String(name === present));
      button.tabIndex = name === present ? 0 : -1;
      if (name === present) button.scrollIntoView({ block: "nearest", inline: "nearest" });
    }
  }
}
