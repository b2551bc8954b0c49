/** The files of a motor. */

import type { Offer } from "../../contract";
import type { Chart } from "../../drawing/chart";
import { paintChart } from "../../drawing/chart_paint";
import { ONE_COLUMN, pictureOffers, PRINT_SIZE, rowsOf, tableOffers } from "../../drawing/files";
import { shifted } from "../../drawing/pen";
import { OPERATION_COLUMNS } from "../../protocol";
import type { MotorSheet } from "../../protocol";
import { MEMBERS, SEED } from "./computation";
import type { Operation, Transient } from "./computation";

export interface MotorParts {
  readonly sheet: MotorSheet;
  readonly text: string;
  readonly transient: Transient | null;
  readonly operations: readonly Operation[];
  readonly runUp: Chart | null;
  readonly curves: readonly Chart[];
}

const LOAD_UNITS = [
  "load_torque_N_m", "speed_rad_per_s", "speed_error_rad_per_s", "mechanical_power_W", "mechanical_power_error_W",
  "input_power_W", "input_power_error_W", "efficiency", "efficiency_error", "status",
] as const; // prettier-ignore
const STATUS = ["steady", "unsettled", "runaway"] as const;

export function motorOffers({ sheet, text, transient, operations, runUp, curves }: MotorParts): Offer[] {
  const offers: Offer[] = [
    {
      name: "motor data sheet",
      kind: "json",
      make: () => Promise.resolve(new Blob([text], { type: "application/json" })),
    },
  ];
  if (transient !== null) {
    offers.push(
      ...tableOffers({
        name: "motor run-up",
        parameters: { sheet, members: MEMBERS, seed: SEED },
        columns: ["time_s", "speed_rad_per_s", "speed_error_rad_per_s"],
        rows: () => rowsOf(transient.numbers, 3),
      }),
    );
  }
  if (operations.length > 0) {
    offers.push(
      ...tableOffers({
        name: "motor load curve",
        parameters: { sheet, seed: SEED },
        columns: [...LOAD_UNITS, "relative_error_wanted", "shortfall"],
        *rows() {
          for (const row of operations) {
            const numbers = OPERATION_COLUMNS.map((name) =>
              name === "status" ? (STATUS[row.status] ?? "") : row[name],
            );
            yield [...numbers, row.wanted, row.shortfall ?? ""];
          }
        },
      }),
    );
  }
  if (runUp !== null) offers.push(...stacked("motor run-up", "Run-up of the motor", [runUp]));
  if (curves.length > 0)
    offers.push(...stacked("motor load curve", "Speed, power and efficiency against load", curves));
  return offers;
}

function stacked(name: string, title: string, charts: readonly Chart[]): Offer[] {
  const each = ONE_COLUMN * 0.62;
  return pictureOffers({
    name,
    title,
    width: ONE_COLUMN,
    height: each * charts.length,
    paint(pen, colour, width) {
      charts.forEach((chart, index) => paintChart(shifted(pen, index * each), chart, colour, width, each, PRINT_SIZE));
    },
  });
}
