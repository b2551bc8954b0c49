/** The charts of a motor, from what is known so far, and its files. */

import type { Offer } from "../../contract";
import { padded, prefixed } from "../../drawing/axes";
import { chartOffers, spanOf, type Chart, type Curve, type Mark, type Stretch } from "../../drawing/chart";
import { ONE_COLUMN, rowsOf, tableOffers, type Basis } from "../../drawing/files";
import { TRANSIENT_COLUMNS, type AxialMotionJson, type Range, type StallJson } from "../../protocol";
import { say, WORDS } from "../../words";
import { ESTIMATES, membersOf, SEED } from "./requests";
import type { Estimated, Known, Operation, Row, Transient } from "./requests";

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
  /** Whether motions that coexist with the first one are drawn, too. */
  readonly coexisting?: boolean;
}

/** The colours of motions that coexist with the one reached from rest. */
const COEXISTING = ["--curve-power", "--curve-efficiency", "--curve-input"] as const;

const KINDS: readonly Kind[] = [
  {
    ...{ title: TEXTS.speed, label: TEXTS.speed_axis, factor: 1, coexisting: true },
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

/** The speeds of motions that coexist, each a curve of its own with gaps under the loads that have no such motion. */
function coexistingCurves(rows: readonly Row[]): Curve[] {
  const most = Math.max(...rows.map(({ others }) => others.length));
  return Array.from({ length: most }, (_, branch) => {
    const of = (name: "speed" | "speed_error") => rows.map(({ others }) => others[branch]?.[name] ?? NaN);
    const colour = COEXISTING[branch % COEXISTING.length] as string;
    const label = say(TEXTS.coexisting, { number: branch + 2 });
    return { label, y: of("speed"), error: of("speed_error"), colour, dash: [2, 3], points: true };
  });
}

/** Speed, power and efficiency against load, with bands of two standard errors; nothing where there is no load. */
export function loadCharts(operations: readonly Row[], largest: number, stall: StallJson | null): Chart[] {
  if (operations.length === 0) return [];
  const shown = [...operations].sort((one, two) => one.load_torque - two.load_torque);
  const x = prefixed(TEXTS.load, padded([0, largest], 0.03));
  const [, end] = x.range;
  const at = shown.map(({ load_torque }) => load_torque);
  const { torque: stop = null, torque_error = 0 } = stall ?? {};
  const by = 2 * finite(torque_error ?? 0);
  const stretches: Stretch[] = [{ range: [largest, end], label: TEXTS.runaway, colour: "--runaway" }];
  if (stop !== null) stretches.push({ at: stop, range: [stop - by, stop + by], label: TEXTS.stall, colour: "--stall" });
  return KINDS.map(({ title, label, curves: described, factor, coexisting }) => {
    const own = described.map(({ name, ...own }) => {
      const [y, error] = [shown.map((row) => row[name]), shown.map((row) => row[`${name}_error`])];
      return { ...own, y, error, points: true };
    });
    const others = coexisting === true ? coexistingCurves(shown) : [];
    const curves = [...own, ...others];
    const mark = ({ y, colour }: Curve, index: number, status: number | undefined): Mark[] => {
      const x = at[index] ?? NaN;
      if (status === 2) return [{ x, y: 0, form: "cross", colour: "--warning" }];
      return status === 1 ? [{ x, y: finite(y[index] ?? NaN), form: "circle", colour }] : [];
    };
    const marks = shown.flatMap((row, index) => [
      ...own.slice(0, 1).flatMap((curve) => mark(curve, index, row.status)),
      ...others.flatMap((curve, branch) => mark(curve, index, row.others[branch]?.status)),
    ]);
    const range = spanOf(curves, [0], 0.08);
    const y = factor === undefined ? prefixed(label, range) : { label, range, factor };
    return { title, x, y, at, curves, marks, stretches };
  });
}

const LOAD_COLUMNS = [
  "load_torque_N_m", "branch", "motion", "life_s", "speed_rad_per_s", "speed_error_rad_per_s", "mechanical_power_W", "mechanical_power_error_W",
  "input_power_W", "input_power_error_W", "efficiency", "efficiency_error", "status",
  "relative_error_wanted", "shortfall",
]; // prettier-ignore
const STATUS = ["steady", "unsettled", "runaway"] as const;

/** A line of the table: one branch of one load. */
function lineOf(one: Operation, branch: number): (string | number)[] {
  const estimates = ESTIMATES.flatMap((name) => [one[name], one[`${name}_error`]]);
  const [kind, life] = motionOf(one.motion);
  return [
    ...[one.load_torque, branch + 1, kind, life ?? "", ...estimates],
    ...[STATUS[one.status] ?? "", one.wanted, one.shortfall ?? ""],
  ];
}

/** The kind of a motion, and the mean life (s) of an irregular one if some were seen to end. */
function motionOf(motion: AxialMotionJson | null): [kind: string, life: number | null] {
  if (motion === null) return ["", null];
  if (motion === "Contact") return ["contact", null];
  if ("Periodic" in motion) return ["periodic", null];
  const { life } = motion.Irregular;
  return ["irregular", "Mean" in life ? life.Mean : null];
}

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
    const rows = () => operations.flatMap((row) => [row, ...row.others].map(lineOf));
    offers.push(...tableOffers({ name: FILES.curve, parameters: { sheet, seed: SEED }, columns: LOAD_COLUMNS, rows }));
  }
  const each = ONE_COLUMN * 0.62;
  if (runUp !== null) offers.push(...chartOffers(FILES.run_up, TITLES.run_up, [runUp], each, basis));
  if (curves.length > 0) offers.push(...chartOffers(FILES.curve, TITLES.curve, curves, each, basis));
  return offers;
}
