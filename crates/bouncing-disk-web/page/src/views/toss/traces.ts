/** Heights and angular speeds against time, for the last few periods. */

import type { Chart } from "../../drawing/chart";
import { prefixOf } from "../../drawing/numbers";
import { padded } from "../../drawing/scale";
import type { Range } from "../../protocol";
import type { Recording } from "./recording";

const SHOWN = 8;

/** The charts of a recording up to a time in periods; `from` is given to print another stretch. */
export function traces(recording: Recording, now: number): [Chart, Chart] {
  const { period } = recording;
  const from = Math.max(0, now - SHOWN + 1);
  const range: Range = [from, from + SHOWN];
  const [start, end] = [from * period, now * period];
  const x = recording.span("time", start, end, 1 / period);
  const heights = recording.extent("height", "platform_height");
  const spins = recording.extent("angular_speed", "platform_angular_speed");
  const metre = prefixOf(Math.max(Math.abs(heights[0]), Math.abs(heights[1])));
  const chart = { xLabel: "time (periods of the platform)", x, xRange: range };
  const column = (name: Parameters<Recording["span"]>[0], factor = 1) => recording.span(name, start, end, factor);
  return [
    {
      ...chart,
      title: "Heights",
      yLabel: `height (${metre.symbol}m)`,
      yRange: padded([heights[0] * metre.factor, heights[1] * metre.factor]),
      curves: [
        { label: "disk", y: column("height", metre.factor), colour: "--disk" },
        { label: "platform", y: column("platform_height", metre.factor), colour: "--platform-line", dash: [6, 3] },
      ],
    },
    {
      ...chart,
      title: "Angular speeds",
      yLabel: "angular speed (rad/s)",
      yRange: padded(spins),
      curves: [
        { label: "disk", y: column("angular_speed"), colour: "--disk" },
        { label: "platform", y: column("platform_angular_speed"), colour: "--platform-line", dash: [6, 3] },
      ],
    },
  ];
}
