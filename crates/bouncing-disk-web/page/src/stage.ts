/** Shows one view at a time, and keeps it at the size of its place. */

import type { Context, State, View } from "./contract";
import { element } from "./elements";

export class Stage {
  private readonly hosts: ReadonlyMap<View, HTMLElement>;
  private readonly mounted = new Set<View>();
  private present: View | null = null;
  private frame = 0;

  constructor(
    place: HTMLElement,
    private readonly views: readonly View[],
    private readonly context: Context,
  ) {
    this.hosts = new Map(
      views.map((view) => [
        view,
        element("div", { class: `view view-${view.name}`, id: `view-${view.name}`, role: "tabpanel", tabindex: -1,
          "aria-labelledby": `tab-${view.name}`, "aria-description": view.description, hidden: true }),
      ]),
    ); // prettier-ignore
    place.append(...this.hosts.values());
    const observer = new ResizeObserver(() => this.redraw());
    for (const host of this.hosts.values()) observer.observe(host);
  }

  get view(): View | null {
    return this.present;
  }

  get host(): HTMLElement | undefined {
    return this.present === null ? undefined : this.hosts.get(this.present);
  }

  show(state: State): void {
    const view = this.views.find((one) => one.name === state.view);
    const host = view && this.hosts.get(view);
    if (view === undefined || host === undefined) return;
    if (this.present !== view) {
      this.present?.hide();
      for (const other of this.hosts.values()) other.hidden = other !== host;
      this.present = view;
      this.context.status("");
      if (!this.mounted.has(view)) {
        this.mounted.add(view);
        view.mount(host, this.context);
      }
    }
    view.show(state);
  }

  /** Once in the next frame, however often it is asked for. */
  redraw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => {
      if (this.present !== null && this.mounted.has(this.present)) this.present.redraw();
    });
  }
}
