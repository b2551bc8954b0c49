import { baselineShift, measureRuns, PRINT_FONT, PRINT_WEIGHT, SUBSCRIPT_DROP, SUBSCRIPT_SIZE } from "./pen";
import type { PathStyle, Pen, TextStyle } from "./pen";
import { parseRichText } from "./rich_text";

/** Writes SVG with words as text, so that they can be edited and searched. */
export class SvgPen implements Pen {
  readonly printed = true;
  private readonly parts: string[] = [];
  private clips = 0;

  constructor(
    private readonly width: number,
    private readonly height: number,
    private readonly family: string = PRINT_FONT,
  ) {}

  path(points: ArrayLike<number>, style: PathStyle): void {
    let data = "";
    let down = false;
    for (let index = 0; index + 1 < points.length; index += 2) {
      const x = points[index] as number;
      const y = points[index + 1] as number;
      if (Number.isNaN(x) || Number.isNaN(y)) {
        down = false;
      } else {
        data += `${down ? "L" : "M"}${short(x)} ${short(y)}`;
        down = true;
      }
    }
    if (data !== "") this.parts.push(`<path d="${data}${style.close === true ? "Z" : ""}"${attributes(style)}/>`);
  }

  circle(x: number, y: number, radius: number, style: PathStyle): void {
    this.parts.push(`<circle cx="${short(x)}" cy="${short(y)}" r="${short(radius)}"${attributes(style)}/>`);
  }

  rect(x: number, y: number, width: number, height: number, style: PathStyle): void {
    this.parts.push(`<rect ${box(x, y, width, height)}${attributes(style)}/>`);
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    const shift = baselineShift(style.baseline, style.size);
    const turn = style.upwards === true ? ` transform="rotate(-90 ${short(x)} ${short(y)})"` : "";
    const halo =
      style.halo === undefined
        ? ""
        : ` stroke="${escape(style.halo)}" stroke-width="2.5" stroke-linejoin="round" paint-order="stroke"`;
    let hung = 0;
    const runs = parseRichText(text).map((run) => {
      const drop = run.subscript ? SUBSCRIPT_DROP * style.size : 0;
      const size = run.subscript ? ` font-size="${short(style.size * SUBSCRIPT_SIZE)}"` : "";
      const slant = run.italic ? ' font-style="italic"' : "";
      const step = drop - hung;
      hung = drop;
      return `<tspan${step === 0 ? "" : ` dy="${short(step)}"`}${size}${slant}>${escape(run.text)}</tspan>`;
    });
    const anchor = style.anchor ?? "start";
    this.parts.push(
      `<text x="${short(x)}" y="${short(y + shift)}" text-anchor="${anchor}" fill="${escape(style.colour)}"` +
        ` font-size="${short(style.size)}"${style.bold === true ? ' font-weight="600"' : ""}${halo}${turn}` +
        ` xml:space="preserve">${runs.join("")}</text>`,
    );
  }

  measure(text: string, size: number): number {
    return measureRuns(text, size, this.family);
  }

  image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number, smooth: boolean): void {
    const rendering = smooth ? "" : ' image-rendering="optimizeSpeed"';
    const form = `preserveAspectRatio="none"${rendering}`;
    this.parts.push(`<image ${box(x, y, width, height)} ${form} href="${source.toDataURL("image/png")}"/>`);
  }

  clipped(x: number, y: number, width: number, height: number, draw: () => void): void {
    this.clips += 1;
    const id = `clip-${this.clips}`;
    this.parts.push(`<clipPath id="${id}"><rect ${box(x, y, width, height)}/></clipPath><g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  /** All of it. A length of 1 is a point, as journals give the widths of their columns. */
  finish(title: string, paper: string): string {
    const { width, height } = this;
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${short(width)}pt" height="${short(height)}pt"` +
      ` viewBox="0 0 ${short(width)} ${short(height)}" font-family='${escape(this.family)}' role="img">` +
      `<title>${escape(title)}</title><rect width="100%" height="100%" fill="${escape(paper)}"/>` +
      `${this.parts.join("\n")}</svg>\n`
    );
  }
}

function box(x: number, y: number, width: number, height: number): string {
  return `x="${short(x)}" y="${short(y)}" width="${short(width)}" height="${short(height)}"`;
}

function attributes(style: PathStyle): string {
  const { stroke, dash } = style;
  return (
    ` fill="${escape(style.fill ?? "none")}"` +
    (stroke === undefined
      ? ""
      : ` stroke="${escape(stroke)}" stroke-width="${short((style.width ?? 1) * PRINT_WEIGHT)}"`) +
    (stroke === undefined || dash === undefined || dash.length === 0
      ? ""
      : ` stroke-dasharray="${dash.map((length) => short(length * PRINT_WEIGHT)).join(" ")}"`) +
    (stroke === undefined ? "" : ' stroke-linejoin="round"') +
    (style.opacity === undefined ? "" : ` opacity="${style.opacity}"`)
  );
}

function short(value: number): string {
  return String(Math.round(value * 100) / 100);
}

function escape(text: string): string {
  return text
    .replace(/&/g, "&amp;")
    .replace(/</g, "&lt;")
    .replace(/>/g, "&gt;")
    .replace(/"/g, "&quot;")
    .replace(/'/g, "&#39;");
}
