/** The charts of a motor, from what is known so far, and its files. */

import type { Offer } from "../../contract";
import { padded, prefixed } from "../../drawing/axes";
import { chartOffers, spanOf, type Chart, type Curve, type Mark, type Stretch } from "../../drawing/chart";
import { ONE_COLUMN, rowsOf, tableOffers, type Basis } from "../../drawing/files";
import { TRANSIENT_COLUMNS, type Range, type StallJson } from "../../protocol";
import { WORDS } from "../../words";
import { ESTIMATES, membersOf, SEED, type Estimated, type Known, type Operation, type Transient } from "./requests";

const { charts: TEXTS, files: FILES, titles: TITLES } = WORDS.motor;

/** The time constant of a run-up that has none. */
const NONE = { value: Infinity, low: NaN, high: NaN };

const finite = (value: number): number => (Number.isFinite(value) ? value : 0);

/** The run-up, and beside it the steady speed under the same load, as soon as it is known. */
export function transientChart({ json, numbers }: Transient, own: Operation | null): Chart {
  const rows = [...rowsOf(numbers, TRANSIENT_COLUMNS.length)];
  const column = (place: number) => rows.map((row) => row[place] ?? NaN);
  const [at, y, error] = [column(0), column(1), column(2)];
  const last = at.at(-1) ?? 1;
  const curves: Curve[] = [{ label: TEXTS.run_up_curve, y, error, colour: "--curve-speed" }];
  if (own?.status === 0) {
    const steady = { y: y.map(() => own.speed), error: y.map(() => own.speed_error) };
    curves.push({ label: TEXTS.steady, ...steady, colour: "--curve-power", dash: [6, 3] });
  }
  const { value: constant, low, high } = json.rise?.form === "exponential" ? json.rise.constant : NONE;
  const range: Range = [low, high];
  return {
    title: TEXTS.run_up,
    x: prefixed(TEXTS.time, [0, last]),
    y: { label: TEXTS.mean_speed, range: spanOf(curves, [0]) },
    at,
    curves,
    stretches: constant > last ? [] : [{ at: constant, range, label: TEXTS.constant, colour: "--picture-muted" }],
  };
}

interface Kind {
  readonly title: string;
  /** Of the axis. */
  readonly label: string;
  readonly curves: readonly (Pick<Curve, "label" | "colour" | "dash"> & { readonly name: Estimated })[];
  /** The factor of the numbers; without it they have a prefix of their unit. */
  readonly factor?: number;
}

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
export function loadCharts(operations: readonly Operation[], largest: number, stall: StallJson | null): Chart[] {
  if (operations.length === 0) return [];
  const shown = [...operations].sort((one, two) => one.load_torque - two.load_torque);
  const x = prefixed(TEXTS.load, padded([0, largest], 0.03));
  const [, end] = x.range;
  const at = shown.map(({ load_torque }) => load_torque);
  const { torque: stop = null, torque_error = 0 } = stall ?? {};
  const by = 2 * finite(torque_error ?? 0);
  const stretches: Stretch[] = [{ range: [largest, end], label: TEXTS.runaway, colour: "--runaway" }];
  if (stop !== null) stretches.push({ at: stop, range: [stop - by, stop + by], label: TEXTS.stall, colour: "--stall" });
  return KINDS.map(({ title, label, curves: described, factor }) => {
    const curves = described.map(({ name, ...own }) => {
      const [y, error] = [shown.map((row) => row[name]), shown.map((row) => row[`${name}_error`])];
      return { ...own, y, error, points: true };
    });
    const [{ y: values = [], colour = "" } = {}] = curves;
    const marks = shown.flatMap(({ status }, index): Mark[] => {
      const x = at[index] ?? NaN;
      if (status === 2) return [{ x, y: 0, form: "cross", colour: "--warning" }];
      return status === 0 ? [] : [{ x, y: finite(values[index] ?? NaN), form: "circle", colour }];
    });
    const range = spanOf(curves, [0], 0.08);
    const y = factor === undefined ? prefixed(label, range) : { label, range, factor };
    return { title, x, y, at, curves, marks, stretches };
  });
}

const LOAD_COLUMNS = [
  "load_torque_N_m", "speed_rad_per_s", "speed_error_rad_per_s", "mechanical_power_W", "mechanical_power_error_W",
  "input_power_W", "input_power_error_W", "efficiency", "efficiency_error", "status",
  "relative_error_wanted", "shortfall",
]; // prettier-ignore
const STATUS = ["steady", "unsettled", "runaway"] as const;

export function motorOffers(known: Known, runUp: Chart | null, curves: readonly Chart[], basis: Basis): Offer[] {
  const { sheet, text, transient, operations } = known;
  const written = async () => new Blob([text], { type: "application/json" });
  const offers: Offer[] = [{ name: FILES.sheet, kind: "json", make: written }];
  if (transient !== null) {
    const parameters = { sheet, members: membersOf(sheet), seed: SEED };
    const columns = ["time_s", "speed_rad_per_s", "speed_error_rad_per_s"];
    const rows = () => rowsOf(transient.numbers, TRANSIENT_COLUMNS.length);
    offers.push(...tableOffers({ name: FILES.run_up, parameters, columns, rows }));
  }
  if (operations.length > 0) {
    const rows = () =>
      operations.map((row) => {
        const estimates = ESTIMATES.flatMap((name) => [row[name], row[`${name}_error`]]);
        return [row.load_torque, ...estimates, STATUS[row.status] ?? "", row.wanted, row.shortfall ?? ""];
      });
    offers.push(...tableOffers({ name: FILES.curve, parameters: { sheet, seed: SEED }, columns: LOAD_COLUMNS, rows }));
  }
  const each = ONE_COLUMN * 0.62;
  if (runUp !== null) offers.push(...chartOffers(FILES.run_up, TITLES.run_up, [runUp], each, basis));
  if (curves.length > 0) offers.push(...chartOffers(FILES.curve, TITLES.curve, curves, each, basis));
  return offers;
}
