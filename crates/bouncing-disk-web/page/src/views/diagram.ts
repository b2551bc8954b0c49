/** The orbit diagram: what impacts repeat, over the forcing. */

import "./views.css";

import type { Context, Offer, Quantity, State, View } from "../contract";
import type { Axis, Plot } from "../drawing/axes";
import type { Colours } from "../drawing/colours";
import { debounced, element, setText } from "../drawing/elements";
import { confined } from "../drawing/gestures";
import type { Window2 } from "../drawing/gestures";
import { plain } from "../drawing/numbers";
import type { Pen } from "../drawing/pen";
import { clamp, linearScale } from "../drawing/scale";
import { WindowPicture } from "../drawing/window_picture";
import type { Range } from "../protocol";
import { BranchLines } from "./diagram/branch_lines";
import { computeColumns, RECORDED, TRANSIENT } from "./diagram/computation";
import type { Told, Wanted } from "./diagram/computation";
import { Description } from "./diagram/description";
import { Dots } from "./diagram/dots";
import { diagramOffers } from "./diagram/offers";
import { DESCRIBED, QUANTITIES } from "./diagram/quantity";
import { Verdict } from "./diagram/verdict";
import { DEFAULT_STATE } from "../state";
import { tellFailure } from "./failures";
import { amplitudeOf, axialForcing } from "./forcing";

/** More columns than this no eye tells apart, and a telephone has to compute them. */
const MOST_COLUMNS = 2048;
const FORCING_BOUNDS: Range = [1e-3, 1e3];

class DiagramView implements View {
  readonly name = "diagram";
  readonly title = "Orbit diagram";
  readonly description =
    "The impacts that an orbit repeats, over the axial forcing parameter; zooming computes them anew.";
  private context!: Context;
  private picture!: WindowPicture;
  private verdict!: Verdict;
  private readonly quantity = element("select", { "aria-label": "Quantity over the forcing" });
  private readonly branchesBox = element("input", { type: "checkbox" });
  private readonly alternative = element("p", { class: "alternative" });
  private readonly note = element("p", { class: "remark", hidden: true });
  private branches!: BranchLines;
  private spoken!: Description;
  private readonly dots = new Dots();
  private asked = "";
  private done = "";
  /** What was computed, when all is there. */
  private sentence = "";
  private orbits: Told = { resting: 0, unsettled: 0, leftOut: TRANSIENT };
  private told = false;
  private readonly compute = debounced(60, () => void this.fetch());

  mount(host: HTMLElement, context: Context): void {
    this.context = context;
    this.verdict = new Verdict(context);
    this.branches = new BranchLines(context);
    this.spoken = new Description(context);
    this.picture = new WindowPicture(
      {
        className: "picture-wide",
        label: "Orbit diagram.",
        axes: () => this.axes(),
        paint: (pen, plot) => this.paint(pen, plot),
        window: () => ({ x: this.state().diagram.axial_forcing, y: this.dots.range(this.state().diagram) }),
        move: (window, settled) => this.move(window, settled),
        reset: () => context.change({ diagram: { axial_forcing: DEFAULT_STATE.diagram.axial_forcing, range: null } }),
        point: (at) => {
          if (at !== null) this.verdict.point(at[0], this.state());
        },
        pick: ([forcing]) => void this.choose(forcing),
      },
      context,
    );
    for (const name of QUANTITIES) this.quantity.append(element("option", { value: name }, DESCRIBED[name].name));
    this.quantity.addEventListener("change", () => {
      context.change({ diagram: { quantity: this.quantity.value as Quantity, range: null } });
    });
    this.branchesBox.addEventListener("change", () => {
      context.change({ diagram: { branches: this.branchesBox.checked } });
    });
    const legend = element("p", { class: "legend" });
    legend.innerHTML =
      '<span class="line full"></span> stable, <span class="line dashed"></span> unstable branch; ' +
      "○ doubling, □ fold, ◇ birth, × graze or vanishing impact. Darker dots (lighter on a dark page): more impacts. " +
      "A click gives the shared system that forcing.";
    host.append(
      element(
        "div",
        { class: "bar" },
        element("label", {}, "Quantity ", this.quantity),
        element("label", {}, this.branchesBox, " Branches"),
        this.picture.tools,
      ),
      element(
        "div",
        { class: "beside" },
        element("div", { class: "main-part" }, this.picture.layers.root, this.note),
        this.verdict.root,
        element("div", {}, legend, this.alternative),
      ),
    );
  }

  show(state: State): void {
    this.quantity.value = state.diagram.quantity;
    this.branchesBox.checked = state.diagram.branches;
    const noRotation = state.diagram.quantity === "angular_speed";
    this.branchesBox.disabled = noRotation;
    this.note.hidden = !noRotation;
    if (noRotation) setText(this.note, noteOf(state));
    this.picture.redraw();
    this.compute();
  }

  hide(): void {
    this.compute.stop();
    this.verdict.stop();
    this.context.client.cancel("diagram");
    this.branches.cancel();
    this.spoken.cancel();
    // What did not come is asked for when the view is shown again.
    if (this.asked !== this.done) this.asked = "";
    // The place for it is another view's now.
    this.told = false;
  }

  redraw(): void {
    this.dots.recolour(this.context.colour);
    this.picture.redraw();
    this.compute();
  }

  offers(): Offer[] {
    return diagramOffers({
      state: this.state(),
      columns: this.dots.columns,
      plotAxes: this.axes(),
      paint: (pen, plot, colour) => this.paintPrinted(pen, plot, colour),
    });
  }

  private state(): State {
    return this.context.state();
  }

  private axes(): { x: Axis; y: Axis } {
    const { diagram } = this.state();
    const { label, widest } = DESCRIBED[diagram.quantity];
    return {
      x: { label: "axial forcing parameter Γ = *Aω*²/(π*g*)", scale: linearScale(diagram.axial_forcing) },
      y: { label, scale: linearScale(this.dots.range(diagram)), widest },
    };
  }

  private move(window: Window2, settled: boolean): void {
    const { quantity } = this.state().diagram;
    const { widths, bounds } = DESCRIBED[quantity];
    const before = this.dots.range(this.state().diagram);
    const forcing = confined(window.x, [1e-9, 100], FORCING_BOUNDS, this.state().diagram.axial_forcing);
    const range = confined(window.y, widths, bounds, before);
    const same = range[0] === before[0] && range[1] === before[1];
    this.context.change(
      { diagram: { axial_forcing: forcing, range: same ? this.state().diagram.range : range } },
      { settled },
    );
  }

  /** Asks for the columns and branches of the present window, unless they are there or on their way. */
  private async fetch(): Promise<void> {
    const laid = this.picture.layOut();
    if (laid === null) return;
    const { system, start, diagram } = this.state();
    const { impact_phase, normalised_speed } = start;
    const wanted = {
      system: { ...system },
      start: { impact_phase, normalised_speed },
      axial_forcing: diagram.axial_forcing,
      count: clamp(laid.columns, 2, MOST_COLUMNS),
      rotation: diagram.quantity === "angular_speed",
    };
    const key = keyOf(wanted);
    if (key !== this.asked) await this.fetchDots(key, wanted, laid.rows);
    else if (this.dots.arrange(diagram, laid.rows, this.context.colour)) this.picture.redraw();
    // Whoever asked for the columns goes on when they are there.
    if (key !== this.done || key !== this.asked) return;
    // The verdicts come from the other worker, at the same time.
    const verdicts = this.spoken.fetch(this.state());
    // That they did not come is told where they are waited for.
    verdicts.catch(() => {});
    const lines = await this.branches.fetch(this.state());
    if (lines === "missing") return;
    if (lines === "came") this.picture.redraw();
    try {
      await verdicts;
    } catch (error) {
      tellFailure(this.context, error);
      return;
    }
    if (key !== this.done || key !== this.asked) return;
    this.describe();
    if (lines === "came" || !this.told) this.context.status(this.sentence);
    this.told = true;
  }

  private async fetchDots(key: string, wanted: Wanted, rows: number): Promise<void> {
    this.asked = key;
    this.done = "";
    this.told = false;
    this.branches.cancel();
    this.dots.begin(key, wanted.count);
    const began = performance.now();
    this.context.status("Computing the orbit diagram", "busy");
    try {
      this.orbits = await computeColumns(this.context, wanted, (columns) => {
        this.dots.take(columns, this.state().diagram, rows, this.context.colour);
        this.picture.redraw();
      });
      if (this.asked !== key) return;
      this.done = key;
      this.dots.end(this.state().diagram, rows, this.context.colour);
      this.picture.redraw();
      const seconds = ((performance.now() - began) / 1000).toFixed(2);
      const { resting, leftOut } = this.orbits;
      const rest = resting === 0 ? "" : ` ${resting} of them end at rest on the platform and have no dots.`;
      const longer = leftOut > TRANSIENT ? `\u2013${leftOut}` : "";
      const impacts = `${RECORDED} impacts of each after ${TRANSIENT}${longer}`;
      this.sentence = `${wanted.count} forcings, ${impacts}, in ${seconds} s.${rest}`;
    } catch (error) {
      if (this.asked === key) this.asked = "";
      tellFailure(this.context, error);
    }
  }

  private paint(pen: Pen, plot: Plot): void {
    this.dots.paint(pen, plot, this.state().diagram.quantity);
    this.paintLines(pen, plot, this.context.colour);
  }

  private paintPrinted(pen: Pen, plot: Plot, colour: Colours): void {
    this.dots.paintPrinted(pen, plot, this.state().diagram, colour);
    this.paintLines(pen, plot, colour);
  }

  private paintLines(pen: Pen, plot: Plot, colour: Colours): void {
    const here = axialForcing(this.state().system);
    const x = plot.left + plot.width * plot.x.scale.share(here);
    pen.path([x, plot.top, x, plot.top + plot.height], { stroke: colour("--picture-muted"), width: 1, dash: [2, 3] });
    this.branches.paint(pen, plot, this.state(), colour);
  }

  /** Gives the shared system the amplitude of this forcing, if the library takes it. */
  private async choose(forcing: number): Promise<void> {
    const { system } = this.state();
    const amplitude = amplitudeOf(forcing, system);
    try {
      await this.context.client.ask("diagram-check", { call: "check", system: { ...system, amplitude } });
      this.context.change({ system: { amplitude } });
      this.context.status(`The system has Γ = ${plain(forcing, 6)} now: an amplitude of ${plain(amplitude, 5)} m.`);
      this.context.announce(`Forcing ${plain(forcing, 4)} chosen`);
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private describe(): void {
    const seen = this.spoken.words(this.state(), this.dots.count, this.orbits);
    setText(this.alternative, seen + this.branches.describe(this.state()));
  }
}

/** What there is to say below a diagram of angular speeds. */
function noteOf({ system }: State): string {
  const idle = system.friction === 0 ? "Without friction" : system.twist_amplitude === 0 ? "Without a twist" : null;
  if (idle !== null) return `${idle} the platform hands no spin on to the disk: there is nothing to draw.`;
  return "Branches are those of the vertical motion, and have no angular speed.";
}

/** What the columns depend on: the amplitude of the system does not count, for the forcing takes its place. */
function keyOf({ system, ...others }: Wanted): string {
  const { amplitude: _, ...rest } = system;
  return JSON.stringify([others, others.rotation ? rest : system.restitution]);
}

export const view: View = new DiagramView();
