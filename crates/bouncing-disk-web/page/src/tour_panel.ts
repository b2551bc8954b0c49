/** The panel of the tour: it lies beside the picture and leaves everything in reach. */

import type { State } from "./contract";
import { element, rich } from "./elements";
import { changed, DEFAULT_STATE } from "./state";
import { STEPS } from "./tour";

export class TourPanel {
  readonly element: HTMLElement;
  private readonly place = element("p", { class: "place" });
  private readonly title = element("h2", { tabindex: -1 });
  private readonly text = element("p", { class: "text" });
  private readonly back = element("button", { type: "button", onclick: () => this.go(this.step - 1) }, "Back");
  private readonly next = element(
    "button",
    { type: "button", class: "primary", onclick: () => this.go(this.step + 1) },
    "Next",
  );
  private step = 0;
  private opener: HTMLElement | null = null;

  constructor(private readonly open: (state: State) => void) {
    const end = element("button", { type: "button", onclick: () => this.end() }, "End");
    this.element = element(
      "section",
      {
        class: "tour",
        hidden: true,
        "aria-label": "Guided tour",
        onkeydown: (event: KeyboardEvent) => this.pressed(event),
      },
      this.place,
      this.title,
      this.text,
      element("div", { class: "buttons" }, end, element("span", { class: "spring" }), this.back, this.next),
    );
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
    const steps: Readonly<Record<string, number>> = { ArrowRight: 1, ArrowLeft: -1 };
    const by = steps[event.key];
    if (event.key === "Escape") this.end();
    else if (by !== undefined && STEPS[this.step + by] !== undefined) this.go(this.step + by);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
