/** The parameters that a scan or a comparison varies, and the fields that choose one and its values. */

import type { Context, State } from "../contract";
import { choice, element, isNarrow } from "../elements";
import { PARAMETERS, shortLabelOf, type Parameter } from "../form";
import { abridged, minus, typed } from "../numbers";
import type { Range, Summary } from "../protocol";
import { changed } from "../state";
import { say, WORDS } from "../words";

/** A parameter by its name, which the address has checked. */
export const varied = (name: string): Parameter =>
  PARAMETERS.find((one) => one.name === name) ?? (PARAMETERS[0] as Parameter);

export const withValue = (parameter: Parameter, value: number, state: State): State =>
  changed(state, parameter.change(value, state));

/** The value that a state has, by the module's word where it follows from others. */
export async function valueIn({ client }: Context, slot: string, parameter: Parameter, state: State): Promise<number> {
  const { json } = await client.ask<Summary>(slot, { call: "check", system: state.system });
  return parameter.value(state, json) ?? NaN;
}

/** Some range about a value that shows what a parameter does. */
export const rangeAbout = (value: number, { slider }: Parameter, state: State): Range =>
  typeof slider === "function" ? slider(state) : [value / 2, value * 2 || 1];

const unitOf = ({ unit }: Parameter, before: string, after = ""): string => (unit === "" ? "" : before + unit + after);

/** The label of an axis: "amplitude angle *φ*_{L} (rad)". */
export function axisOf(parameter: Parameter): string {
  const [base = "", below] = parameter.symbol.split("_");
  const symbol = `*${base}*${below === undefined ? "" : `_{${below}}`}`;
  return `${shortLabelOf(parameter)} ${symbol}${unitOf(parameter, " (", ")")}`;
}

/** A value as people would write it: a short multiple of π where it is one. */
function written(value: number, angle = false): string {
  const factor = Number((value / Math.PI).toPrecision(3));
  return angle && value !== 0 && factor * Math.PI === value ? `${factor}π` : abridged(value);
}

/** "θ = −0.25π" and "φ_L = 0.55 rad" */
export function valueText(parameter: Parameter, value: number): string {
  const text = minus(written(value, parameter.angle));
  const bare = parameter.angle === true && /^0$|π$/.test(text);
  return `${parameter.symbol} = ${text}${bare ? "" : unitOf(parameter, " ")}`;
}

/** All digits: "0.5000000000000001 rad". */
export const exactText = (parameter: Parameter, value: number): string => minus(String(value)) + unitOf(parameter, " ");

/** Chooses one of all parameters; `none` stands for no one at all. */
export function parameterChoice(label: string, choose: (name: string) => void, none?: string): HTMLSelectElement {
  const all = PARAMETERS.map((one) => [one.name, `${shortLabelOf(one)} ${one.symbol.replace("_", "")}`] as const);
  return choice(label, none === undefined ? all : [["", none], ...all], choose);
}

/** What is chosen stands above the picture, and folded on a narrow screen, where the picture comes first. */
export const settings = (title: string, bars: readonly HTMLElement[]): HTMLElement =>
  element("details", { open: !isNarrow() }, element("summary", {}, title), ...bars);

/** A field of one number, or of several with semicolons between them: a comma may belong to a number. */
export class NumberField {
  readonly root: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly unit = element("span", { class: "unit" });
  private values: readonly number[] = [];
  /** What was printed last: as long as it stands there, the values are meant to their last digit. */
  private printed = "";
  private parameter: Partial<Parameter> = {};

  constructor(
    private readonly label: string,
    private readonly context: Context,
    /** Gives a sentence where the values are refused; what was typed stays then. */
    private readonly take: (values: number[]) => string | void,
    private readonly most = 1,
  ) {
    this.input = element("input", {
      type: "text", class: most > 1 ? "list" : "number", autocomplete: "off", spellcheck: "false",
      onchange: () => this.entered(), onfocus: () => this.focused(), onblur: () => this.print(),
    }); // prettier-ignore
    this.root = element("label", {}, `${label} `, this.input, this.unit);
  }

  /** Values of a parameter, or mere numbers. */
  show(values: readonly number[], parameter: Partial<Parameter> = {}): void {
    const typing = document.activeElement === this.input && this.input.value !== this.input.title;
    if (typing && String(values) === String(this.values)) return;
    Object.assign(this, { values, parameter });
    const { unit = "" } = parameter;
    this.unit.textContent = unit;
    this.input.setAttribute("aria-label", unit === "" ? this.label : `${this.label}, ${unit}`);
    this.input.removeAttribute("aria-invalid");
    this.print();
  }

  /** The numbers that stand in the field; `null` where these are none. */
  numbers(): number[] | null {
    const { unit, angle } = this.parameter;
    if (this.input.value === this.printed) return [...this.values];
    const texts = this.most === 1 ? [this.input.value] : this.input.value.split(/;|,\s/);
    const numbers = texts.map((text) => typed(text, unit, angle)).filter((value) => value !== null);
    return numbers.length === texts.length && numbers.length <= this.most ? numbers : null;
  }

  private entered(): void {
    const values = this.numbers();
    const wanted = this.most > 1 ? WORDS.varied.numbers : WORDS.varied.number;
    const text = this.input.value.slice(0, 24);
    const problem = values === null ? say(wanted, { most: this.most, text }) : this.take(values);
    if (problem === undefined) return;
    this.input.setAttribute("aria-invalid", "true");
    this.context.status(problem, "error");
  }

  private focused(): void {
    this.print();
    this.input.select();
  }

  /** All digits while somebody edits; what is wrong stays until something legal is typed. */
  private print(): void {
    if (this.input.hasAttribute("aria-invalid")) return;
    this.input.title = this.values.join("; ");
    const short = this.values.map((value) => written(value, this.parameter.angle)).join("; ");
    this.printed = document.activeElement === this.input ? this.input.title : short;
    this.input.value = this.printed;
  }
}
