/** The files of a motion. */

import type { Offer } from "../../contract";
import { layOut, paintAxes } from "../../drawing/axes";
import type { Axis } from "../../drawing/axes";
import { layOutChart, paintChart } from "../../drawing/chart_paint";
import { ONE_COLUMN, pictureOffers, PRINT_SIZE, tableOffers } from "../../drawing/files";
import { shifted } from "../../drawing/pen";
import type { MotionStart, SystemParameters } from "../../protocol";
import { paintPath, pathAxes } from "./path";
import { paintImpacts } from "./portrait";
import type { Recording } from "./recording";
import { traces } from "./traces";

const COLUMNS = [
  "time_s", "height_m", "angle_rad", "axial_velocity_m_per_s", "angular_speed_rad_per_s", "platform_height_m",
  "platform_angle_rad", "platform_velocity_m_per_s", "platform_angular_speed_rad_per_s", "mode",
] as const; // prettier-ignore

export function tossOffers(
  recording: Recording,
  now: number,
  parameters: { system: SystemParameters; start: MotionStart },
  portraitAxes: () => { x: Axis; y: Axis },
): Offer[] {
  const known = { ...parameters, periods: recording.periods };
  return [
    ...tableOffers({ name: "motion", parameters: known, columns: COLUMNS, rows: () => recording.table() }),
    ...tableOffers({
      name: "impacts",
      parameters: known,
      columns: ["time_s", "impact_phase_rad", "normalised_speed"],
      *rows() {
        for (const { time, phase, normalised_speed } of recording.impacts) yield [time, phase, normalised_speed];
      },
    }),
    ...pictureOffers({
      name: "time traces",
      title: "Heights and angular speeds of disk and platform",
      width: ONE_COLUMN,
      height: ONE_COLUMN * 1.2,
      paint(pen, colour, width, height) {
        const [heights, spins] = traces(recording, Math.max(now, Math.min(recording.periods, 8)));
        // One axis of time: both have the place that the longer numbers need.
        const plots = [heights, spins].map((chart) => layOutChart(pen, chart, width, height / 2, PRINT_SIZE));
        const numbers = plots.flatMap(({ yTicks }) => yTicks.major.map(({ label }) => label));
        const long = (label: string) => pen.measure(label, PRINT_SIZE);
        const widest = numbers.reduce((one, other) => (long(other) > long(one) ? other : one), "");
        paintChart(pen, { ...heights, widest }, colour, width, height / 2, PRINT_SIZE);
        paintChart(shifted(pen, height / 2), { ...spins, widest }, colour, width, height / 2, PRINT_SIZE);
      },
    }),
    ...pictureOffers({
      name: "path of the platform",
      title: "Path of a point of the platform: height over angle",
      width: ONE_COLUMN,
      height: ONE_COLUMN * 0.8,
      paint(pen, colour, width, height) {
        const { x, y } = pathAxes(recording.system);
        const plot = layOut(pen, width, height, x, y, PRINT_SIZE);
        paintPath(pen, plot, recording, colour);
        paintAxes(pen, plot, colour);
      },
    }),
    ...pictureOffers({
      name: "phase portrait",
      title: "Phases and speeds of the impacts",
      width: ONE_COLUMN,
      height: ONE_COLUMN * 0.8,
      paint(pen, colour, width, height) {
        const { x, y } = portraitAxes();
        const plot = layOut(pen, width, height, x, y, PRINT_SIZE);
        paintImpacts(pen, plot, recording.impacts, colour, 1.4);
        paintAxes(pen, plot, colour);
      },
    }),
  ];
}
