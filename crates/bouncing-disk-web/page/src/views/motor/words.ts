/** The curves of a motor in words. */

import { quantityWithError, withError } from "../../drawing/numbers";
import type { StallJson } from "../../protocol";
import type { Operation } from "./computation";

/** A sentence for speed, power and efficiency each; none before there is a load. */
export function describeCurves(operations: readonly Operation[], stall: StallJson | null): string[] {
  const known = operations.filter(({ status }) => status !== 2);
  const first = known[0];
  const last = known[known.length - 1];
  if (first === undefined || last === undefined) return [];
  const at = ({ load_torque }: Operation) => quantityWithError(load_torque, null, "N m");
  const speed = (row: Operation) => `${withError(row.speed, row.speed_error)} rad/s at ${at(row)}`;
  const stop =
    stall === null ? "" : ` The motor stalls at ${quantityWithError(stall.torque, stall.torque_error, "N m")}.`;
  const powerful = known.reduce((best, row) => (row.mechanical_power > best.mechanical_power ? row : best));
  const power = quantityWithError(powerful.mechanical_power, powerful.mechanical_power_error, "W");
  const efficient = known
    .filter(({ efficiency }) => Number.isFinite(efficiency))
    .reduce<Operation | null>((best, row) => (best === null || row.efficiency > best.efficiency ? row : best), null);
  return [
    `From ${speed(first)} to ${speed(last)}.${stop}`,
    `Of the loads computed, the load takes most power at ${at(powerful)}: ${power}.`,
    efficient === null
      ? "No efficiency is known."
      : "Of the loads computed, the best efficiency is " +
        `${withError(efficient.efficiency, efficient.efficiency_error, 100)} % at ${at(efficient)}.`,
  ];
}
