/** The form of all parameters, and the numbers that follow from them. Which values are legal is for the module to say. */

import type { Change, State } from "./contract";
import { element, symbol } from "./elements";
import { abridged, prefixOf, shown, stepped, typed } from "./numbers";
import type { Range, Refusal, Summary, SystemParameters } from "./protocol";
import { amplitudeOf, contactPeriods } from "./state";
import type { ChangeOptions } from "./store";

type Propose = (change: Change, options: ChangeOptions) => void;

interface Parameter {
  /** The name in the state; refusals of the module use the same one. */
  readonly name: string;
  /** As in the paper; what follows an underscore is a subscript. */
  readonly symbol: string;
  readonly label: string;
  readonly unit: string;
  /** Sliders of positive quantities are logarithmic, two decades about the value with which they were set up. */
  readonly slider: "logarithmic" | ((state: State) => Range);
  /** True where people think in multiples of pi. */
  readonly angle?: boolean;
  /** `null` until the module has said it. */
  value(state: State, summary: Summary | null): number | null;
  change(value: number, state: State): Change;
  /** The legal range, where the module refuses not this quantity but one of those that follow from it. */
  readonly refusedAs?: { readonly quantities: readonly string[]; readonly range: string };
  /** The same in another unit, for orientation. */
  hint?(value: number, state: State): string;
}

/** The number with the fewest digits that `sets` the same parameter: what was typed, if that set it. */
function asTyped(exact: number, sets: (shorter: number) => boolean): number {
  for (let digits = 1; digits < 17; digits += 1) {
    const shorter = Number(exact.toPrecision(digits));
    if (sets(shorter)) return shorter;
  }
  return exact;
}

const contactTime = (periods: number, { angular_frequency }: Readonly<SystemParameters>): number =>
  (periods * 2 * Math.PI) / angular_frequency;

const inPi = (value: number): string => (value === 0 ? "" : `${shown(value / Math.PI, 4)} π`);

/** With the prefix of its unit, to four digits. */
function measured(value: number, unit: string): string {
  const prefix = prefixOf(Math.abs(value));
  return `${shown(value * prefix.factor, 4)} ${prefix.symbol}${unit}`;
}

const metres = (value: number): string => (value === 0 || Math.abs(value) >= 1e-2 ? "" : measured(value, "m"));
const hertz = (value: number): string => measured(value / (2 * Math.PI), "Hz");

type Words = [
  symbol: string,
  label: string,
  unit: string,
  Parameter["slider"],
  more?: Pick<Parameter, "angle" | "hint">,
];

const LOGARITHMIC = "logarithmic";

const parametersOf =
  <Part extends "system" | "start">(part: Part) =>
  (name: keyof State[Part] & string, ...[symbol, label, unit, slider, more]: Words): Parameter => ({
    ...{ name, symbol, label, unit, slider, ...more },
    value: (state) => state[part][name] as number,
    change: (value) => ({ [part]: { [name]: value } }),
  });
const ofSystem = parametersOf("system");
const ofStart = parametersOf("start");

/** The largest angular speed of the platform, or 1 rad/s where it does not turn: the scale of a slider. */
const twistSpeed = ({ system }: State): number => system.angular_frequency * system.twist_amplitude || 1;

/** What friction can do at most, or 1 rad/s²: the scale of the load's slider. */
const frictionScale = ({ system }: State): number =>
  (system.friction * system.contact_radius * system.preload_acceleration) / system.gyration_radius ** 2 || 1;

const GROUPS: Readonly<Record<string, readonly Parameter[]>> = {
  Platform: [
    {
      name: "axial_forcing",
      symbol: "Γ",
      label: "axial forcing, sets A",
      unit: "",
      slider: LOGARITHMIC,
      value: ({ system }, summary) =>
        summary && asTyped(summary.axial_forcing, (forcing) => amplitudeOf(forcing, system) === system.amplitude),
      // Gamma = A omega²/(pi g) is a definition (Sec. I); what comes of it is checked like any amplitude.
      change: (value, { system }) => ({ system: { amplitude: amplitudeOf(value, system) } }),
      // The range of the library's `Vibration::from_axial_forcing`.
      refusedAs: { quantities: ["amplitude", "peak_acceleration"], range: "[0, 3.18e7]" },
    },
    ofSystem("amplitude", "A", "amplitude", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("twist_amplitude", "Φ", "twist amplitude", "rad", LOGARITHMIC, {
      angle: true,
      hint: (_, { system }) => `ωΦ ${shown(system.angular_frequency * system.twist_amplitude, 4)} rad/s`,
    }),
    ofSystem("angular_frequency", "ω", "angular frequency", "rad/s", LOGARITHMIC, { hint: hertz }),
    ofSystem("phase_lag", "θ", "phase lag", "rad", () => [-Math.PI, Math.PI], { angle: true, hint: inPi }),
  ],
  Disk: [
    ofSystem("restitution", "ε", "coefficient of restitution", "", () => [0, 0.95]),
    {
      name: "contact_periods",
      symbol: "T_c",
      label: "contact time",
      unit: "2π/ω",
      slider: () => [0, 2],
      value: ({ system }) =>
        asTyped(contactPeriods(system), (periods) => contactTime(periods, system) === system.contact_time),
      change: (value, { system }) => ({ system: { contact_time: contactTime(value, system) } }),
      // The range of the library's `Compliance`.
      refusedAs: { quantities: ["contact.time", "contact time"], range: "[0, 1590]" },
      hint: (_, { system }) => (system.contact_time === 0 ? "rigid impacts" : measured(system.contact_time, "s")),
    },
    ofSystem("friction", "μ", "coefficient of friction", "", () => [0, 1]),
    ofSystem("contact_radius", "a_e", "contact radius", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("gyration_radius", "a_g", "radius of gyration", "m", LOGARITHMIC, { hint: metres }),
    ofSystem("preload_acceleration", "g", "preload acceleration", "m/s²", LOGARITHMIC),
    ofSystem("load_acceleration", "α_L", "deceleration by load", "rad/s²",
      (state) => [-frictionScale(state), frictionScale(state)], {
      hint: (value, { system, mass }) =>
        value === 0 ? "" : `${shown(value * mass * system.gyration_radius ** 2, 3)} N m`,
    }), // prettier-ignore
    {
      name: "mass",
      symbol: "m",
      label: "mass",
      unit: "kg",
      slider: LOGARITHMIC,
      value: (state) => state.mass,
      change: (value) => ({ mass: value }),
    },
  ],
  "Start, with an impact": [
    ofStart("impact_phase", "τ_imp", "phase", "rad", () => [0, 2 * Math.PI], { angle: true, hint: inPi }),
    ofStart("normalised_speed", "w_A", "impact speed", "πg/ω", () => [0, 5], {
      hint: (value, { system }) =>
        `${shown((value * Math.PI * system.preload_acceleration) / system.angular_frequency, 3)} m/s`,
    }),
    ofStart("angular_speed", "α̇", "angular speed", "rad/s", (state) => [-twistSpeed(state), twistSpeed(state)]),
  ],
};

export class Parameters {
  private readonly fields: Field[] = [];
  private readonly list = element("dl", { class: "readout" });
  private readonly sentence = element("p", { class: "bounces" });
  private summary: Summary | null = null;

  constructor(host: HTMLElement, propose: Propose) {
    const group = (title: string, ...parts: HTMLElement[]) =>
      element("details", { class: "group", open: true }, element("summary", {}, title), ...parts);
    for (const [title, parameters] of Object.entries(GROUPS)) {
      const fields = parameters.map((parameter) => new Field(parameter, propose));
      this.fields.push(...fields);
      host.append(group(title, ...fields.map((field) => field.element)));
    }
    host.append(group("What follows", this.list, this.sentence));
  }

  /** What follows from the state that is shown next, as the module gives it. */
  follow(summary: Summary): void {
    this.summary = summary;
    const { angular_forcing, rise_time, contact } = summary;
    const rows = [
      ["Γ_T", "angular forcing", angular_forcing === null ? "none, no friction" : shown(angular_forcing, 4)],
      ["Aω²/g", "peak acceleration", `${shown(summary.peak_acceleration, 4)} g`],
      ["2π/ω", "period", measured(summary.period, "s")],
      ["c", "stroke", measured(summary.stroke, "m")],
      ["t_r", "rise time", rise_time === null ? "none" : measured(rise_time, "s")],
      ["T_c", "over the period", contact?.[0][1] ?? "rigid impacts"],
      ["mg/kA", "indentation", contact?.[1][1] ?? "none"],
    ] as const;
    this.list.replaceChildren(
      ...rows.map(([sign, name, value]) =>
        element("div", {}, element("dt", {}, symbol(sign), ` ${name}`), element("dd", {}, value)),
      ),
    );
    this.sentence.textContent = summary.bounces
      ? "The platform falls away from a disk at rest on it: the disk bounces."
      : "The platform never falls away from a disk at rest on it.";
  }

  show(state: State, fresh: boolean): void {
    for (const field of this.fields) field.show(state, this.summary, fresh);
  }
}

const POSITIONS = 1000;
/** A logarithmic slider reaches from a tenth to ten times of its value. */
const REACH = 10;

/** One parameter of the form: symbol, slider, number and unit, and what is wrong with what was typed. */
class Field {
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
