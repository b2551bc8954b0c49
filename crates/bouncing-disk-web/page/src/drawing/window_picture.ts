/** A picture with a window that one can zoom and point into: layers, axes, gestures, cursor and buttons together. */

import type { Context } from "../contract";
import { layOut, paintAxes, pixelX, pixelY } from "./axes";
import type { Axis, Plot } from "./axes";
import { button, element, oncePerFrame } from "./elements";
import { Gestures } from "./gestures";
import type { Box, Window2 } from "./gestures";
import { Layers } from "./layers";
import type { Pen } from "./pen";

export interface WindowPictureHost {
  readonly className: string;
  /** What a screen reader says of the picture, with its keys. */
  readonly label: string;
  axes(): { x: Axis; y: Axis };
  /** Draws the data into the plot, clipped to it. */
  paint(pen: Pen, plot: Plot): void;
  window(): Window2;
  move(window: Window2, settled: boolean): void;
  reset(): void;
  point(at: readonly [number, number] | null): void;
  pick(at: readonly [number, number]): void;
}

export const KEYS =
  "Plus and minus zoom, arrows move, 0 shows all; Shift with an arrow moves the cross, Enter chooses what is under it.";

const LETTERS = 13;
const SMALL_LETTERS = 12;

export class WindowPicture {
  readonly layers: Layers;
  readonly tools: HTMLElement;
  /** Where the axes are; null as long as the picture has no size. */
  plot: Plot | null = null;
  private cross: readonly [number, number] | null = null;
  private box: Box | null = null;
  readonly redraw = oncePerFrame(() => this.paintData());
  private readonly redrawCursor = oncePerFrame(() => this.paintCursor());

  constructor(
    private readonly host: WindowPictureHost,
    private readonly context: Context,
  ) {
    this.layers = new Layers(host.className, `${host.label} ${KEYS}`);
    const gestures = new Gestures(this.layers.surface, {
      plot: () => this.plot,
      window: () => host.window(),
      move: (window, settled) => host.move(window, settled),
      reset: () => host.reset(),
      point: (at) => {
        this.cross = at;
        this.redrawCursor();
        host.point(at);
      },
      pick: (at) => host.pick(at),
      rectangle: (box) => {
        this.box = box;
        this.redrawCursor();
      },
    });
    this.tools = element(
      "div",
      { class: "picture-tools", role: "group", "aria-label": "Zoom" },
      button("+", () => gestures.zoom(0.5), { "aria-label": "Zoom in", title: "Zoom in (+)" }),
      button("\u2212", () => gestures.zoom(2), { "aria-label": "Zoom out", title: "Zoom out (-)" }),
      button("All", () => host.reset(), { "aria-label": "Show all", title: "Show all (0)" }),
    );
  }

  /** Lays the axes out for the present size and window; the number of device pixels of the plot, or null. */
  layOut(): { plot: Plot; columns: number; rows: number } | null {
    this.layers.fit();
    const { width, height, ratio } = this.layers;
    if (width < 60 || height < 60) return null;
    const size = width < 480 ? SMALL_LETTERS : LETTERS;
    const { x, y } = this.host.axes();
    const plot = layOut(this.layers.more(), width, height, x, y, size);
    this.plot = plot;
    return { plot, columns: Math.round(plot.width * ratio), rows: Math.round(plot.height * ratio) };
  }

  private paintData(): void {
    const laid = this.layOut();
    if (laid === null) return;
    const { plot } = laid;
    const colour = this.context.colour;
    const pen = this.layers.data(colour);
    pen.clipped(plot.left, plot.top, plot.width, plot.height, () => this.host.paint(pen, plot));
    paintAxes(pen, plot, colour);
    this.paintCursor();
  }

  private paintCursor(): void {
    const pen = this.layers.cursor();
    const { plot, box, cross } = this;
    if (plot === null) return;
    const { colour } = this.context;
    if (cross !== null) {
      const x = pixelX(plot, cross[0]);
      const y = pixelY(plot, cross[1]);
      const right = plot.left + plot.width;
      const bottom = plot.top + plot.height;
      const lines = [x, plot.top, x, bottom, NaN, NaN, plot.left, y, right, y];
      pen.clipped(plot.left, plot.top, plot.width, plot.height, () => {
        pen.path(lines, { stroke: colour("--picture-paper"), width: 3, opacity: 0.6 });
        // In no colour of data, and fine: a cross is not taken for a line of the picture.
        pen.path(lines, { stroke: colour("--picture-text"), width: 1, dash: [1, 2] });
      });
    }
    if (box !== null) {
      const stroke = colour("--picture-selection");
      pen.rect(box.left, box.top, box.width, box.height, { fill: stroke, opacity: 0.15 });
      pen.rect(box.left, box.top, box.width, box.height, { stroke, width: 1.5 });
    }
  }
}

/** Draws a picture of one window into a plot of another, stretched as it has to be. */
export function paintStretched(
  pen: Pen,
  plot: Plot,
  image: HTMLCanvasElement,
  window: { readonly x: readonly [number, number]; readonly y: readonly [number, number] },
): void {
  const left = pixelX(plot, window.x[0]);
  const top = pixelY(plot, window.y[1]);
  pen.image(image, left, top, pixelX(plot, window.x[1]) - left, pixelY(plot, window.y[0]) - top, false);
}
