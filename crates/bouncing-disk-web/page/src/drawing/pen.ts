/** What draws lines, areas and words: on the screen in CSS pixels, or for print into SVG in points. */

/** Gives the colour of a custom property that `theme.css` lists. */
export type Colours = (name: string) => string;

function colourIn(dark: boolean, name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  return value.replace(/^light-dark\(([^,]*), *(.*)\)$/, dark ? "$2" : "$1");
}

/** Whether the system asks for a dark page. */
export const darkness = (): MediaQueryList => window.matchMedia("(prefers-color-scheme: dark)");
/** The colours of the page, and those of print, which are the light ones in any case. */
export const themeColour: Colours = (name) => colourIn(darkness().matches, name);
export const printedColour: Colours = (name) => colourIn(false, name);

/** Colours are the names of custom properties of `theme.css`. */
export interface PathStyle {
  stroke?: string;
  width?: number;
  dash?: readonly number[];
  fill?: string;
  opacity?: number;
  close?: boolean;
}

export interface TextStyle {
  colour: string;
  size: number;
  anchor?: "start" | "middle" | "end";
  baseline?: "top" | "middle" | "bottom";
  /** Turned by a quarter against the clock. */
  upwards?: boolean;
}

export type Box = Readonly<Record<"left" | "top" | "width" | "height", number>>;

export abstract class Pen {
  constructor(
    /** On paper lines stand where they belong, on a screen in the middle of pixels. */
    readonly printed: boolean,
    readonly colour: Colours,
    protected readonly family: string,
  ) {}

  /** A polyline through x, y, x, y, ...; NaN lifts the pen. */
  abstract path(points: ArrayLike<number>, style: PathStyle): void;
  abstract circle(x: number, y: number, radius: number, style: PathStyle): void;
  abstract rect(x: number, y: number, width: number, height: number, style: PathStyle): void;
  /** Words with *italic* letters and subscripts_{like this}. */
  abstract text(text: string, x: number, y: number, style: TextStyle): void;
  abstract image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number): void;
  /** Draws nothing outside of a box. */
  abstract clipped(to: Box, draw: () => void): void;

  measure(text: string, size: number): number {
    return measureRuns(text, size, this.family);
  }
}

/** The size of a subscript relative to its line, and how far it hangs below. */
const SUBSCRIPT_SIZE = 0.74;
const SUBSCRIPT_DROP = 0.22;

/** Where a line's baseline is relative to the place asked for, in sizes of its letters. */
const BASELINE = { top: 0.8, middle: 0.34, bottom: -0.2 } as const;
const baselineOf = ({ baseline, size }: TextStyle): number => (baseline === undefined ? 0 : BASELINE[baseline] * size);

/** Lines of print are finer than those of screens. */
const PRINT_WEIGHT = 0.6;

const SCREEN_FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif';
export const PRINT_FONT = '"STIX Two Text", "Times New Roman", Tinos, "Liberation Serif", "DejaVu Serif", serif';

type Run = Readonly<{ text: string; italic: boolean; subscript: boolean }>;

/** The little markup of labels: `*tau*` is italic and `_{imp}` a subscript. */
function runsOf(text: string): Run[] {
  const runs: Run[] = [];
  let italic = false;
  let subscript = false;
  for (const part of text.split(/(\*|_\{|\})/)) {
    if (part === "*") italic = !italic;
    else if (part === "_{") subscript = true;
    else if (part === "}" && subscript) subscript = false;
    else if (part !== "") runs.push({ text: part, italic, subscript });
  }
  return runs;
}

/** The markup of a symbol of the form, `φ_L`; capital Greek letters are upright. */
export const marked = (symbol: string): string =>
  symbol.replace(/^[^ΓΦ_]+/, "*$&*").replace(/_(\w+)/, "_{$1}");

/** The same without markup, for plain text. */
export const plainText = (text: string): string => runsOf(text).reduce((plain, run) => plain + run.text, "");

const fontOf = ({ italic, subscript }: Run, size: number, family: string): string =>
  `${italic ? "italic " : ""}${subscript ? size * SUBSCRIPT_SIZE : size}px ${family}`;

let ruler: CanvasRenderingContext2D | undefined;

export function measureRuns(text: string, size: number, family: string): number {
  const context = (ruler ??= contextOf(document.createElement("canvas")));
  return runsOf(text).reduce((width, run) => {
    context.font = fontOf(run, size, family);
    return width + context.measureText(run.text).width;
  }, 0);
}

export function contextOf(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const context = canvas.getContext("2d");
  if (context === null) throw new Error("this browser gives no canvas to draw on");
  return context;
}

/** Words in lines of print that are no longer than `room`. */
export function wrapped(text: string, size: number, room: number): string[] {
  const lines: string[] = [];
  let line = "";
  for (const word of text.split(" ")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && measureRuns(longer, size, PRINT_FONT) > room) {
      lines.push(line);
      line = word;
    } else line = longer;
  }
  return [...lines, line];
}

/** Follows a polyline; `down` is false where the pen has been lifted. */
function trace(points: ArrayLike<number>, to: (x: number, y: number, down: boolean) => void): void {
  let down = false;
  for (let index = 0; index + 1 < points.length; index += 2) {
    const [x, y] = [points[index] as number, points[index + 1] as number];
    const lifted = Number.isNaN(x) || Number.isNaN(y);
    if (!lifted) to(x, y, down);
    down = !lifted;
  }
}

/** Draws on a canvas of the screen whose transform is set to CSS pixels already. */
export class CanvasPen extends Pen {
  constructor(private readonly context: CanvasRenderingContext2D) {
    super(false, themeColour, SCREEN_FONT);
  }

  path(points: ArrayLike<number>, style: PathStyle): void {
    const shape = new Path2D();
    trace(points, (x, y, down) => (down ? shape.lineTo(x, y) : shape.moveTo(x, y)));
    if (style.close === true) shape.closePath();
    this.draw(shape, style);
  }

  circle(x: number, y: number, radius: number, style: PathStyle): void {
    const shape = new Path2D();
    shape.arc(x, y, radius, 0, 2 * Math.PI);
    this.draw(shape, style);
  }

  rect(x: number, y: number, width: number, height: number, style: PathStyle): void {
    const shape = new Path2D();
    shape.rect(x, y, width, height);
    this.draw(shape, style);
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    const { context, family } = this;
    const width = this.measure(text, style.size);
    context.save();
    context.translate(x, y);
    if (style.upwards === true) context.rotate(-Math.PI / 2);
    let left = -width * { start: 0, middle: 0.5, end: 1 }[style.anchor ?? "start"];
    for (const run of runsOf(text)) {
      context.font = fontOf(run, style.size, family);
      const top = baselineOf(style) + (run.subscript ? SUBSCRIPT_DROP * style.size : 0);
      context.fillStyle = this.colour(style.colour);
      context.fillText(run.text, left, top);
      left += context.measureText(run.text).width;
    }
    context.restore();
  }

  image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number): void {
    this.context.imageSmoothingEnabled = false;
    this.context.drawImage(source, x, y, width, height);
  }

  clipped({ left, top, width, height }: Box, draw: () => void): void {
    this.context.save();
    this.context.beginPath();
    this.context.rect(left, top, width, height);
    this.context.clip();
    draw();
    this.context.restore();
  }

  private draw(shape: Path2D, { fill, stroke, width = 1, dash = [], opacity = 1 }: PathStyle): void {
    const { context } = this;
    context.globalAlpha = opacity;
    if (fill !== undefined) {
      context.fillStyle = this.colour(fill);
      context.fill(shape);
    }
    if (stroke !== undefined) {
      Object.assign(context, { strokeStyle: this.colour(stroke), lineWidth: width, lineJoin: "round" });
      context.setLineDash([...dash]);
      context.stroke(shape);
    }
    context.globalAlpha = 1;
  }
}

/** Writes SVG with words as text, so that they can be edited and searched. */
export class SvgPen extends Pen {
  private readonly parts: string[] = [];
  private clips = 0;

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {
    super(true, printedColour, PRINT_FONT);
  }

  path(points: ArrayLike<number>, style: PathStyle): void {
    let data = "";
    trace(points, (x, y, down) => (data += `${down ? "L" : "M"}${short(x)} ${short(y)}`));
    if (data !== "") this.parts.push(`<path d="${data}${style.close === true ? "Z" : ""}"${attributes(style)}/>`);
  }

  circle(x: number, y: number, radius: number, style: PathStyle): void {
    this.parts.push(`<circle cx="${short(x)}" cy="${short(y)}" r="${short(radius)}"${attributes(style)}/>`);
  }

  rect(x: number, y: number, width: number, height: number, style: PathStyle): void {
    this.parts.push(`<rect ${box(x, y, width, height)}${attributes(style)}/>`);
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    const { size, colour, anchor = "start" } = style;
    const turn = style.upwards === true ? ` transform="rotate(-90 ${short(x)} ${short(y)})"` : "";
    let hung = 0;
    const runs = runsOf(text).map((run) => {
      const drop = run.subscript ? SUBSCRIPT_DROP * size : 0;
      const small = run.subscript ? ` font-size="${short(size * SUBSCRIPT_SIZE)}"` : "";
      const slant = run.italic ? ' font-style="italic"' : "";
      const step = drop === hung ? "" : ` dy="${short(drop - hung)}"`;
      hung = drop;
      return `<tspan${step}${small}${slant}>${escape(run.text)}</tspan>`;
    });
    const place = `x="${short(x)}" y="${short(y + baselineOf(style))}" text-anchor="${anchor}"`;
    const letters = `fill="${printedColour(colour)}" font-size="${short(size)}"${turn} xml:space="preserve"`;
    this.parts.push(`<text ${place} ${letters}>${runs.join("")}</text>`);
  }

  image(source: HTMLCanvasElement, x: number, y: number, width: number, height: number): void {
    const form = 'preserveAspectRatio="none" image-rendering="optimizeSpeed"';
    this.parts.push(`<image ${box(x, y, width, height)} ${form} href="${source.toDataURL("image/png")}"/>`);
  }

  clipped({ left, top, width, height }: Box, draw: () => void): void {
    this.clips += 1;
    const id = `clip-${this.clips}`;
    this.parts.push(`<clipPath id="${id}"><rect ${box(left, top, width, height)}/></clipPath>`);
    this.parts.push(`<g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  /** All of it. A length of 1 is a point, as journals give the widths of their columns. */
  finish(title: string, description: string, metadata: string): string {
    const [width, height] = [short(this.width), short(this.height)];
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}pt" height="${height}pt"` +
      ` viewBox="0 0 ${width} ${height}" font-family="${escape(PRINT_FONT)}" role="img">` +
      `<title>${escape(title)}</title><desc>${escape(description)}</desc>` +
      `<metadata>${escape(metadata)}</metadata><rect width="100%" height="100%" fill="${printedColour("--picture-paper")}"/>` +
      `${this.parts.join("\n")}</svg>\n`
    );
  }
}

const box = (x: number, y: number, width: number, height: number): string =>
  `x="${short(x)}" y="${short(y)}" width="${short(width)}" height="${short(height)}"`;

function attributes({ fill, stroke, width = 1, dash = [], opacity }: PathStyle): string {
  const area = ` fill="${fill === undefined ? "none" : printedColour(fill)}"`;
  const clear = opacity === undefined ? "" : ` opacity="${opacity}"`;
  if (stroke === undefined) return area + clear;
  const lengths = dash.map((length) => short(length * PRINT_WEIGHT)).join(" ");
  const dashes = lengths === "" ? "" : ` stroke-dasharray="${lengths}"`;
  const line = ` stroke="${printedColour(stroke)}" stroke-width="${short(width * PRINT_WEIGHT)}"`;
  return `${area}${line}${dashes} stroke-linejoin="round"${clear}`;
}

const short = (value: number): string => String(Math.round(value * 100) / 100);

const escape = (text: string): string => text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);
