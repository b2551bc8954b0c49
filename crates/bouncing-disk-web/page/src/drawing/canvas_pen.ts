import { baselineShift, fontOf, measureRuns, SCREEN_FONT, SUBSCRIPT_DROP } from "./pen";
import type { PathStyle, Pen, TextStyle } from "./pen";
import { parseRichText } from "./rich_text";

/** Draws on a canvas whose transform is set to CSS pixels already. */
export class CanvasPen implements Pen {
  constructor(
    readonly context: CanvasRenderingContext2D,
    readonly family: string = SCREEN_FONT,
    /** All widths of lines, and their dashes, times this. */
    private readonly weight = 1,
  ) {}

  get printed(): boolean {
    return this.family !== SCREEN_FONT;
  }

  path(points: ArrayLike<number>, style: PathStyle): void {
    const { context } = this;
    context.beginPath();
    let down = false;
    for (let index = 0; index + 1 < points.length; index += 2) {
      const x = points[index] as number;
      const y = points[index + 1] as number;
      if (Number.isNaN(x) || Number.isNaN(y)) {
        down = false;
      } else if (down) {
        context.lineTo(x, y);
      } else {
        context.moveTo(x, y);
        down = true;
      }
    }
    if (style.close === true) context.closePath();
    this.finish(style);
  }

  circle(x: number, y: number, radius: number, style: PathStyle): void {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    this.finish(style);
  }

  rect(x: number, y: number, width: number, height: number, style: PathStyle): void {
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.finish(style);
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    const { context } = this;
    const width = this.measure(text, style.size);
    context.save();
    context.translate(x, y);
    if (style.upwards === true) context.rotate(-Math.PI / 2);
    context.textAlign = "left";
    context.textBaseline = "alphabetic";
    const top = baselineShift(style.baseline, style.size);
    let left = style.anchor === "middle" ? -width / 2 : style.anchor === "end" ? -width : 0;
    for (const run of parseRichText(text)) {
      context.font = fontOf(run, style.size, this.family, style.bold);
      const drop = run.subscript ? SUBSCRIPT_DROP * style.size : 0;
      if (style.halo !== undefined) {
        context.lineJoin = "round";
        context.lineWidth = 3.5;
        context.strokeStyle = style.halo;
        context.strokeText(run.text, left, top + drop);
      }
      context.fillStyle = style.colour;
      context.fillText(run.text, left, top + drop);
      left += context.measureText(run.text).width;
    }
    context.restore();
  }

  measure(text: string, size: number): number {
    return measureRuns(text, size, this.family);
  }

  image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number, smooth: boolean): void {
    this.context.imageSmoothingEnabled = smooth;
    this.context.drawImage(source, x, y, width, height);
  }

  clipped(x: number, y: number, width: number, height: number, draw: () => void): void {
    this.context.save();
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.context.clip();
    draw();
    this.context.restore();
  }

  private finish(style: PathStyle): void {
    const { context } = this;
    context.globalAlpha = style.opacity ?? 1;
    if (style.fill !== undefined) {
      context.fillStyle = style.fill;
      context.fill();
    }
    if (style.stroke !== undefined) {
      context.strokeStyle = style.stroke;
      context.lineWidth = (style.width ?? 1) * this.weight;
      context.lineJoin = "round";
      context.setLineDash((style.dash ?? []).map((length) => length * this.weight));
      context.stroke();
    }
    context.globalAlpha = 1;
  }
}
