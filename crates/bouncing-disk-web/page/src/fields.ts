/** A field of one number, or of several with semicolons between them: a comma may belong to a number. */

import { element } from "./elements";
import { typed, written, type Untold } from "./numbers";
import { say, WORDS } from "./words";

interface Field {
  /** Of the input. */
  readonly attributes: Readonly<Record<string, string>>;
  /** So many numbers. */
  readonly most?: number;
  /** Gives a sentence where the values are refused; what was typed stays then. */
  take(values: number[]): string | void;
  /** Says what is wrong; null: nothing any more. */
  tell(problem: string | null): void;
}

/** An `exact` number always has all its digits. */
type Meaning = Readonly<{ unit?: string; angle?: boolean; exact?: boolean }>;

export class NumberField {
  readonly input: HTMLInputElement;
  private values: readonly number[] = [];
  private meaning: Meaning = {};
  /** What was printed last: as long as it stands there, the values are meant to their last digit. */
  private printed = "";

  constructor(private readonly field: Field) {
    this.input = element("input", {
      type: "text", autocomplete: "off", spellcheck: "false", onchange: () => this.entered(),
      onfocus: () => this.focused(), onblur: () => this.print(),
      onkeydown: ({ key }: KeyboardEvent) => key === "Escape" && this.reset(), ...field.attributes,
    }); // prettier-ignore
  }

  /** Shows these numbers. What is wrong stays until there are others, or where they are `fresh`. */
  show(values: readonly number[], meaning: Meaning, fresh = false): void {
    const same = !fresh && String(values) === String(this.values);
    if (!same) this.complain(null);
    Object.assign(this, { values, meaning });
    if (!same || document.activeElement !== this.input) this.print();
  }

  /** The numbers that stand in the field; `null` where these are none. */
  numbers(): number[] | null {
    const { most = 1 } = this.field;
    if (this.input.value === this.printed) return [...this.values];
    const texts = most === 1 ? [this.input.value] : this.input.value.split(/;|,\s/);
    const numbers = texts.map((text) => this.typed(text)).filter((value) => typeof value === "number");
    return numbers.length === texts.length && numbers.length <= most ? numbers : null;
  }

  complain(problem: string | null): void {
    if (problem === null) this.input.removeAttribute("aria-invalid");
    else this.input.setAttribute("aria-invalid", "true");
    this.field.tell(problem);
  }

  /** All digits while somebody edits, otherwise as many as fit. */
  print(): void {
    if (this.input.hasAttribute("aria-invalid")) return;
    this.input.title = this.values.join("; ");
    const short = this.values.map((value) => written(value, this.meaning.angle)).join("; ");
    const whole = this.meaning.exact || document.activeElement === this.input;
    this.input.value = this.printed = whole ? this.input.title : short;
  }

  private entered(): void {
    const { most = 1, take } = this.field;
    const values = this.numbers();
    const text = this.input.value.slice(0, 24);
    const why = most > 1 ? "numbers" : (this.typed(this.input.value) as Untold);
    this.complain((values === null ? say(WORDS.fields[why], { most, text }) : take(values)) ?? null);
  }

  private typed(text: string): number | Untold {
    return typed(text, this.meaning.unit, this.meaning.angle);
  }

  private reset(): void {
    this.complain(null);
    this.focused();
  }

  private focused(): void {
    this.print();
    this.input.select();
  }
}
