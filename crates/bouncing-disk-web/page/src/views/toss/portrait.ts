/** The impacts in the plane of phase and speed, growing with the motion. A click there is another start. */

import { crossAt, hairsAt, layOut, paintAxes, pixelX, pixelY, roundUp, type Axes, type Plot } from "../../drawing/axes";
import type { Pen } from "../../drawing/pen";
import { Gestures, Layers, type Point } from "../../drawing/window";
import type { ImpactStart } from "../../protocol";
import type { Impact, Recording } from "./recording";

const SIZE = 12;

export class Portrait {
  readonly layers = new Layers(
    "picture-portrait",
    "Phase portrait of the impacts. Shift with an arrow moves the cross, Enter makes it the start.",
  );
  private plot: Plot | null = null;
  private drawn = 0;
  private top = 1;
  private recording: Recording | null = null;
  private start: ImpactStart | null = null;
  private cross: Point | null = null;

  /** `pick` gets a phase in periods and a normalised speed. */
  constructor(pick: (at: Point) => void) {
    new Gestures(this.layers.surface, {
      plot: () => this.plot,
      window: () => ({ x: [0, 1], y: [0, this.top] }),
      point: (at) => {
        this.cross = at;
        this.paintCursor();
      },
      pick,
    });
  }

  /** Draws the first `count` impacts: only the new ones, where the others are there. */
  show(recording: Recording, start: ImpactStart, count: number, anew: boolean): void {
    this.start = start;
    const { layers } = this;
    const resized = layers.fit();
    if (layers.width < 60) return;
    const speeds = recording.impacts.slice(0, 4000).map((impact) => impact.normalised_speed);
    const highest = Math.max(...speeds, start.normalised_speed, 1e-6);
    const top = this.recording === recording ? this.top : roundUp(highest * 1.02);
    this.recording = recording;
    if (anew || resized || this.plot === null || count < this.drawn || top !== this.top) {
      this.top = top;
      this.drawn = 0;
      const pen = layers.data();
      this.plot = layOut(pen, layers.width, layers.height, this.axes(), SIZE);
      paintAxes(pen, this.plot);
    }
    paintImpacts(layers.more(), this.plot, recording.impacts.slice(this.drawn, count));
    this.drawn = count;
    this.paintCursor();
  }

  axes(): Axes {
    return {
      x: { label: "phase of impact *τ*_{imp}/2π (periods)", range: [0, 1] },
      y: { label: "impact speed |*w*_{A}Γ/(*ωA*)|", range: [0, this.top] },
    };
  }

  private paintCursor(): void {
    const pen = this.layers.cursor();
    const { plot, cross, start } = this;
    const last = this.recording?.impacts[this.drawn - 1];
    if (plot === null) return;
    if (start !== null && start.normalised_speed <= this.top) {
      const [x, y] = [pixelX(plot, periods(start.impact_phase)), pixelY(plot, start.normalised_speed)];
      pen.path(crossAt(x, y, 6, true), { stroke: "--disk", width: 1.8 });
    }
    if (last !== undefined) {
      const [x, y] = [pixelX(plot, periods(last.phase)), pixelY(plot, last.normalised_speed)];
      pen.circle(x, y, 6, { stroke: "--impact-now", width: 2.2 });
    }
    if (cross !== null) pen.path(hairsAt(plot, cross), { stroke: "--picture-cursor", width: 1 });
  }
}

export function paintImpacts(pen: Pen, plot: Plot, impacts: readonly Impact[], size = 2.6): void {
  // One path with small squares for all of them.
  const points: number[] = [];
  for (const impact of impacts) {
    const x = pixelX(plot, periods(impact.phase));
    const y = pixelY(plot, impact.normalised_speed);
    const half = size / 2;
    points.push(x - half, y - half, x + half, y - half, x + half, y + half, x - half, y + half, NaN, NaN);
  }
  pen.path(points, { fill: "--impact", opacity: 0.75 });
}

function periods(phase: number): number {
  const turns = phase / (2 * Math.PI);
  return turns - Math.floor(turns);
}
