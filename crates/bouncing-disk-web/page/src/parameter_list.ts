/** The parameters of the form: their symbols, units and sliders. Which values are legal is for the module to say. */

import type { Change, State } from "./contract";
import { shown } from "./numbers";
import type { Range, Summary, SystemParameters } from "./protocol";
import { amplitudeOf } from "./views/forcing";

export interface Parameter {
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

export interface Group {
  readonly title: string;
  readonly parameters: readonly Parameter[];
}

/** The forcing with the fewest digits that sets the amplitude of a system: what was typed, if that set it. */
function asTyped(axialForcing: number, system: Readonly<SystemParameters>): number {
  for (let digits = 1; digits < 17; digits += 1) {
    const shorter = Number(axialForcing.toPrecision(digits));
    if (amplitudeOf(shorter, system) === system.amplitude) return shorter;
  }
  return axialForcing;
}

const inPi = (value: number): string => (value === 0 ? "" : `${shown(value / Math.PI, 4)} π`);

function metres(value: number): string {
  const size = Math.abs(value);
  if (size === 0 || size >= 1e-2) return "";
  if (size >= 1e-4) return `${shown(value * 1e3, 4)} mm`;
  return size >= 1e-7 ? `${shown(value * 1e6, 4)} µm` : `${shown(value * 1e9, 4)} nm`;
}

function hertz(value: number): string {
  const frequency = value / (2 * Math.PI);
  return frequency >= 1e3 ? `${shown(frequency / 1e3, 4)} kHz` : `${shown(frequency, 4)} Hz`;
}

type OfSystem = Omit<Parameter, "name" | "value" | "change">;

const ofSystem = (name: keyof SystemParameters, rest: OfSystem): Parameter => ({
  name,
  value: (state) => state.system[name],
  change: (value) => ({ system: { [name]: value } }),
  ...rest,
});

type OfStart = Omit<Parameter, "value" | "change" | "name">;

const ofStart = (name: keyof State["start"], rest: OfStart): Parameter => ({
  name,
  value: (state) => state.start[name],
  change: (value) => ({ start: { [name]: value } }),
  ...rest,
});

/** The largest angular speed of the platform, or 1 rad/s where it does not turn: the scale of a slider. */
const twistSpeed = ({ system }: State): number => system.angular_frequency * system.twist_amplitude || 1;

/** What friction can do at most, or 1 rad/s²: the scale of the load's slider. */
const frictionScale = ({ system }: State): number =>
  (system.friction * system.contact_radius * system.preload_acceleration) / system.gyration_radius ** 2 || 1;

export const GROUPS: readonly Group[] = [
  {
    title: "Platform",
    parameters: [
      {
        name: "axial_forcing",
        symbol: "Γ",
        label: "axial forcing, sets A",
        unit: "",
        slider: "logarithmic",
        value: ({ system }, summary) => (summary === null ? null : asTyped(summary.axial_forcing, system)),
        // Gamma = A omega²/(pi g) is a definition (Sec. I); what comes of it is checked like any amplitude.
        change: (value, { system }) => ({ system: { amplitude: amplitudeOf(value, system) } }),
        // The range of the library's `Vibration::from_axial_forcing`.
        refusedAs: { quantities: ["amplitude", "peak_acceleration"], range: "[0, 3.18e7]" },
      },
      ofSystem("amplitude", { symbol: "A", label: "amplitude", unit: "m", slider: "logarithmic", hint: metres }),
      ofSystem("twist_amplitude", {
        symbol: "Φ", label: "twist amplitude", unit: "rad", slider: "logarithmic", angle: true,
        hint: (_value, state) => `ωΦ ${shown(state.system.angular_frequency * state.system.twist_amplitude, 4)} rad/s`,
      }), // prettier-ignore
      ofSystem("angular_frequency", {
        symbol: "ω", label: "angular frequency", unit: "rad/s", slider: "logarithmic", hint: hertz,
      }), // prettier-ignore
      ofSystem("phase_lag", {
        symbol: "θ", label: "phase lag", unit: "rad", slider: () => [-Math.PI, Math.PI], angle: true, hint: inPi,
      }), // prettier-ignore
    ],
  },
  {
    title: "Disk",
    parameters: [
      ofSystem("restitution", {
        symbol: "ε", label: "coefficient of restitution", unit: "", slider: () => [0, 0.95],
      }), // prettier-ignore
      ofSystem("friction", { symbol: "μ", label: "coefficient of friction", unit: "", slider: () => [0, 1] }),
      ofSystem("contact_radius", {
        symbol: "a_e", label: "contact radius", unit: "m", slider: "logarithmic", hint: metres,
      }), // prettier-ignore
      ofSystem("gyration_radius", {
        symbol: "a_g", label: "radius of gyration", unit: "m", slider: "logarithmic", hint: metres,
      }), // prettier-ignore
      ofSystem("preload_acceleration", {
        symbol: "g", label: "preload acceleration", unit: "m/s²", slider: "logarithmic",
      }), // prettier-ignore
      ofSystem("load_acceleration", {
        symbol: "α_L",
        label: "deceleration by load",
        unit: "rad/s²",
        slider: (state) => [-frictionScale(state), frictionScale(state)],
        hint: (value, { system, mass }) =>
          value === 0 ? "" : `${shown(value * mass * system.gyration_radius ** 2, 3)} N m`,
      }),
      {
        name: "mass",
        symbol: "m",
        label: "mass",
        unit: "kg",
        slider: "logarithmic",
        value: (state) => state.mass,
        change: (value) => ({ mass: value }),
      },
    ],
  },
  {
    title: "Start, with an impact",
    parameters: [
      ofStart("impact_phase", {
        symbol: "τ_imp", label: "phase", unit: "rad", slider: () => [0, 2 * Math.PI], angle: true, hint: inPi,
      }), // prettier-ignore
      ofStart("normalised_speed", {
        symbol: "w_A", label: "impact speed", unit: "πg/ω", slider: () => [0, 5],
        hint: (value, { system }) =>
          `${shown((value * Math.PI * system.preload_acceleration) / system.angular_frequency, 3)} m/s`,
      }), // prettier-ignore
      ofStart("angular_speed", {
        symbol: "α̇", label: "angular speed", unit: "rad/s", slider: (state) => [-twistSpeed(state), twistSpeed(state)],
      }), // prettier-ignore
    ],
  },
];
