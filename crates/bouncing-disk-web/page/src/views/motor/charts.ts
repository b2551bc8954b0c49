/** The charts of a motor, from what is known so far, and its files. */

import type { Offer } from "../../contract";
import { clamp, extent, padded } from "../../drawing/axes";
import { chartOffers, type Chart, type Curve, type Mark } from "../../drawing/chart";
import { ONE_COLUMN, rowsOf, tableOffers, type Basis } from "../../drawing/files";
import { prefixOf } from "../../numbers";
import { TRANSIENT_COLUMNS, type MotorSheet, type Range, type StallJson } from "../../protocol";
import { say, WORDS } from "../../words";
import { membersOf, OPERATION_COLUMNS, SEED, type Operation, type Transient } from "./requests";

const { charts: TEXTS, files: FILES, titles: TITLES } = WORDS.motor;

const finite = (value: number): number => (Number.isFinite(value) ? value : 0);

/** The run-up, and beside it the steady speed under the same load, as soon as it is known. */
export function transientChart({ json, numbers }: Transient, own: Operation | null): Chart {
  const rows = [...rowsOf(numbers, TRANSIENT_COLUMNS.length)];
  const column = (place: number) => rows.map((row) => row[place] ?? NaN);
  const [times, speed, error] = [column(0), column(1), column(2)];
  const last = times[json.points - 1] ?? 1;
  const time = prefixOf(last);
  const edges = [-2, 2].flatMap((errors) => speed.map((value, row) => value + errors * (error[row] ?? 0)));
  const curves: Curve[] = [{ label: TEXTS.run_up_curve, y: speed, error, colour: "--curve-speed" }];
  if (own?.status === 0) {
    edges.push(...[-2, 2].map((errors) => own.speed + errors * finite(own.speed_error)));
    const y = speed.map(() => own.speed);
    const same = speed.map(() => own.speed_error);
    curves.push({ label: TEXTS.steady, y, error: same, colour: "--curve-power", dash: [6, 3] });
  }
  const constant = json.rise?.form === "exponential" ? json.rise.constant.value : Infinity;
  const line = { x: constant * time.factor, label: TEXTS.constant, colour: "--picture-muted" };
  return {
    title: TEXTS.run_up,
    x: { label: say(TEXTS.time, { prefix: time.symbol }), range: [0, last * time.factor] },
    y: { label: TEXTS.mean_speed, range: padded(extent([...edges, 0]) ?? [0, 1]) },
    at: times.map((value) => value * time.factor),
    curves,
    lines: constant > last ? [] : [line],
  };
}

interface Kind {
  readonly title: string;
  /** Of the axis. */
  readonly label: string;
  readonly curves: readonly (Pick<Curve, "label" | "colour" | "dash"> & { readonly name: Name })[];
  /** The factor of the numbers; without it they have a prefix of their unit. */
  readonly factor?: number;
}

type Name = "speed" | "mechanical_power" | "input_power" | "efficiency";

const KINDS: readonly Kind[] = [
  {
    ...{ title: TEXTS.speed, label: TEXTS.speed_axis, factor: 1 },
    curves: [{ name: "speed", label: TEXTS.speed_curve, colour: "--curve-speed" }],
  },
  {
    ...{ title: TEXTS.power, label: TEXTS.power_axis },
    curves: [
      { name: "mechanical_power", label: TEXTS.to_load, colour: "--curve-power" },
      { name: "input_power", label: TEXTS.from_stator, colour: "--curve-input", dash: [6, 3] },
    ],
  },
  {
    ...{ title: TEXTS.efficiency, label: TEXTS.efficiency_axis, factor: 100 },
    curves: [{ name: "efficiency", label: TEXTS.efficiency_curve, colour: "--curve-efficiency" }],
  },
];

/** Speed, power and efficiency against load, with bands of two standard errors; nothing where there is no load. */
export function loadCharts(
  operations: readonly Operation[],
  loads: Range,
  largestTorque: number,
  stall: StallJson | null,
): Chart[] {
  if (operations.length === 0) return [];
  const torque = prefixOf(Math.max(Math.abs(loads[0]), Math.abs(loads[1])));
  const shown = [...operations].sort((one, two) => one.load_torque - two.load_torque);
  const span = padded([loads[0] * torque.factor, loads[1] * torque.factor], 0.03);
  const x = { label: say(TEXTS.load, { prefix: torque.symbol }), range: span };
  const at = shown.map(({ load_torque }) => load_torque * torque.factor);
  const beyond = largestTorque * torque.factor;
  const shade = { range: [beyond, span[1]] as const, label: TEXTS.runaway };
  const stop = (stall?.torque ?? NaN) * torque.factor;
  const error = finite(stall?.torque_error ?? 0) * torque.factor;
  const lines = Number.isNaN(stop) ? [] : [{ x: stop, error, label: TEXTS.stall, colour: "--stall" }];
  return KINDS.map(({ title, label, curves, factor }) => {
    const values = shown.flatMap((row) => curves.map(({ name }) => row[name]));
    const greatest = Math.max(...values.filter(Number.isFinite).map(Math.abs), 0);
    const prefix = factor === undefined ? prefixOf(greatest) : { factor, symbol: "" };
    const column = (name: keyof Operation & (Name | `${Name}_error`)) => shown.map((row) => row[name] * prefix.factor);
    // A point that is not settled may have any error; it must not flatten the others.
    const most = 1.6 * greatest * prefix.factor;
    const edges = curves.flatMap(({ name }) => {
      const errors = column(`${name}_error`).map(finite);
      return column(name).flatMap((value, row) =>
        [-2, 2].map((times) => clamp(value + times * (errors[row] ?? 0), -most, most)),
      );
    });
    const range = extent([0, ...edges]) ?? [0, 1];
    const [first] = curves as [Kind["curves"][number]];
    const marks = shown.flatMap((row, index): Mark[] => {
      const place = { x: at[index] ?? NaN, y: finite(row[first.name] * prefix.factor) };
      if (row.status === 2) return [{ ...place, y: 0, form: "cross", colour: "--warning" }];
      return row.status === 0 ? [] : [{ ...place, form: "circle", colour: first.colour }];
    });
    return {
      title,
      x,
      // Without any value but zero there is no scale to take from the numbers.
      y: { label: say(label, { prefix: prefix.symbol }), range: padded(greatest > 0 ? range : [0, 1], 0.08) },
      at,
      curves: curves.map(({ name, ...curve }) => {
        return { ...curve, y: column(name), error: column(`${name}_error`), points: true };
      }),
      marks,
      lines,
      ...(span[1] > beyond * 1.001 && { shade }),
    };
  });
}

const LOAD_UNITS = [
  "load_torque_N_m", "speed_rad_per_s", "speed_error_rad_per_s", "mechanical_power_W", "mechanical_power_error_W",
  "input_power_W", "input_power_error_W", "efficiency", "efficiency_error", "status",
]; // prettier-ignore
const STATUS = ["steady", "unsettled", "runaway"] as const;

interface MotorParts {
  readonly sheet: MotorSheet;
  readonly text: string;
  readonly transient: Transient | null;
  readonly operations: readonly Operation[];
  readonly runUp: Chart | null;
  readonly curves: readonly Chart[];
  readonly basis: Basis;
}

export function motorOffers({ sheet, text, transient, operations, runUp, curves, basis }: MotorParts): Offer[] {
  const written = async () => new Blob([text], { type: "application/json" });
  const offers: Offer[] = [{ name: FILES.sheet, kind: "json", make: written }];
  if (transient !== null) {
    const parameters = { sheet, members: membersOf(sheet), seed: SEED };
    const columns = ["time_s", "speed_rad_per_s", "speed_error_rad_per_s"];
    const rows = () => rowsOf(transient.numbers, TRANSIENT_COLUMNS.length);
    offers.push(...tableOffers({ name: FILES.run_up, parameters, columns, rows }));
  }
  if (operations.length > 0) {
    const cell = (row: Operation, name: (typeof OPERATION_COLUMNS)[number]) =>
      name === "status" ? (STATUS[row.status] ?? "") : row[name];
    const rows = () =>
      operations.map((row) => [...OPERATION_COLUMNS.map((name) => cell(row, name)), row.wanted, row.shortfall ?? ""]);
    const columns = [...LOAD_UNITS, "relative_error_wanted", "shortfall"];
    offers.push(...tableOffers({ name: FILES.curve, parameters: { sheet, seed: SEED }, columns, rows }));
  }
  const each = ONE_COLUMN * 0.62;
  if (runUp !== null) offers.push(...chartOffers(FILES.run_up, TITLES.run_up, [runUp], each, basis));
  if (curves.length > 0) offers.push(...chartOffers(FILES.curve, TITLES.curve, curves, each, basis));
  return offers;
}
