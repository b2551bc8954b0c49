/** A moment of the motion in words. */

import { plain, quantity } from "../../drawing/numbers";
import type { Moment, Recording } from "./recording";

/** What a disk does in each mode. */
const WORDS: Readonly<Record<string, string>> = {
  flight: "is in flight",
  sticking: "sticks to the platform",
  "sliding forward": "slides forward on the platform",
  "sliding backward": "slides backward on the platform",
  held: "is held",
};

export function describeMoment(moment: Moment, periods: number, impacts: number, recording: Recording): string {
  const gap = recording.settled(moment.height - moment.platform_height, "height", "platform_height");
  const speed = (value: number) => plain(recording.settled(value, "angular_speed", "platform_angular_speed"), 3);
  const place = gap > 0 ? `, ${quantity(gap, "m")} above the platform,` : "";
  return (
    `After ${periods.toFixed(2)} periods and ${impacts} impacts the disk ${WORDS[moment.mode] ?? moment.mode}${place} ` +
    `and turns at ${speed(moment.angular_speed)} rad/s; the platform at ${speed(moment.platform_angular_speed)} rad/s.`
  );
}
