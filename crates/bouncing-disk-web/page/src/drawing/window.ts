/** A picture with a window that one can zoom and point into by wheel, pinch, rectangle and keyboard. */

import { button, debounced, element, oncePerFrame, placeOn } from "../elements";
import type { Range } from "../protocol";
import { WORDS } from "../words";
import { clamp, hairsAt, inside, layOut, paintAxes, valueX, valueY, type Axes, type Plot } from "./axes";
import { CanvasPen, contextOf, type Box, type Pen } from "./pen";

export type Window2 = Readonly<Record<"x" | "y", Range>>;

export type Point = readonly [number, number];

type Place = ReturnType<typeof placeOn>;

export interface PictureHost {
  readonly className: string;
  /** What a screen reader says of the picture, before its keys. */
  readonly label: string;
  axes(): Axes;
  /** Draws the data into the plot, clipped to it. */
  paint(pen: Pen, plot: Plot): void;
  /** Draws what moves more often than the data, above them. */
  paintMarks?(pen: Pen, plot: Plot): void;
  window(): Window2;
  /** Asks for another window; `settled` is false while the gesture goes on. Without it there is no zoom. */
  move?(window: Window2, settled: boolean): void;
  reset?(): void;
  /** The pointer or the keyboard's cross is at this value; null: it left. */
  point?(at: Point | null): void;
  pick(at: Point): void;
}

const TEXTS = WORDS.drawing;

const LETTERS = 13;
const SMALL_LETTERS = 12;

export class WindowPicture {
  readonly layers: Layers;
  readonly tools: HTMLElement;
  /** Where the axes are; null as long as the picture has no size. */
  plot: Plot | null = null;
  private cross: Point | null = null;
  private box: Box | null = null;
  readonly redraw = oncePerFrame(() => this.paintData());
  private readonly redrawCursor = oncePerFrame(() => this.paintCursor());

  constructor(readonly host: PictureHost) {
    const label = [host.label, host.move ? TEXTS.zoom_keys : "", TEXTS.cross_keys].filter(Boolean).join(" ");
    this.layers = new Layers(host.className, label);
    const gestures = new Gestures(this);
    const tool = (text: string, name: string, key: string, act: () => void) =>
      button(text, act, { "aria-label": name, title: `${name} (${key})` });
    this.tools = element(
      "div",
      { class: "picture-tools", role: "group", "aria-label": TEXTS.zoom },
      tool("+", TEXTS.in, "+", () => gestures.zoom(0.5)),
      tool("−", TEXTS.out, "-", () => gestures.zoom(2)),
      tool(TEXTS.all, TEXTS.all_label, "0", () => host.reset?.()),
    );
  }

  point(at: Point | null): void {
    this.cross = at;
    this.redrawCursor();
    this.host.point?.(at);
  }

  rectangle(box: Box | null): void {
    this.box = box;
    this.redrawCursor();
  }

  /** Lays the axes out for the present size and window; the number of device pixels of the plot, or null. */
  layOut(): { plot: Plot; columns: number; rows: number } | null {
    this.layers.fit();
    const { width, height, ratio } = this.layers;
    if (width < 60 || height < 60) return null;
    const plot = layOut(this.layers.more(), width, height, this.host.axes(), width < 480 ? SMALL_LETTERS : LETTERS);
    this.plot = plot;
    return { plot, columns: Math.round(plot.width * ratio), rows: Math.round(plot.height * ratio) };
  }

  paintData(): void {
    const plot = this.layOut()?.plot;
    if (plot === undefined) return;
    const pen = this.layers.data();
    pen.clipped(plot, () => this.host.paint(pen, plot));
    paintAxes(pen, plot);
    this.paintCursor();
  }

  paintCursor(): void {
    const pen = this.layers.cursor();
    const { plot, box, cross } = this;
    if (plot === null) return;
    this.host.paintMarks?.(pen, plot);
    if (cross !== null) {
      const lines = hairsAt(plot, cross);
      pen.clipped(plot, () => {
        pen.path(lines, { stroke: "--picture-paper", width: 3, opacity: 0.6 });
        // In no colour of data, and fine: a cross is not taken for a line of the picture.
        pen.path(lines, { stroke: "--picture-text", width: 1, dash: [1, 2] });
      });
    }
    if (box !== null) {
      const stroke = "--picture-selection";
      pen.rect(box.left, box.top, box.width, box.height, { fill: stroke, opacity: 0.15 });
      pen.rect(box.left, box.top, box.width, box.height, { stroke, width: 1.5 });
    }
  }
}

const SETTLE = 350;
const SMALLEST_DRAG = 6;

/** Zooming and pointing: wheel, pinch, rectangle and keyboard, for every picture that has a window. */
class Gestures {
  private readonly pointers = new Map<number, Place>();
  private begun: (Place & { window: Window2; touch: boolean }) | null = null;
  private pinch: { window: Window2; distance: number; at: Point } | null = null;
  private moved = false;
  private cross: [number, number] | null = null;
  private readonly settle = debounced(SETTLE, () => this.host.move?.(this.host.window(), true));
  private readonly surface: HTMLElement;
  private readonly host: PictureHost;

  constructor(private readonly picture: WindowPicture) {
    const { surface } = picture.layers;
    this.surface = surface;
    this.host = picture.host;
    const listen = <Name extends keyof HTMLElementEventMap>(
      name: Name,
      act: (event: HTMLElementEventMap[Name], plot: Plot) => void,
    ) => {
      const heard = (event: HTMLElementEventMap[Name]) => picture.plot !== null && act(event, picture.plot);
      surface.addEventListener(name, heard, { passive: false });
    };
    if (this.host.move !== undefined) listen("wheel", (event, plot) => this.wheel(event, plot));
    listen("pointerdown", (event, plot) => this.down(event, plot));
    listen("pointermove", (event, plot) => this.follow(event, plot));
    listen("pointerup", (event, plot) => this.up(event, plot));
    listen("pointercancel", (event) => {
      this.release(event);
      picture.rectangle(null);
    });
    listen("pointerleave", (event) => {
      if (event.pointerType === "mouse" && this.begun === null) picture.point(null);
    });
    listen("keydown", (event) => this.key(event));
    // Two fingers zoom the picture and not the page; one finger still scrolls the page.
    for (const name of ["touchstart", "touchmove"] as const)
      listen(name, (event) => {
        if (event.touches.length >= 2) event.preventDefault();
      });
    surface.style.touchAction = "pan-y";
  }

  zoom(factor: number): void {
    const { x, y } = this.host.window();
    this.host.move?.({ x: scaled(x, (x[0] + x[1]) / 2, factor), y: scaled(y, (y[0] + y[1]) / 2, factor) }, true);
  }

  private wheel(event: WheelEvent, plot: Plot): void {
    event.preventDefault();
    const { x, y } = placeOn(this.surface, event);
    const lines = event.deltaMode === 1 ? 16 : 1;
    const factor = Math.exp(clamp(event.deltaY * lines, -200, 200) * 0.002);
    const window = this.host.window();
    // Beside an axis, only that axis.
    const [onlyX, onlyY] = [y > plot.top + plot.height, x < plot.left];
    this.move({
      x: onlyY ? window.x : scaled(window.x, valueX(plot, x), factor),
      y: onlyX ? window.y : scaled(window.y, valueY(plot, y), factor),
    });
  }

  /** Moves now, and says that it is settled when nothing has come for a while. */
  private move(window: Window2): void {
    this.host.move?.(window, false);
    this.settle();
  }

  private down(event: PointerEvent, plot: Plot): void {
    if (event.button > 0) return;
    const at = placeOn(this.surface, event);
    this.pointers.set(event.pointerId, at);
    this.surface.setPointerCapture(event.pointerId);
    if (this.pointers.size === 2) {
      const [one, two] = [...this.pointers.values()] as [Place, Place];
      this.begun = null;
      this.picture.rectangle(null);
      const middle: Point = [valueX(plot, (one.x + two.x) / 2), valueY(plot, (one.y + two.y) / 2)];
      this.pinch = { window: this.host.window(), distance: this.distance(), at: middle };
    } else if (this.pointers.size === 1 && inside(plot, at.x, at.y)) {
      this.begun = { ...at, window: this.host.window(), touch: event.pointerType === "touch" };
      this.moved = false;
    }
  }

  /** Between the first two fingers. */
  private distance(): number {
    const [one, two] = [...this.pointers.values()] as [Place, Place];
    return Math.max(Math.hypot(one.x - two.x, one.y - two.y), 10);
  }

  private follow(event: PointerEvent, plot: Plot): void {
    const at = placeOn(this.surface, event);
    const { pinch, begun } = this;
    if (this.pointers.has(event.pointerId)) this.pointers.set(event.pointerId, at);
    if (pinch !== null && this.pointers.size >= 2) {
      const { window, at: centre } = pinch;
      const factor = pinch.distance / this.distance();
      this.moved = true;
      this.move({ x: scaled(window.x, centre[0], factor), y: scaled(window.y, centre[1], factor) });
    } else if (begun !== null) {
      this.moved ||= Math.hypot(at.x - begun.x, at.y - begun.y) >= SMALLEST_DRAG;
      const { x, y } = begun.window;
      if (!this.moved) return;
      if (begun.touch) this.move({ x: shifted(x, (begun.x - at.x) / plot.width), y });
      else this.picture.rectangle(boxOf(plot, begun, at));
    } else this.picture.point(inside(plot, at.x, at.y) ? [valueX(plot, at.x), valueY(plot, at.y)] : null);
  }

  private up(event: PointerEvent, plot: Plot): void {
    const { begun } = this;
    const at = placeOn(this.surface, event);
    this.release(event);
    if (begun === null) return;
    if (!this.moved) {
      const value: Point = [valueX(plot, at.x), valueY(plot, at.y)];
      this.picture.point(value);
      this.host.pick(value);
    } else if (!begun.touch) {
      const { left, top, width, height } = boxOf(plot, begun, at);
      const { x, y } = begun.window;
      this.picture.rectangle(null);
      // A flat rectangle chooses a range of one axis.
      const across: Range = width >= SMALLEST_DRAG ? [valueX(plot, left), valueX(plot, left + width)] : x;
      const up: Range = height >= SMALLEST_DRAG ? [valueY(plot, top + height), valueY(plot, top)] : y;
      this.host.move?.({ x: across, y: up }, true);
    }
  }

  private release(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.begun = null;
    if (this.pointers.size < 2) this.pinch = null;
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey) return;
    const window = this.host.window();
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const [right = 0, up = 0] = arrow ?? [];
    if (arrow !== undefined && event.shiftKey) this.moveCross(right, up, window);
    else if (arrow !== undefined) this.move({ x: shifted(window.x, right * 0.1), y: shifted(window.y, up * 0.1) });
    else if (event.key === "+" || event.key === "=") this.zoom(0.5);
    else if (event.key === "-") this.zoom(2);
    else if (event.key === "0") this.host.reset?.();
    else if (event.key === "Enter" && this.cross !== null) this.host.pick(this.cross);
    else if (event.key === "Escape") {
      this.begun = null;
      this.picture.rectangle(null);
      this.picture.point(null);
    } else return;
    event.preventDefault();
  }

  /** The keyboard's own cursor, by a fiftieth of the window; it begins in the middle. */
  private moveCross(right: number, up: number, { x, y }: Window2): void {
    const within = ([low, high]: Range, at = NaN) => (at >= low && at <= high ? at : (low + high) / 2);
    const from = [within(x, this.cross?.[0]), within(y, this.cross?.[1])] as const;
    const along = ([low, high]: Range, at: number, steps: number) => clamp(at + (steps * (high - low)) / 50, low, high);
    this.cross = [along(x, from[0], right), along(y, from[1], up)];
    this.picture.point(this.cross);
  }
}

const scaled = ([low, high]: Range, centre: number, factor: number): Range =>
  [centre + (low - centre) * factor, centre + (high - centre) * factor];

function shifted([low, high]: Range, share: number): Range {
  const by = (high - low) * share;
  return [low + by, high + by];
}

function boxOf({ left, top, width, height }: Plot, from: Place, to: Place): Box {
  const [x1, x2] = [from.x, to.x].map((x) => clamp(x, left, left + width)) as Range;
  const [y1, y2] = [from.y, to.y].map((y) => clamp(y, top, top + height)) as Range;
  return { left: Math.min(x1, x2), top: Math.min(y1, y2), width: Math.abs(x1 - x2), height: Math.abs(y1 - y2) };
}

/** A window from `least` to `most` wide, within limits; one that would not be keeps the last middle. */
export function confined(wanted: Range, [least, most]: Range, [bottom, top]: Range, before = wanted): Range {
  const width = clamp(wanted[1] - wanted[0], least, Math.min(most, top - bottom));
  const [low, high] = width === wanted[1] - wanted[0] ? wanted : before;
  const middle = clamp((low + high) / 2, bottom + width / 2, top - width / 2);
  return [middle - width / 2, middle + width / 2];
}

/** Two canvases on each other at the screen's own pixels: data below, and the cursor, which moves often, above. */
export class Layers {
  /** The upper one, which takes the keyboard and the pointer. */
  readonly surface: HTMLCanvasElement;
  private readonly lower = element("canvas", { "aria-hidden": "true" });
  readonly root: HTMLElement;
  width = 0;
  height = 0;
  ratio = 1;

  constructor(className: string, label: string) {
    this.surface = element("canvas", { tabindex: 0, role: "application", "aria-label": label });
    this.root = element("div", { class: `picture ${className}` }, this.lower, this.surface);
  }

  /** Takes the size of the element. True if it is another one, which empties both canvases. */
  fit(): boolean {
    const { clientWidth: width, clientHeight: height } = this.root;
    const ratio = window.devicePixelRatio || 1;
    if (width === this.width && height === this.height && ratio === this.ratio) return false;
    Object.assign(this, { width, height, ratio });
    for (const canvas of [this.lower, this.surface]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    return true;
  }

  /** A pen for the data, on clean paper. */
  data(): Pen {
    const pen = this.more();
    pen.rect(0, 0, this.width, this.height, { fill: "--picture-paper" });
    return pen;
  }

  /** A pen for the data, over what is there already. */
  more(): Pen {
    return new CanvasPen(this.scaled(this.lower));
  }

  /** A pen for the cursor, on a clean transparent sheet. */
  cursor(): Pen {
    const context = this.scaled(this.surface);
    context.clearRect(0, 0, this.width, this.height);
    return new CanvasPen(context);
  }

  private scaled(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
    const context = contextOf(canvas);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    return context;
  }
}
