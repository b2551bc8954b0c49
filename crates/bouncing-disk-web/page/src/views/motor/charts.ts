/** The charts of a motor, from what is known so far. */

import type { Chart, Mark } from "../../drawing/chart";
import { prefixOf } from "../../drawing/numbers";
import { extent, padded } from "../../drawing/scale";
import type { Range, StallJson } from "../../protocol";
import { TRANSIENT_COLUMNS } from "../../protocol";
import type { Operation, Transient } from "./computation";

/** The run-up, and beside it the steady speed under the same load, as soon as it is known. */
export function transientChart({ json, numbers }: Transient, own: Operation | null): Chart {
  const width = TRANSIENT_COLUMNS.length;
  const column = (place: number, factor = 1) =>
    Float64Array.from(
      { length: Math.floor(numbers.length / width) },
      (_, row) => (numbers[row * width + place] ?? NaN) * factor,
    );
  const last = column(0)[json.points - 1] ?? 1;
  const time = prefixOf(last);
  const speed = column(1);
  const error = column(2);
  const steady = own !== null && own.status === 0 ? own : null;
  const edges = [
    ...speed.map((value, row) => value + 2 * (error[row] ?? 0)),
    ...speed.map((value, row) => value - 2 * (error[row] ?? 0)),
  ];
  const around = steady === null ? [] : [-2, 2].map((errors) => steady.speed + errors * finite(steady.speed_error));
  const range = extent([...edges, 0, ...around]) ?? [0, 1];
  const constant = json.rise?.form === "exponential" ? json.rise.constant.value : null;
  return {
    title: "Run-up",
    xLabel: `time (${time.symbol}s)`,
    yLabel: "mean angular speed (rad/s)",
    x: column(0, time.factor),
    xRange: [0, last * time.factor],
    yRange: padded(range),
    curves: [
      { label: "run-up", y: speed, error, colour: "--curve-speed" },
      ...(steady === null
        ? []
        : [
            {
              label: "steady speed",
              y: speed.map(() => steady.speed),
              error: speed.map(() => steady.speed_error),
              colour: "--curve-power",
              dash: [6, 3],
            },
          ]),
    ],
    ...(constant === null || constant > last
      ? {}
      : { lines: [{ x: constant * time.factor, label: "time constant", colour: "--picture-muted" }] }),
  };
}

interface Kind {
  readonly title: string;
  readonly label: (prefix: string) => string;
  readonly curves: readonly {
    name: "speed" | "mechanical_power" | "input_power" | "efficiency";
    label: string;
    colour: string;
    dash?: readonly number[];
  }[];
  readonly scaled: boolean;
  readonly factor: number;
}

const KINDS: readonly Kind[] = [
  {
    title: "Speed against load",
    label: () => "steady angular speed (rad/s)",
    curves: [{ name: "speed", label: "speed", colour: "--curve-speed" }],
    scaled: false,
    factor: 1,
  },
  {
    title: "Power against load",
    label: (prefix) => `power (${prefix}W)`,
    curves: [
      { name: "mechanical_power", label: "to the load", colour: "--curve-power" },
      { name: "input_power", label: "from the stator", colour: "--curve-input", dash: [6, 3] },
    ],
    scaled: true,
    factor: 1,
  },
  {
    title: "Efficiency against load",
    label: () => "efficiency (%)",
    curves: [{ name: "efficiency", label: "efficiency", colour: "--curve-efficiency" }],
    scaled: false,
    factor: 100,
  },
];

/** Speed, power and efficiency against load, with bands of two standard errors. */
export function loadCharts(
  operations: readonly Operation[],
  loads: Range,
  largestTorque: number,
  stall: StallJson | null,
): Chart[] {
  const stop = stall?.torque ?? null;
  const torque = prefixOf(Math.max(Math.abs(loads[0]), Math.abs(loads[1])));
  const shown = [...operations].sort((one, two) => one.load_torque - two.load_torque);
  const x = shown.map(({ load_torque }) => load_torque * torque.factor);
  const span = padded([loads[0] * torque.factor, loads[1] * torque.factor], 0.03);
  return KINDS.map((kind) => {
    const values = shown.flatMap((row) => kind.curves.map(({ name }) => row[name]));
    const greatest = Math.max(...values.filter(Number.isFinite).map(Math.abs), 0);
    const prefix = kind.scaled ? prefixOf(greatest) : { factor: kind.factor, symbol: "" };
    const edges = shown.flatMap((row) =>
      kind.curves.flatMap(({ name }) =>
        [-2, 2].map((errors) => (row[name] + errors * finite(row[`${name}_error`])) * prefix.factor),
      ),
    );
    // A point that is not settled may have any error; it must not flatten the others.
    const most = 1.6 * greatest * prefix.factor;
    const range = extent([0, ...edges.map((edge) => Math.min(Math.max(edge, -most), most))]) ?? [0, 1];
    const [first] = kind.curves;
    const marks: Mark[] = [];
    for (const row of shown) {
      if (row.status === 0 || first === undefined) continue;
      const value = row[first.name] * prefix.factor;
      const runaway = row.status === 2;
      marks.push({
        x: row.load_torque * torque.factor,
        y: Number.isFinite(value) && !runaway ? value : 0,
        form: runaway ? "cross" : "circle",
        label: runaway ? "the load drives the rotor" : "unsettled",
        colour: runaway ? "--warning" : first.colour,
      });
    }
    const beyond = largestTorque * torque.factor;
    return {
      title: kind.title,
      xLabel: `load (${torque.symbol}N m)`,
      yLabel: kind.label(prefix.symbol),
      x,
      xRange: span,
      // Without any value but zero there is no scale to take from the numbers.
      yRange: padded(greatest > 0 ? range : [0, 1], 0.08),
      curves: kind.curves.map(({ name, ...curve }) => ({
        ...curve,
        y: shown.map((row) => row[name] * prefix.factor),
        error: shown.map((row) => row[`${name}_error`] * prefix.factor),
        points: true,
      })),
      marks,
      ...(stop === null
        ? {}
        : {
            lines: [
              {
                x: stop * torque.factor,
                error: finite(stall?.torque_error ?? 0) * torque.factor,
                label: "stall",
                colour: "--stall",
              },
            ],
          }),
      ...(span[1] > beyond * 1.001
        ? { shade: { range: [beyond, span[1]] as Range, label: "friction cannot hold" } }
        : {}),
    };
  });
}

function finite(value: number): number {
  return Number.isFinite(value) ? value : 0;
}
