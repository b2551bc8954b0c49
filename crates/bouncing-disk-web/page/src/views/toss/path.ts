/** The path of a point of the platform, as in Fig. 2: its height over its angle, through one period. */

import { layOut, paintAxes, pixelX, pixelY } from "../../drawing/axes";
import type { Axis, Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import { plain, prefixOf, quantity } from "../../drawing/numbers";
import { shifted } from "../../drawing/pen";
import type { Pen } from "../../drawing/pen";
import { linearScale, padded } from "../../drawing/scale";
import type { SystemParameters } from "../../protocol";
import type { Moment, Recording } from "./recording";

type Platform = Pick<SystemParameters, "amplitude" | "twist_amplitude">;

/** On a narrower scene the inset is a frame without numbers. */
const NARROW = 480;

/** Angles from this on are told in radians and not in thousandths of them (rad). */
const LARGE = 0.05;

export function pathAxes({ amplitude, twist_amplitude }: Platform): { x: Axis; y: Axis } {
  const radian = twist_amplitude >= LARGE ? { factor: 1, symbol: "" } : prefixOf(twist_amplitude);
  const metre = prefixOf(amplitude);
  const around = (size: number) => linearScale(padded([-size, size]));
  return {
    x: { label: `angle (${radian.symbol}rad)`, scale: around(twist_amplitude), factor: radian.factor },
    y: { label: `height (${metre.symbol}m)`, scale: around(amplitude), factor: metre.factor },
  };
}

/** In the upper right corner of the scene, with a dot where the point is now. */
export function paintPathInset(
  scene: Pen,
  recording: Recording,
  now: Moment,
  colour: Colours,
  width: number,
): void {
  const platform = recording.system;
  const narrow = width < NARROW;
  const [wide, high] = narrow ? [84, 84] : [200, 150];
  const pen = shifted(scene, 2, width - wide - 2);
  const { x, y } = pathAxes(platform);
  const bare = { left: 4, top: 4, width: wide - 8, height: high - 8, x, y, xTicks: NONE, yTicks: NONE, size: 10 };
  const plot = narrow ? bare : withAmplitudes(layOut(pen, wide, high, x, { ...y, widest: "−0000" }, 11), platform);
  pen.rect(0, 0, wide, high, { fill: colour("--picture-paper"), opacity: 0.8 });
  paintPath(pen, plot, recording, colour);
  const at = [pixelX(plot, now.platform_angle), pixelY(plot, now.platform_height)] as const;
  pen.circle(at[0], at[1], 4, { fill: colour("--platform-mark"), stroke: colour("--picture-paper"), width: 1 });
  if (narrow) pen.rect(plot.left, plot.top, plot.width, plot.height, { stroke: colour("--picture-frame"), width: 1 });
  else paintAxes(pen, plot, colour);
}

/** Few numbers have room: those of the amplitudes say most. */
function withAmplitudes(plot: Plot, { amplitude, twist_amplitude }: Platform): Plot {
  const numbers = (size: number, factor = 1) => ({
    major: (size > 0 ? [-size, 0, size] : [0]).map((value) => ({ value, label: plain(value * factor, 3) })),
    minor: [],
  });
  return { ...plot, xTicks: numbers(twist_amplitude, plot.x.factor), yTicks: numbers(amplitude, plot.y.factor) };
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
export function describePath({ amplitude, twist_amplitude }: Platform): string {
  const wide = twist_amplitude >= LARGE ? `${plain(twist_amplitude, 3)} rad` : quantity(twist_amplitude, "rad");
  return (
    "In the corner: the path of a point of the platform, its height over its angle, " +
    `to ${wide} and ${quantity(amplitude, "m")} on both sides.`
  );
}
