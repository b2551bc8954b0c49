/** The impacts in the plane of phase and speed, growing with the motion. A click there is another start. */

import type { Context } from "../../contract";
import { layOut, paintAxes, pixelX, pixelY } from "../../drawing/axes";
import type { Axis, Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import { Gestures } from "../../drawing/gestures";
import { Layers } from "../../drawing/layers";
import type { Pen } from "../../drawing/pen";
import { linearScale, roundUp } from "../../drawing/scale";
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
  private cross: readonly [number, number] | null = null;

  constructor(
    private readonly context: Context,
    choose: (phasePeriods: number, speed: number) => void,
  ) {
    new Gestures(this.layers.surface, {
      plot: () => this.plot,
      window: () => ({ x: [0, 1], y: [0, this.top] }),
      move: () => undefined,
      reset: () => undefined,
      point: (at) => {
        this.cross = at;
        this.paintCursor();
      },
      pick: ([phase, speed]) => choose(phase, speed),
      rectangle: () => undefined,
    });
  }

  /** Draws the first `count` impacts: only the new ones, where the others are there. */
  show(recording: Recording, start: ImpactStart, count: number, anew: boolean): void {
    this.start = start;
    const resized = this.layers.fit();
    if (this.layers.width < 60) return;
    const speeds = recording.impacts.slice(0, 4000).map((impact) => impact.normalised_speed);
    const highest = Math.max(...speeds, start.normalised_speed, 1e-6);
    const top = this.recording === recording ? this.top : roundUp(highest * 1.02);
    this.recording = recording;
    if (anew || resized || this.plot === null || count < this.drawn || top !== this.top) {
      this.top = top;
      this.drawn = 0;
      const { colour } = this.context;
      const pen = this.layers.data(colour);
      const { x, y } = this.axes();
      this.plot = layOut(pen, this.layers.width, this.layers.height, x, y, SIZE);
      paintAxes(pen, this.plot, colour);
    }
    paintImpacts(this.layers.more(), this.plot, recording.impacts.slice(this.drawn, count), this.context.colour);
    this.drawn = count;
    this.paintCursor();
  }

  axes(): { x: Axis; y: Axis } {
    return {
      x: { label: "phase of impact *τ*_{imp}/2π (periods)", scale: linearScale([0, 1]) },
      y: { label: "impact speed |*w*_{A}Γ/(*ωA*)|", scale: linearScale([0, this.top]) },
    };
  }

  private paintCursor(): void {
    const pen = this.layers.cursor();
    const { plot, cross, context } = this;
    const last = this.recording?.impacts[this.drawn - 1];
    if (plot === null) return;
    const { start } = this;
    if (start !== null && start.normalised_speed <= this.top) {
      const x = pixelX(plot, start.impact_phase / (2 * Math.PI) - Math.floor(start.impact_phase / (2 * Math.PI)));
      const y = pixelY(plot, start.normalised_speed);
      const style = { stroke: context.colour("--disk"), width: 1.8 };
      pen.path([x - 6, y, x + 6, y, NaN, NaN, x, y - 6, x, y + 6], style);
    }
    if (last !== undefined) {
      const style = { stroke: context.colour("--impact-now"), width: 2.2 };
      pen.circle(pixelX(plot, periods(last)), pixelY(plot, last.normalised_speed), 6, style);
    }
    if (cross !== null) {
      const x = pixelX(plot, cross[0]);
      const y = pixelY(plot, cross[1]);
      const lines = [x, plot.top, x, plot.top + plot.height, NaN, NaN, plot.left, y, plot.left + plot.width, y];
      pen.path(lines, { stroke: context.colour("--picture-cursor"), width: 1 });
    }
  }
}

export function paintImpacts(pen: Pen, plot: Plot, impacts: readonly Impact[], colour: Colours, size = 2.6): void {
  // One path with small squares for all of them.
  const points: number[] = [];
  for (const impact of impacts) {
    const x = pixelX(plot, periods(impact));
    const y = pixelY(plot, impact.normalised_speed);
    const half = size / 2;
    points.push(x - half, y - half, x + half, y - half, x + half, y + half, x - half, y + half, NaN, NaN);
  }
  pen.path(points, { fill: colour("--impact"), opacity: 0.75 });
}

function periods({ phase }: Impact): number {
  const turns = phase / (2 * Math.PI);
  return turns - Math.floor(turns);
}
