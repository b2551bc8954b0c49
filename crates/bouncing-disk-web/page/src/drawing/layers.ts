import type { Colours } from "./colours";
import { CanvasPen } from "./canvas_pen";

/** Two canvases on each other at the screen's own pixels: data below, and the cursor, which moves often, above. */
export class Layers {
  readonly root = document.createElement("div");
  /** The upper one, which takes the keyboard and the pointer. */
  readonly surface = document.createElement("canvas");
  private readonly lower = document.createElement("canvas");
  width = 0;
  height = 0;
  ratio = 1;

  constructor(className: string, label: string) {
    this.root.className = `picture ${className}`;
    this.lower.setAttribute("aria-hidden", "true");
    this.surface.tabIndex = 0;
    this.surface.setAttribute("role", "application");
    this.surface.setAttribute("aria-label", label);
    this.root.append(this.lower, this.surface);
  }

  /** Takes the size of the element. True if it is another one, which empties both canvases. */
  fit(): boolean {
    const { clientWidth: width, clientHeight: height } = this.root;
    const ratio = window.devicePixelRatio || 1;
    if (width === this.width && height === this.height && ratio === this.ratio) return false;
    this.width = width;
    this.height = height;
    this.ratio = ratio;
    for (const canvas of [this.lower, this.surface]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    return true;
  }

  /** A pen for the data, on clean paper. */
  data(colour: Colours): CanvasPen {
    const context = this.scaled(this.lower);
    context.fillStyle = colour("--picture-paper");
    context.fillRect(0, 0, this.width, this.height);
    return new CanvasPen(context);
  }

  /** A pen for the data, over what is there already. */
  more(): CanvasPen {
    return new CanvasPen(this.scaled(this.lower));
  }

  /** A pen for the cursor, on a clean transparent sheet. */
  cursor(): CanvasPen {
    const context = this.scaled(this.surface);
    context.clearRect(0, 0, this.width, this.height);
    return new CanvasPen(context);
  }

  private scaled(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
    const context = canvas.getContext("2d");
    if (context === null) throw new Error("this browser gives no canvas to draw on");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    return context;
  }
}
