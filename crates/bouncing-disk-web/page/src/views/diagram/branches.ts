/** Branches of periodic orbits over the diagram: full lines where they are stable, dashed ones where not. */

import type { Quantity } from "../../contract";
import { pixelX, pixelY } from "../../drawing/axes";
import type { Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import type { Pen } from "../../drawing/pen";
import { BRANCH_COLUMNS } from "../../protocol";
import type { BranchesJson } from "../../protocol";
import { axisValue, columnOf } from "./quantity";

const WIDTH = BRANCH_COLUMNS.length;
const BRANCH = 3;
const STABLE = 4;

export interface Branches {
  readonly json: BranchesJson;
  readonly numbers: Float64Array;
}

export function paintBranches(pen: Pen, plot: Plot, branches: Branches, quantity: Quantity, colour: Colours): void {
  if (quantity === "angular_speed") return;
  const full: number[] = [];
  const dashed: number[] = [];
  const { numbers } = branches;
  const field = columnOf(quantity);
  const low = plot.y.scale.domain[0];
  // Impacts of one branch follow each other: a jump back over half of what is seen begins the next one.
  const width = plot.width / 4;
  const height = plot.height / 3;
  let last: { x: number; y: number; branch: number } | null = null;
  for (let row = 0; row + WIDTH <= numbers.length; row += WIDTH) {
    const x = pixelX(plot, numbers[row] as number);
    const y = pixelY(plot, axisValue(quantity, numbers[row + field] as number, low));
    const branch = numbers[row + BRANCH] as number;
    const jump =
      last === null || last.branch !== branch || Math.abs(last.x - x) > width || Math.abs(last.y - y) > height;
    if (!jump && last !== null) {
      const line = numbers[row + STABLE] === 1 ? full : dashed;
      const end = line.length;
      // The pen goes on where the last piece of this kind ended here.
      if (line[end - 2] === last.x && line[end - 1] === last.y) line.push(x, y);
      else line.push(NaN, NaN, last.x, last.y, x, y);
    }
    last = { x, y, branch };
  }
  pen.path(dashed, { stroke: colour("--branch-unstable"), width: 1.1, dash: [5, 3] });
  pen.path(full, { stroke: colour("--branch-stable"), width: 1.5 });
  paintBifurcations(pen, plot, branches, quantity, colour);
}

/** Each bifurcation is marked at the nearest computed orbit of its branch. */
function paintBifurcations(
  pen: Pen,
  plot: Plot,
  { json, numbers }: Branches,
  quantity: Quantity,
  colour: Colours,
): void {
  const field = columnOf(quantity);
  const low = plot.y.scale.domain[0];
  const style = { stroke: colour("--bifurcation"), width: 1.3, fill: colour("--picture-paper") };
  for (const found of json.bifurcations) {
    const x = pixelX(plot, found.axial_forcing);
    if (x < plot.left || x > plot.left + plot.width) continue;
    let nearest = Infinity;
    let y = NaN;
    for (let row = 0; row + WIDTH <= numbers.length; row += WIDTH) {
      if (numbers[row + BRANCH] !== found.branch) continue;
      const distance = Math.abs((numbers[row] as number) - found.axial_forcing);
      if (distance >= nearest) continue;
      nearest = distance;
      y = pixelY(plot, axisValue(quantity, numbers[row + field] as number, low));
    }
    if (Number.isNaN(y)) continue;
    if (found.kind === "doubling") pen.circle(x, y, 3.5, style);
    else if (found.kind === "fold") pen.rect(x - 3, y - 3, 6, 6, style);
    else if (found.kind === "birth") pen.path([x, y - 4, x + 4, y, x, y + 4, x - 4, y], { ...style, close: true });
    else
      pen.path([x - 3, y - 3, x + 3, y + 3, NaN, NaN, x - 3, y + 3, x + 3, y - 3], {
        stroke: style.stroke,
        width: 1.5,
      });
  }
}

/** "a doubling at 0.4860, a fold at 0.3333", for the text beside the picture; the first few. */
export function describeBifurcations({ json }: Branches): string {
  const words = json.bifurcations.map(({ kind, axial_forcing }) => `${kind} at ${axial_forcing.toFixed(4)}`);
  const distinct = [...new Set(words)];
  if (distinct.length === 0) return "No bifurcation of the branches lies in this window.";
  const more = distinct.length > 6 ? `, and ${distinct.length - 6} more` : "";
  return `On the branches: ${distinct.slice(0, 6).join(", ")}${more}.`;
}
