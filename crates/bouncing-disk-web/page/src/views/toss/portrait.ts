/** The impacts in the plane of phase and speed, growing with the motion. A click there is another start. */

import { crossAt, pixelX, pixelY, roundUp, type Axes, type Plot } from "../../drawing/axes";
import type { Pen } from "../../drawing/pen";
import { WindowPicture, type Point } from "../../drawing/window";
import { element, setText } from "../../elements";
import { plain } from "../../numbers";
import type { ImpactStart, Range } from "../../protocol";
import { say, WORDS } from "../../words";
import type { Impact, Recording } from "./recording";

export class Portrait {
  readonly picture: WindowPicture;
  readonly reading = element("p", { class: "reading", "aria-live": "polite" });
  /** How many impacts are to be seen. */
  private shown = 0;
  private top = 1;
  private recording: Recording | null = null;
  private start: ImpactStart | null = null;

  /** `pick` gets a phase in periods and a normalised speed. */
  constructor(pick: (at: Point) => void) {
    this.picture = new WindowPicture({
      className: "picture-portrait",
      label: WORDS.toss.portrait_label,
      axes: () => this.axes(),
      paint: (pen, plot) => paintImpacts(pen, plot, this.recording?.impacts.slice(0, this.shown) ?? []),
      paintMarks: (pen, plot) => this.paintMarks(pen, plot),
      window: () => ({ x: [0, 1], y: [0, this.top] }),
      point: (at) => {
        const [phase, speed] = (at ?? []).map((value) => plain(value, 3));
        setText(this.reading, phase && speed ? say(WORDS.toss.impact_reading, { phase, speed }) : "");
      },
      pick,
    });
  }

  /** Draws the first `count` impacts: only the new ones, where the others are there. */
  show(recording: Recording, start: ImpactStart, count: number, anew: boolean): void {
    const { picture, shown } = this;
    const speeds = recording.impacts.slice(0, 4000).map((impact) => impact.normalised_speed);
    const highest = Math.max(...speeds, start.normalised_speed, 1e-6);
    const top = this.recording === recording ? this.top : roundUp(highest * 1.02);
    const whole = picture.layers.fit() || anew || count < shown || top !== this.top;
    Object.assign(this, { recording, start, top, shown: count });
    if (whole || picture.plot === null) picture.paintData();
    else {
      paintImpacts(picture.layers.more(), picture.plot, recording.impacts.slice(shown, count));
      picture.paintCursor();
    }
  }

  axes(): Axes {
    const y = { label: WORDS.axes.speed_short, range: [0, this.top] as Range };
    return { x: { label: WORDS.axes.phase, range: [0, 1] }, y };
  }

  private paintMarks(pen: Pen, plot: Plot): void {
    const { start } = this;
    const last = this.recording?.impacts[this.shown - 1];
    if (start !== null && start.normalised_speed <= this.top) {
      const [x, y] = [pixelX(plot, periods(start.impact_phase)), pixelY(plot, start.normalised_speed)];
      pen.path(crossAt(x, y, 6, true), { stroke: "--disk", width: 1.8 });
    }
    if (last !== undefined) {
      const [x, y] = [pixelX(plot, periods(last.phase)), pixelY(plot, last.normalised_speed)];
      pen.circle(x, y, 6, { stroke: "--impact-now", width: 2.2 });
    }
  }
}

export function paintImpacts(pen: Pen, plot: Plot, impacts: readonly Impact[], size = 2.6): void {
  // One path with small squares for all of them.
  const half = size / 2;
  const points = impacts.flatMap((impact) => {
    const [x, y] = [pixelX(plot, periods(impact.phase)), pixelY(plot, impact.normalised_speed)];
    return [x - half, y - half, x + half, y - half, x + half, y + half, x - half, y + half, NaN, NaN];
  });
  pen.path(points, { fill: "--impact", opacity: 0.75 });
}

function periods(phase: number): number {
  const turns = phase / (2 * Math.PI);
  return turns - Math.floor(turns);
}
