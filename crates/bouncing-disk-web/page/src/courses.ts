/** The tour and the lessons: courses of steps, each of them a state, with words beside the picture. */

import type { Change, State } from "./contract";
import { byId, button, element, rich, setText } from "./elements";
import { stateOf, STEPS } from "./presets";
import { say, WORDS } from "./words";

const TEXTS = WORDS.course;

/** A task is something to do on the page, and its answer what comes of it. */
type StepWords = Readonly<Record<"title" | "text", string> & Partial<Record<"task" | "answer", string>>>;

/** In the order in which they are offered. */
export const COURSES = (Object.keys(WORDS.courses) as (keyof typeof STEPS)[]).map((id) => {
  const words: { readonly title: string; readonly note: string; readonly steps: object } = WORDS.courses[id];
  const changes: Readonly<Record<string, Change>> = STEPS[id];
  const steps = Object.entries<StepWords>({ ...words.steps }).map(([name, said]) => ({
    ...said,
    state: stateOf({ change: changes[name] as Change }),
  }));
  return { id, title: words.title, note: words.note, steps };
});

export type Course = (typeof COURSES)[number];

/** The panel of a course: it lies beside the picture and leaves everything in reach. */
export class CoursePanel {
  readonly element: HTMLElement;
  private readonly place = element("p", { class: "place" });
  private readonly title = element("h2", { tabindex: -1 });
  private readonly text = element("div", { class: "text" });
  private readonly back = button(TEXTS.back, () => this.go(this.step - 1));
  private readonly next = button("", () => this.go(this.step + 1), { class: "primary" });
  /** What steps have opened of the form. */
  private readonly opened: HTMLDetailsElement[] = [];
  private course: Course | null = null;
  private step = 0;
  /** What was shown before the course, and what had the focus. */
  private before: { state: State; focus: Element | null } | null = null;

  constructor(
    private readonly present: () => State,
    private readonly open: (state: State) => void,
  ) {
    const end = button(TEXTS.end, () => this.end(), { title: TEXTS.end_hint });
    const stay = button(TEXTS.stay, () => this.stay(), { title: TEXTS.stay_hint });
    const buttons = element("div", { class: "buttons" }, end, stay, this.back, this.next);
    this.element = element("section", { class: "tour", hidden: true }, this.place, this.title, this.text, buttons);
    this.element.addEventListener("keydown", (event) => this.pressed(event));
  }

  get running(): boolean {
    return this.before !== null;
  }

  begin(course: Course): void {
    this.before ??= { state: this.present(), focus: document.activeElement };
    this.course = course;
    this.element.hidden = false;
    this.element.setAttribute("aria-label", course.title);
    this.go(0);
  }

  /** Leaves the page as it is now. */
  stay(): void {
    this.element.hidden = true;
    const focus = this.before?.focus as HTMLElement | null | undefined;
    // What began it may be hidden by now.
    (focus?.checkVisibility() ? focus : byId("main")).focus();
    this.before = null;
    this.opened.length = 0;
  }

  private end(): void {
    const { before } = this;
    for (const group of this.opened) group.open = false;
    this.stay();
    if (before !== null) this.open(before.state);
  }

  private go(step: number): void {
    const { title, steps } = this.course as Course;
    const shown = steps[step];
    if (shown === undefined) return step >= steps.length ? this.end() : undefined;
    this.step = step;
    setText(this.place, say(TEXTS.place, { course: title, step: step + 1, steps: steps.length }));
    setText(this.title, shown.title);
    const { text, task, answer } = shown;
    // An equation stays in one line.
    const whole = (words: string) => rich(words.replaceAll(" = ", "\u00a0=\u00a0"));
    const paragraph = (words: string) => element("p", {}, ...whole(words));
    const parts: HTMLElement[] = [paragraph(text)];
    if (task) parts.push(element("p", {}, element("b", {}, TEXTS.task), " ", ...whole(task)));
    if (answer) parts.push(element("details", {}, element("summary", {}, TEXTS.answer), paragraph(answer)));
    this.text.replaceChildren(...parts);
    // A part of the form that the step names stands open.
    for (const one of document.querySelectorAll<HTMLDetailsElement>(".group:not([open])"))
      if (`${text} ${task}`.includes(`“${one.firstElementChild?.textContent}”`)) this.opened.push(Object.assign(one, { open: true }));
    for (const one of document.querySelectorAll<HTMLDetailsElement>(".settings")) one.open = false;
    this.back.disabled = step === 0;
    setText(this.next, step === steps.length - 1 ? TEXTS.finish : TEXTS.next);
    this.open(shown.state);
    // A screen reader begins with the new step; the arrow keys work from here.
    this.title.focus({ preventScroll: true });
    for (const one of [window, byId("main")]) one.scrollTo(0, 0);
  }

  private pressed(event: KeyboardEvent): void {
    const by = event.altKey || event.shiftKey ? undefined : { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (event.key === "Escape") this.end();
    else if (by !== undefined && this.course?.steps[this.step + by] !== undefined) this.go(this.step + by);
    else return;
    event.preventDefault();
  }
}
