/** A moment of the motion in words. */

import { plain, quantity } from "../../drawing/numbers";
import type { Moment } from "./recording";

export function describeMoment(moment: Moment, periods: number, impacts: number): string {
  const gap = quantity(Math.max(moment.height - moment.platform_height, 0), "m");
  const [disk, platform] = [plain(moment.angular_speed, 3), plain(moment.platform_angular_speed, 3)];
  return (
    `After ${periods.toFixed(2)} periods and ${impacts} impacts the disk is in ${moment.mode}, ${gap} above the ` +
    `platform, and turns at ${disk} rad/s; the platform at ${platform} rad/s.`
  );
}
