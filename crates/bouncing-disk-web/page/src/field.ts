/** One parameter of the form: symbol, slider, number and unit, and what is wrong with what was typed. */

import type { Change, State } from "./contract";
import { element, symbol } from "./elements";
import { abridged, shown, stepped, typed } from "./numbers";
import type { Parameter } from "./parameter_list";
import type { Range, Refusal, Summary } from "./protocol";
import type { ChangeOptions } from "./store";

/** Positions of a slider. */
const POSITIONS = 1000;
/** A logarithmic slider reaches from a tenth to ten times of its value. */
const REACH = 10;

export type Propose = (change: Change, options: ChangeOptions) => void;

export class Field {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly input: HTMLInputElement;
  private readonly hint: HTMLElement;
  private readonly error: HTMLElement;
  private state: State | null = null;
  private value: number | null = null;
  private range: Range = [0, 1];

  constructor(
    private readonly parameter: Parameter,
    private readonly propose: Propose,
  ) {
    const { name, label, unit } = parameter;
    const spoken = `${label}${unit ? `, ${unit}` : ""}`;
    this.slider = element("input", {
      type: "range", min: 0, max: POSITIONS, step: 1, "aria-label": `${spoken}, slider`,
      oninput: () => this.slid(false), onchange: () => this.slid(true),
    }); // prettier-ignore
    this.input = element("input", {
      type: "text", id: `field-${name}`, inputmode: "decimal", autocomplete: "off", spellcheck: "false",
      "aria-describedby": `error-${name}`, onchange: () => this.entered(), onfocus: () => this.focused(),
      onblur: () => this.print(), onkeydown: (event: KeyboardEvent) => this.pressed(event),
    }); // prettier-ignore
    this.hint = element("span", { class: "hint" });
    this.error = element("p", { class: "error", id: `error-${name}`, role: "alert", hidden: true });
    this.element = element(
      "div",
      { class: "field", "data-name": name },
      element("label", { for: `field-${name}` }, symbol(parameter.symbol), element("span", { class: "label" }, label)),
      this.hint,
      this.slider,
      this.input,
      element("span", { class: "unit" }, unit),
      this.error,
    );
  }

  /** Shows the value of a state; `fresh` if the state comes from elsewhere, and what was typed is of no interest. */
  show(state: State, summary: Summary | null, fresh: boolean): void {
    this.state = state;
    const value = this.parameter.value(state, summary);
    if (value === null) return;
    const same = this.value !== null && Object.is(value, this.value);
    this.value = value;
    if (fresh) this.complain(null);
    if (fresh || value < this.range[0] || value > this.range[1]) this.range = this.suitable(value, state);
    if (!same || fresh) this.print();
    this.slider.value = String(this.position(value));
    this.slider.setAttribute("aria-valuetext", `${shown(value)} ${this.parameter.unit}`);
    this.hint.textContent = this.parameter.hint?.(value, state) ?? "";
  }

  private suitable(value: number, state: State): Range {
    if (this.parameter.slider === "logarithmic") {
      const size = value > 0 ? value : 1;
      return [size / REACH, size * REACH];
    }
    const [low, high] = this.parameter.slider(state);
    return [Math.min(low, value), Math.max(high, value)];
  }

  private position(value: number): number {
    const [low, high] = this.range;
    const logarithmic = this.parameter.slider === "logarithmic";
    const share = logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(POSITIONS * Math.min(1, Math.max(0, share)));
  }

  private slid(settled: boolean): void {
    const [low, high] = this.range;
    const share = Number(this.slider.value) / POSITIONS;
    const logarithmic = this.parameter.slider === "logarithmic";
    const exact = logarithmic ? low * (high / low) ** share : low + share * (high - low);
    // No more digits than a position means, so that the number can be read, typed and cited.
    const digit = logarithmic
      ? 10 ** (Math.floor(Math.log10(exact)) - 3)
      : 10 ** Math.floor(Math.log10(high - low) - 3);
    this.ask(Number((Math.round(exact / digit) * digit).toPrecision(12)), settled);
  }

  private entered(): void {
    const text = this.input.value;
    if (this.value !== null && (text === String(this.value) || text === abridged(this.value))) {
      this.complain(null);
      return;
    }
    const value = typed(text, this.parameter.angle === true);
    if (value !== null) this.ask(value, true);
    else
      this.complain(
        `"${text.slice(0, 24)}" is not a number; write it like 0.5 or 1e-8${this.parameter.angle ? " or 0.26π" : ""}.`,
      );
  }

  private pressed(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      this.complain(null);
      this.focused();
    } else if ((event.key === "ArrowUp" || event.key === "ArrowDown") && this.value !== null) {
      event.preventDefault();
      this.ask(stepped(this.value, event.key === "ArrowUp" ? 1 : -1, event.shiftKey, 0.01), true);
    }
  }

  private ask(value: number, settled: boolean): void {
    if (this.state === null) return;
    this.propose(this.parameter.change(value, this.state), {
      settled,
      refused: (refusal) => this.complain(this.words(refusal, value)),
      taken: () => {
        this.complain(null);
        this.print();
      },
    });
  }

  private words(refusal: Refusal, value: number): string {
    const { quantity, message } = refusal;
    const { label, name, refusedAs } = this.parameter;
    const follows = refusedAs?.quantities.includes(quantity ?? "") === true;
    const range = follows ? refusedAs.range : quantity === name ? refusal.range : null;
    if (range === null) return `${message}${/[.!]$/.test(message) ? "" : "."}`;
    return `${shown(value)} is refused: the ${label.split(",")[0]} has to be in ${range}.`;
  }

  /** What is wrong stays until something legal is typed, and so does the text. */
  private complain(message: string | null): void {
    this.error.textContent = message ?? "";
    this.error.hidden = message === null;
    this.element.classList.toggle("wrong", message !== null);
    if (message === null) this.input.removeAttribute("aria-invalid");
    else this.input.setAttribute("aria-invalid", "true");
  }

  private focused(): void {
    if (this.error.hidden && this.value !== null) this.input.value = String(this.value);
    this.input.select();
  }

  /** All digits while somebody edits, as many as fit otherwise. */
  private print(): void {
    if (this.value === null || !this.error.hidden) return;
    const editing = document.activeElement === this.input;
    this.input.value = editing ? String(this.value) : abridged(this.value);
    this.input.title = String(this.value);
  }
}
