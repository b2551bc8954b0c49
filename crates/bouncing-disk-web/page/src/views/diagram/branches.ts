/** Branches of periodic orbits over the diagram: full lines where they are stable, dashed ones where not. */

import type { Context, Quantity, State } from "../../contract";
import { crossAt, pixelX, pixelY, type Plot } from "../../drawing/axes";
import { rounded, rowsOf, type Table } from "../../drawing/files";
import type { Pen } from "../../drawing/pen";
import { BRANCH_COLUMNS, type BranchesJson, type Range } from "../../protocol";
import { WORDS } from "../../words";
import { axisValue, columnOf } from "./columns";

export const BRANCHES = "diagram-branches";

export interface Branches {
  /** The forcings for which they were looked for. */
  readonly axial_forcing: Range;
  readonly json: BranchesJson;
  readonly numbers: Float64Array;
}

/** What branches, verdicts and the rotation are computed for. */
export const isPlain = ({ system, diagram }: State): boolean => diagram.drive === "sine" && system.contact_time === 0;

/** Where branches are drawn: they have no angular speed. */
export const areDrawn = (state: State): boolean =>
  state.diagram.branches && state.diagram.quantity !== "angular_speed" && isPlain(state);

export async function branchesOf({ client }: Context, { system: { restitution }, diagram }: State): Promise<Branches> {
  const { axial_forcing } = diagram;
  const request = { call: "branches", restitution, axial_forcing } as const;
  return { ...(await client.series<BranchesJson>(BRANCHES, [request])), axial_forcing };
}

const WIDTH = BRANCH_COLUMNS.length;
const STABLE = 4;
const LINE = 5;

export function paintBranches(pen: Pen, plot: Plot, branches: Branches, quantity: Quantity): void {
  const full: number[] = [];
  const dashed: number[] = [];
  const { numbers } = branches;
  const field = columnOf(quantity);
  const low = plot.y.range[0];
  let last: { x: number; value: number; line: number } | null = null;
  for (let row = 0; row + WIDTH <= numbers.length; row += WIDTH) {
    const x = pixelX(plot, numbers[row] as number);
    const value = axisValue(quantity, numbers[row + field] as number, low);
    const line = numbers[row + LINE] as number;
    // A phase that leaves the axis at one end goes on at the other.
    const around = last !== null && quantity === "impact_phase" && Math.abs(value - last.value) > 0.5;
    if (last !== null && last.line === line && !around) {
      const kind = numbers[row + STABLE] === 1 ? full : dashed;
      const end = kind.length;
      const y = pixelY(plot, value);
      const before = pixelY(plot, last.value);
      // The pen goes on where the last piece of this kind ended here.
      if (kind[end - 2] === last.x && kind[end - 1] === before) kind.push(x, y);
      else kind.push(NaN, NaN, last.x, before, x, y);
    }
    last = { x, value, line };
  }
  pen.path(dashed, { stroke: "--branch-unstable", width: 1, dash: [4, 4] });
  pen.path(full, { stroke: "--branch-stable", width: 1.5 });
  paintBifurcations(pen, plot, branches, quantity);
}

/** Each bifurcation is marked at the first impact of its orbit. */
function paintBifurcations(pen: Pen, plot: Plot, { json }: Branches, quantity: Quantity): void {
  const low = plot.y.range[0];
  const style = { stroke: "--bifurcation", width: 1.3, fill: "--picture-paper" };
  for (const found of json.bifurcations) {
    const x = pixelX(plot, found.axial_forcing);
    if (x < plot.left || x > plot.left + plot.width) continue;
    const of = quantity === "impact_phase" ? found.impact_phase : found.normalised_speed;
    const y = pixelY(plot, axisValue(quantity, of, low));
    if (found.kind === "doubling") pen.circle(x, y, 3.5, style);
    else if (found.kind === "fold") pen.rect(x - 3, y - 3, 6, 6, style);
    else pen.path(crossAt(x, y, 3), { stroke: style.stroke, width: 1.5 });
  }
}

/** The bifurcations, in the order of the forcing and each once, and the branches point by point. */
export function tablesOf({ json, numbers, axial_forcing }: Branches, { system }: State): [Table, Table] {
  const { tables } = WORDS.diagram;
  const parameters = { picture: "branches", restitution: system.restitution, axial_forcing };
  const impact = ["axial_forcing", "impact_phase_rad", "normalised_speed"];
  // The phase of a fold at 0 is what rounding leaves of it.
  const found = json.bifurcations.map(({ kind, axial_forcing, impact_phase, normalised_speed }) => {
    return [kind, axial_forcing, rounded(impact_phase, 1e-12), normalised_speed] as const;
  });
  const once = [...new Map(found.map((row) => [row.join(), row])).values()].sort((one, other) => one[1] - other[1]);
  return [
    { name: tables.bifurcations, parameters, columns: ["kind", ...impact], rows: () => once },
    {
      name: tables.branches,
      parameters,
      columns: [...impact, ...BRANCH_COLUMNS.slice(impact.length)],
      rows: () => rowsOf(numbers, WIDTH),
    },
  ];
}
