/** The parameters that a scan or a comparison varies, and the fields that choose one and its values. */

import type { Change, Context, State } from "../contract";
import { marked } from "../drawing/pen";
import { button, choice, div, element, isCrowded, labelled } from "../elements";
import { NumberField } from "../fields";
import { PARAMETERS, shortLabelOf, type Parameter } from "../form";
import { minus, written } from "../numbers";
import type { Range } from "../protocol";
import { changed } from "../state";
import { WORDS } from "../words";

/** A parameter by its name, which the address has checked. */
export const varied = (name: string): Parameter =>
  PARAMETERS.find((one) => one.name === name) ?? (PARAMETERS[0] as Parameter);

/** A state in which the library sets a parameter to another value. */
export const withValue = (parameter: Parameter, value: number, state: State): State =>
  changed(state, parameter.change(value));

/** Some range about a value that shows what a parameter does. */
export const rangeAbout = (value: number, { slider }: Parameter, state: State): Range =>
  typeof slider === "function" ? slider(state) : [value / 2, value * 2 || 1];

const unitOf = ({ unit }: Parameter, before: string, after = ""): string => (unit === "" ? "" : before + unit + after);

/** The label of an axis: "amplitude angle *φ*_{L} (rad)". */
export const axisOf = (parameter: Parameter): string =>
  `${shortLabelOf(parameter)} ${marked(parameter.symbol)}${unitOf(parameter, " (", ")")}`;

/** "θ = −0.25π" and "φ_L = 0.55 rad" */
export function valueText(parameter: Parameter, value: number): string {
  const text = minus(written(value, parameter.angle));
  const bare = parameter.angle === true && /^0$|π$/.test(text);
  return `${parameter.symbol} = ${text}${bare ? "" : unitOf(parameter, " ")}`;
}

/** All digits: "0.5000000000000001 rad". */
export const exactText = (parameter: Parameter, value: number): string => minus(String(value)) + unitOf(parameter, " ");

/** Chooses one of all parameters; `none` stands for no one at all. */
export function parameterChoice(label: string, choose: (name: string) => void, none?: string) {
  const all = PARAMETERS.map((one) => [one.name, `${shortLabelOf(one)} ${one.symbol.replace("_", "")}`] as const);
  return choice<string>(label, { ...(none !== undefined && { "": none }), ...Object.fromEntries(all) }, choose);
}

/** What is chosen stands above the picture, and folded where the picture would not be seen with it. */
export function settings(
  title: string,
  { change }: Context,
  ready: readonly { label: string; change: Change }[],
  bars: readonly HTMLElement[],
): HTMLElement {
  const buttons = ready.map((one) => button(one.label, () => change({ motor: { stator: null }, ...one.change })));
  const first = div("bar", element("span", {}, WORDS.varied.ready), ...buttons);
  return element("details", { class: "settings", open: !isCrowded() }, element("summary", {}, title), first, ...bars);
}

/** A field in a bar, with its label and unit; what is wrong stands in the line below the view. */
export class LabelledField extends NumberField {
  readonly root: HTMLElement;
  private readonly unit = element("span", { class: "unit" });

  constructor(
    private readonly label: string,
    context: Context,
    take: (values: number[]) => string | void,
    most = 1,
  ) {
    const tell = (problem: string | null) => problem !== null && context.status(problem, "error");
    super({ attributes: { class: most > 1 ? "list" : "number" }, most, take, tell });
    this.root = labelled(label, this.input, this.unit);
  }

  /** Values of a parameter, or mere numbers. */
  override show(values: readonly number[], parameter: Partial<Parameter> & { exact?: boolean } = {}): void {
    super.show(values, parameter);
    const { unit = "" } = parameter;
    this.unit.textContent = unit;
    this.input.setAttribute("aria-label", unit === "" ? this.label : `${this.label}, ${unit}`);
  }
}
