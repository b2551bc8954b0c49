/** The orbit diagram in words, for those who do not see it. */

import type { State } from "../../contract";
import { brief, plain } from "../../drawing/numbers";
import { DIAGRAM_COLUMNS } from "../../protocol";
import type { Columns } from "./computation";
import { columnOf, DESCRIBED } from "./quantity";

const WIDTH = DIAGRAM_COLUMNS.length;
const SAMPLES = 5;
const MANY = 16;
/** Values nearer to each other than this count as one. */
const SAME = 1e-4;

export function describeDiagram(
  answers: readonly Columns[],
  diagram: State["diagram"],
  restitution: number,
  count: number,
): string {
  const [low, high] = diagram.axial_forcing;
  const { name } = DESCRIBED[diagram.quantity];
  const parts: string[] = [];
  for (let sample = 0; sample < SAMPLES; sample += 1) {
    const column = Math.round(((sample + 0.5) / SAMPLES) * (count - 1));
    const answer = answers.find(({ coarse, from, to }) => !coarse && from <= column && column < to);
    if (answer === undefined) continue;
    const forcing = low + (high - low) * (column / (count - 1));
    parts.push(`${values(distinct(answer.numbers, forcing, columnOf(diagram.quantity)))} at ${plain(forcing, 4)}`);
  }
  return (
    `The ${name} of the orbits from the shared start, for Γ from ${brief(low)} to ${brief(high)} at a coefficient of ` +
    `restitution of ${brief(restitution)}: ${parts.join(", ")}.`
  );
}

function distinct(numbers: Float64Array, forcing: number, field: number): number {
  const found: number[] = [];
  for (let row = 0; row + WIDTH <= numbers.length && found.length <= MANY; row += WIDTH) {
    if (Math.abs((numbers[row] as number) - forcing) > 1e-12 * forcing) continue;
    const value = numbers[row + field] as number;
    if (!Number.isNaN(value) && !found.some((known) => Math.abs(known - value) < SAME)) found.push(value);
  }
  return found.length;
}

function values(count: number): string {
  if (count === 0) return "none";
  if (count > MANY) return `more than ${MANY} values`;
  return `${count} value${count === 1 ? "" : "s"}`;
}
