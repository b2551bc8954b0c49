/** The files of the orbit diagram. */

import type { Offer, State } from "../../contract";
import { layOut, paintAxes } from "../../drawing/axes";
import type { Axis, Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import { pictureOffers, PRINT_SIZE, rowsOf, tableOffers, TWO_COLUMNS } from "../../drawing/files";
import type { Pen } from "../../drawing/pen";
import { DIAGRAM_COLUMNS } from "../../protocol";
import { PATIENCE, RECORDED, TRANSIENT } from "./computation";
import type { Columns } from "./computation";

export interface DiagramParts {
  readonly state: State;
  readonly columns: readonly Columns[];
  readonly plotAxes: { x: Axis; y: Axis };
  paint(pen: Pen, plot: Plot, colour: Colours): void;
}

export function diagramOffers({ state, columns, plotAxes, paint }: DiagramParts): Offer[] {
  const { system, start, diagram } = state;
  const fine = columns.filter(({ coarse }) => !coarse);
  return [
    ...tableOffers({
      name: "orbit diagram",
      parameters: {
        picture: "orbit diagram", system, start, diagram, transient: TRANSIENT, recorded: RECORDED, patience: PATIENCE,
      }, // prettier-ignore
      columns: [DIAGRAM_COLUMNS[0], "impact_phase_rad", "normalised_speed", "angular_speed_per_omega_phi"],
      *rows() {
        for (const { numbers } of fine) yield* rowsOf(numbers, DIAGRAM_COLUMNS.length);
      },
    }),
    ...pictureOffers({
      name: "orbit diagram",
      title: "Orbit diagram",
      width: TWO_COLUMNS,
      height: TWO_COLUMNS * 0.5,
      paint(pen, colour, width, height) {
        const plot = layOut(pen, width, height, plotAxes.x, plotAxes.y, PRINT_SIZE);
        pen.clipped(plot.left, plot.top, plot.width, plot.height, () => paint(pen, plot, colour));
        paintAxes(pen, plot, colour);
      },
    }),
  ];
}
