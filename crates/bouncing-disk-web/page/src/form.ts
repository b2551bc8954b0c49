/** The form of all parameters, and the numbers that follow from them. Which values are legal is for the module to say. */

import type { Change, State } from "./contract";
import { element, Facts, isNarrow, symbol } from "./elements";
import { NumberField } from "./fields";
import { quantity, shown } from "./numbers";
import type { Range, Refusal, Summary } from "./protocol";
import type { ChangeOptions } from "./store";
import { say, WORDS } from "./words";

type Propose = (change: Change, options: ChangeOptions) => void;

type Name = keyof typeof WORDS.form.labels;

export interface Parameter {
  /** The name in the state; `words.json` has its label. */
  readonly name: Name;
  /** As in the paper; what follows an underscore is a subscript. */
  readonly symbol: string;
  readonly unit: string;
  /** Logarithmic sliders reach two decades about the value with which they were set up. */
  readonly slider: typeof LOGARITHMIC | ((state: State) => Range);
  /** True where people think in multiples of pi. */
  readonly angle?: boolean;
  /** `null` until the module has said it. */
  value(state: State): number | null;
  change(value: number): Change;
  /** The name in the requests of the module and in its refusals, where that is another one. */
  readonly asked?: string;
  /** The same in another unit, for orientation. */
  hint?(value: number, state: State): string;
}

const LOGARITHMIC = "logarithmic";

/** Without the last digit, which rounding makes: what was typed, if that set it. */
const asTyped = (exact: number): number => Number(exact.toPrecision(15));

const degrees = (value: number): string => (value === 0 ? "" : `${shown((value * 180) / Math.PI, 4)}°`);

const metres = (value: number): string => (value === 0 || Math.abs(value) >= 1e-2 ? "" : quantity(value, "m", 4));
const hertz = (value: number): string => quantity(value / (2 * Math.PI), "Hz", 4);

type Words = [symbol: string, unit: string, Parameter["slider"], more?: Pick<Parameter, "angle" | "hint">];

/** What the library sets, so that what it means for others is its business. */
const ofSystem = (name: Name & keyof Summary["system"], ...[symbol, unit, slider, more]: Words): Parameter => ({
  ...{ name, symbol, unit, slider, ...more },
  value: ({ system }) => system[name],
  change: (value) => ({ system: { set: [[name, value]] } }),
});

/** What follows from the parameters. */
const following = (name: Name, asked: "axial_forcing" | "stroke" | "amplitude_angle" | "contact_periods", ...[symbol, unit, slider, more]: Words): Parameter => ({
  ...{ name, asked, symbol, unit, slider, ...more },
  value: ({ summary }) => summary && (more?.angle ? summary[asked] : asTyped(summary[asked])),
  change: (value) => ({ system: { set: [[asked, value]] } }),
});

const ofStart = (name: Name & keyof State["start"], ...[symbol, unit, slider, more]: Words): Parameter => ({
  ...{ name, symbol, unit, slider, ...more },
  value: ({ start }) => start[name],
  change: (value) => ({ start: { [name]: value } }),
});

/** The scale of a slider: what a motion reaches at most, or 1 where it reaches nothing. */
const about = (most: (summary: Summary) => number) => ({ summary }: State): Range => {
  const scale = (summary && most(summary)) || 1;
  return [-scale, scale];
};

/** Forcings between which a disk bounces once, twice, and so on up to chaos. */
const CASCADE: Range = [0.25, 0.75];

const FORCING = following("axial_forcing", "axial_forcing", "Γ", "", ({ summary }) => {
  const forcing = summary?.axial_forcing ?? 0;
  return forcing >= CASCADE[0] && forcing <= CASCADE[1] ? CASCADE : [0, 2 * forcing || 1];
});

/** What a newcomer changes first stands open; the rest is folded. */
const GROUPS: Readonly<Record<keyof typeof WORDS.form.groups, readonly Parameter[]>> = {
  essentials: [FORCING, ofSystem("restitution", "ε", "", () => [0, 0.95]), ofSystem("friction", "μ", "", () => [0, 1])],
  platform: [
    ofSystem("amplitude", "A", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("twist_amplitude", "Φ", "rad", LOGARITHMIC, {
      angle: true,
      hint: (_, { summary }) => `ωΦ ${shown(summary?.twist_speed ?? NaN, 4)} rad/s`,
    }),
    following("stroke", "stroke", "c", "m", LOGARITHMIC, { hint: metres }),
    following("amplitude_angle", "amplitude_angle", "φ_L", "rad", () => [0, Math.PI / 2], { angle: true, hint: degrees }),
    ofSystem("angular_frequency", "ω", "rad/s", LOGARITHMIC, { hint: hertz }),
    ofSystem("phase_lag", "θ", "rad", () => [-Math.PI, Math.PI], { angle: true, hint: degrees }),
  ],
  disk: [
    following("contact_time", "contact_periods", "T_c", "2π/ω", () => [0, 2], {
      hint: (_, { system }) => (system.contact_time === 0 ? WORDS.form.rigid : quantity(system.contact_time, "s", 4)),
    }),
    ofSystem("contact_radius", "a_e", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("gyration_radius", "a_g", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("preload_acceleration", "g", "m/s²", LOGARITHMIC),
    ofSystem("load_acceleration", "α_L", "rad/s²", about(({ friction_acceleration }) => friction_acceleration), {
      hint: (value, { summary }) => (value === 0 ? "" : `${shown(summary?.load_torque ?? NaN, 3)} N m`),
    }),
    {
      ...{ name: "mass", symbol: "m", unit: "kg", slider: LOGARITHMIC },
      value: ({ mass }) => mass,
      change: (mass) => ({ mass }),
    },
  ],
  start: [
    ofStart("impact_phase", "τ_imp", "rad", () => [0, 2 * Math.PI], { angle: true, hint: degrees }),
    ofStart("normalised_speed", "w_A", "πg/ω", () => [0, 5], {
      hint: (value, { summary }) => `${shown(value * (summary?.speed_unit ?? NaN), 3)} m/s`,
    }),
    ofStart("angular_speed", "α̇", "rad/s", about(({ twist_speed }) => twist_speed)),
  ],
};

/** In the order of the form. */
export const PARAMETERS: readonly Parameter[] = Object.values(GROUPS).flat();

export const labelOf = ({ name }: Parameter): string => WORDS.form.labels[name];
/** "axial forcing", without what it sets. */
export const shortLabelOf = (parameter: Parameter): string => labelOf(parameter).split(",")[0] ?? "";

export class Parameters {
  private readonly fields: Field[] = [];
  private readonly facts = new Facts(WORDS.form.readout.facts, WORDS.form.follows);
  private readonly sentence = element("p", { class: "bounces" });

  constructor(host: HTMLElement, propose: Propose) {
    const group = (name: string, title: string, ...parts: HTMLElement[]) =>
      element("details", { class: `group ${name}`, open: name === "essentials" && !isNarrow() }, element("summary", {}, title), ...parts);
    for (const [name, parameters] of Object.entries(GROUPS)) {
      const fields = parameters.map((parameter) => new Field(parameter, propose));
      this.fields.push(...fields);
      host.append(group(name, WORDS.form.groups[name as keyof typeof GROUPS], ...fields.map((field) => field.element)));
    }
    host.append(group("follows", WORDS.form.follows, this.facts.root, this.sentence));
  }

  private follow(summary: Summary): void {
    const { angular_forcing, rise_time, contact } = summary;
    const { readout } = WORDS.form;
    this.facts.set({
      angular_forcing: angular_forcing === null ? readout.no_friction : shown(angular_forcing, 4),
      peak_acceleration: `${shown(summary.peak_acceleration, 4)} g`,
      period: quantity(summary.period, "s", 4),
      rise_time: rise_time === null ? readout.none : quantity(rise_time, "s", 4),
      contact: contact?.[0][1] ?? WORDS.form.rigid,
      indentation: contact?.[1][1] ?? readout.none,
    });
    this.sentence.textContent = summary.bounces ? readout.bounces : readout.never_bounces;
  }

  show(state: State, fresh: boolean): void {
    if (state.summary !== null) this.follow(state.summary);
    for (const field of this.fields) field.show(state, fresh);
  }
}

const POSITIONS = 1000;
/** A logarithmic slider reaches from a tenth to ten times of its value. */
const REACH = 10;

/** One parameter of the form: symbol, slider, number and unit, and what is wrong with what was typed. */
class Field {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly field: NumberField;
  private readonly hint = element("span", { class: "hint" });
  private readonly error: HTMLElement;
  private readonly doubt = element("p", { class: "caution", role: "status", hidden: true });
  private readonly logarithmic: boolean;
  private state: State | null = null;
  private range: Range = [0, 1];
  /** Typed in metres, which are few people's unit of a hand or a motor. */
  private doubted = NaN;

  constructor(
    private readonly parameter: Parameter,
    private readonly propose: Propose,
  ) {
    const { name, unit, slider } = parameter;
    const label = labelOf(parameter);
    this.logarithmic = slider === LOGARITHMIC;
    this.slider = element("input", {
      type: "range", min: 0, max: POSITIONS, step: 1, oninput: () => this.slid(false), onchange: () => this.slid(true),
      "aria-label": say(WORDS.form.slider, { name: `${label}${unit ? `, ${unit}` : ""}` }),
    }); // prettier-ignore
    this.field = new NumberField({
      attributes: { id: `field-${name}`, inputmode: "decimal", "aria-describedby": `error-${name}` },
      take: ([value = NaN]) => this.ask(value, true, true),
      tell: (problem) => {
        this.error.textContent = problem;
        this.error.hidden = problem === null;
      },
    });
    this.error = element("p", { class: "error", id: `error-${name}`, role: "alert", hidden: true });
    const words = [symbol(parameter.symbol), element("span", { class: "label" }, label)];
    this.element = element(
      "div",
      { class: "field", "data-name": name },
      element("label", { for: `field-${name}` }, ...words),
      ...[this.hint, this.slider, this.field.input, element("span", { class: "unit" }, unit), this.error, this.doubt],
    );
  }

  /** Shows the value of a state; `fresh` if the state comes from elsewhere, and what was typed is of no interest. */
  show(state: State, fresh: boolean): void {
    this.state = state;
    const value = this.parameter.value(state);
    if (value === null) return;
    this.field.show([value], this.parameter, fresh);
    if (value !== this.doubted) this.doubt.hidden = true;
    if (fresh || value < this.range[0] || value > this.range[1]) this.range = this.suitable(value, state);
    this.slider.value = String(this.position(value));
    this.slider.setAttribute("aria-valuetext", `${shown(value)} ${this.parameter.unit}`);
    this.hint.textContent = this.parameter.hint?.(value, state) ?? "";
  }

  private suitable(value: number, state: State): Range {
    const { slider } = this.parameter;
    const size = value > 0 ? value : 1;
    if (slider === LOGARITHMIC) return [size / REACH, size * REACH];
    const [low, high] = slider(state);
    return [Math.min(low, value), Math.max(high, value)];
  }

  private position(value: number): number {
    const [low, high] = this.range;
    const share = this.logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return Math.round(POSITIONS * Math.min(1, Math.max(0, share)));
  }

  private slid(settled: boolean): void {
    const [low, high] = this.range;
    const share = Number(this.slider.value) / POSITIONS;
    const exact = this.logarithmic ? low * (high / low) ** share : low + share * (high - low);
    // No more digits than a position means, so that the number can be read, typed and cited.
    const digit = 10 ** (this.logarithmic ? Math.floor(Math.log10(exact)) - 3 : Math.floor(Math.log10(high - low) - 3));
    this.ask(Number((Math.round(exact / digit) * digit).toPrecision(12)), settled);
  }

  private ask(value: number, settled: boolean, isTyped = false): void {
    if (this.state === null) return;
    this.doubted = isTyped && this.parameter.unit === "m" && value >= 1 ? value : NaN;
    this.propose(this.parameter.change(value), {
      settled,
      refused: (refusal) => this.field.complain(this.words(refusal, value)),
      taken: () => {
        this.field.complain(null);
        this.field.print();
        this.doubt.hidden = Number.isNaN(this.doubted);
        this.doubt.textContent = say(WORDS.fields.doubt, { value });
      },
    });
  }

  private words({ quantity, message, range: own }: Refusal, value: number): string {
    const { name, asked = name } = this.parameter;
    const range = quantity === asked ? own : null;
    if (range === null) return `${message}${/[.!]$/.test(message) ? "" : "."}`;
    return say(WORDS.form.refused, { value: shown(value), name: shortLabelOf(this.parameter), range: legal(range) });
  }
}
/** A range of the library in words: "[0, inf)" is "0 or more". */
function legal(range: string): string {
  const [whole = "", from = "", low = "", high = "", to = ""] = /^([[(])(.+?), (.+?)([\])])/.exec(range) ?? [];
  const texts: Readonly<Record<string, string>> = WORDS.form.ranges;
  return say(texts[from + (high === "inf" ? high : to)] ?? whole, { low, high }) + range.slice(whole.length);
}
