/** The path of a point of the platform, as in Fig. 2: its height over its angle, through one period. */

import { layOut, paintAxes, pixelX, pixelY } from "../../drawing/axes";
import type { Axis, Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import { prefixOf, quantity } from "../../drawing/numbers";
import type { Pen } from "../../drawing/pen";
import { linearScale, padded } from "../../drawing/scale";
import type { Range } from "../../protocol";
import type { Moment, Recording } from "./recording";

/** On a narrower scene the inset is a frame without numbers. */
const NARROW = 480;

export function pathAxes(recording: Recording): { x: Axis; y: Axis } {
  const angles = recording.extent("platform_angle");
  const heights = recording.extent("platform_height");
  const [radian, metre] = [prefixOf(largest(angles)), prefixOf(largest(heights))];
  return {
    x: { label: `angle (${radian.symbol}rad)`, scale: linearScale(padded(angles)), factor: radian.factor },
    y: { label: `height (${metre.symbol}m)`, scale: linearScale(padded(heights)), factor: metre.factor },
  };
}

/** In the upper right corner of the scene, with a dot where the point is now. */
export function paintPathInset(pen: Pen, recording: Recording, now: Moment, colour: Colours, width: number): void {
  const narrow = width < NARROW;
  const [wide, high] = narrow ? [84, 84] : [190, 150];
  const { x, y } = pathAxes(recording);
  const left = width - wide - 4;
  const plot: Plot = narrow
    ? { left: left + 4, top: 6, width: wide - 8, height: high - 12, x, y, xTicks: NONE, yTicks: NONE, size: 10 }
    : moved(layOut(pen, wide, high, x, y, 11), left, 2);
  const paper = { fill: colour("--picture-paper"), opacity: 0.8 };
  if (narrow) pen.rect(plot.left, plot.top, plot.width, plot.height, paper);
  else pen.rect(left, 2, wide, high, paper);
  paintPath(pen, plot, recording, colour);
  const at = [pixelX(plot, now.platform_angle), pixelY(plot, now.platform_height)] as const;
  pen.circle(at[0], at[1], 4, { fill: colour("--platform-mark"), stroke: colour("--picture-paper"), width: 1 });
  if (narrow) pen.rect(plot.left, plot.top, plot.width, plot.height, { stroke: colour("--picture-frame"), width: 1 });
  else paintAxes(pen, plot, colour);
}

const NONE = { major: [], minor: [] };

export function paintPath(pen: Pen, plot: Plot, recording: Recording, colour: Colours): void {
  const angles = recording.span("platform_angle", 0, recording.period, 1);
  const heights = recording.span("platform_height", 0, recording.period, 1);
  const points: number[] = [];
  angles.forEach((angle, index) => points.push(pixelX(plot, angle), pixelY(plot, heights[index] as number)));
  pen.path(points, { stroke: colour("--platform-line"), width: 1.6, close: true });
}

/** The picture in words. */
export function describePath(recording: Recording): string {
  const size = ([low, high]: Range, unit: string): string => quantity(high - low, unit, 2);
  const [wide, high] = [recording.extent("platform_angle"), recording.extent("platform_height")];
  return (
    "In the corner: the path of a point of the platform, its height over its angle, " +
    `${size(wide, "rad")} wide and ${size(high, "m")} high.`
  );
}

function moved(plot: Plot, right: number, down: number): Plot {
  return { ...plot, left: plot.left + right, top: plot.top + down };
}

function largest([low, high]: Range): number {
  return Math.max(Math.abs(low), Math.abs(high));
}
