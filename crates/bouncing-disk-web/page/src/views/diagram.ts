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
import { clamp, extent, linearScale, padded } from "../drawing/scale";
import { WindowPicture } from "../drawing/window_picture";
import type { BranchesJson, Range } from "../protocol";
import { DIAGRAM_COLUMNS } from "../protocol";
import { describeBifurcations, paintBranches } from "./diagram/branches";
import type { Branches } from "./diagram/branches";
import { computeColumns, RECORDED, TRANSIENT } from "./diagram/computation";
import type { Columns, Wanted } from "./diagram/computation";
import { describeDiagram } from "./diagram/description";
import { diagramOffers } from "./diagram/offers";
import { OrbitPicture } from "./diagram/orbit_picture";
import { columnOf, DESCRIBED, QUANTITIES } from "./diagram/quantity";
import { Verdict } from "./diagram/verdict";
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
  private shown: OrbitPicture | null = null;
  private previous: OrbitPicture | null = null;
  private columns: Columns[] = [];
  private automatic: Range = [0, 1];
  private branches: Branches | null = null;
  private asked = "";
  private done = "";
  private count = 0;
  private drawn = "";
  private branchesAsked = "";
  private readonly compute = debounced(60, () => void this.fetch());

  mount(host: HTMLElement, context: Context): void {
    this.context = context;
    this.verdict = new Verdict(context);
    this.picture = new WindowPicture(
      {
        className: "picture-wide",
        label: "Orbit diagram.",
        axes: () => this.axes(),
        paint: (pen, plot) => this.paint(pen, plot),
        window: () => ({ x: this.state().diagram.axial_forcing, y: this.range() }),
        move: (window, settled) => this.move(window, settled),
        reset: () => context.change({ diagram: { axial_forcing: [0.3, 0.62], range: null } }),
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
    if (noRotation) setText(this.note, "Branches are those of the vertical motion, and have no angular speed.");
    this.picture.redraw();
    this.compute();
  }

  hide(): void {
    this.compute.stop();
    this.verdict.stop();
    this.context.client.cancel("diagram");
    this.context.client.cancel("diagram-branches");
    // What did not come is asked for when the view is shown again.
    if (this.asked !== this.done) this.asked = "";
    this.branchesAsked = this.branches === null ? "" : this.branchesAsked;
  }

  redraw(): void {
    this.shown?.recolour(this.context.colour);
    this.previous?.recolour(this.context.colour);
    this.picture.redraw();
    this.compute();
  }

  offers(): Offer[] {
    return diagramOffers({
      state: this.state(),
      columns: this.columns,
      plotAxes: this.axes(),
      paint: (pen, plot, colour) => this.paintPrinted(pen, plot, colour),
    });
  }

  private state(): State {
    return this.context.state();
  }

  private range(): Range {
    const { range, quantity } = this.state().diagram;
    return range ?? (quantity === "impact_phase" ? [0, 1] : this.automatic);
  }

  private axes(): { x: Axis; y: Axis } {
    const { axial_forcing, quantity } = this.state().diagram;
    return {
      x: { label: "axial forcing parameter Γ = *Aω*²/(π*g*)", scale: linearScale(axial_forcing) },
      y: { label: DESCRIBED[quantity].label, scale: linearScale(this.range()) },
    };
  }

  private move(window: Window2, settled: boolean): void {
    const { quantity } = this.state().diagram;
    const { widths, bounds } = DESCRIBED[quantity];
    const forcing = confined(window.x, [1e-9, 100], FORCING_BOUNDS);
    const range = confined(window.y, widths, bounds);
    const before = this.range();
    const same = range[0] === before[0] && range[1] === before[1];
    this.context.change(
      { diagram: { axial_forcing: forcing, range: same ? this.state().diagram.range : range } },
      { settled },
    );
  }

  /** Asks for the columns of the present window, unless they are there or on their way. */
  private async fetch(): Promise<void> {
    const laid = this.picture.layOut();
    if (laid === null) return;
    const { system, start, diagram } = this.state();
    const { impact_phase, normalised_speed } = start;
    const rotation = diagram.quantity === "angular_speed";
    const wanted = {
      system: { ...system },
      start: { impact_phase, normalised_speed },
      axial_forcing: diagram.axial_forcing,
      count: clamp(laid.columns, 2, MOST_COLUMNS),
      rotation,
    };
    const key = keyOf(wanted);
    if (key === this.asked) {
      this.arrange(laid.rows);
      void this.fetchBranches();
      return;
    }
    this.asked = key;
    this.count = wanted.count;
    this.columns = [];
    this.drawn = "";
    const began = performance.now();
    this.context.status("Computing the orbit diagram", "busy");
    try {
      const resting = await computeColumns(this.context, wanted, (columns) => this.take(columns, laid.rows));
      if (this.asked !== key) return;
      this.done = key;
      this.previous = null;
      const seconds = (performance.now() - began) / 1000;
      const rest = resting === 0 ? "" : ` ${resting} of them end at rest on the platform and have no dots.`;
      this.context.status(
        `${wanted.count} forcings, ${RECORDED} impacts of each after ${TRANSIENT}, in ${seconds.toFixed(2)} s.${rest}`,
      );
      this.arrange(laid.rows);
      this.describe();
      void this.fetchBranches();
    } catch (error) {
      if (this.asked === key) this.asked = "";
      tellFailure(this.context, error);
    }
  }

  private take(columns: Columns, rows: number): void {
    this.columns.push(columns);
    if (!this.arrange(rows)) {
      this.shown?.add(columns.numbers, columns.from, columns.to, columns.coarse, this.context.colour);
    }
    this.picture.redraw();
  }

  /** Makes the picture of the present quantity and range with all that has come, unless it is there: true if made. */
  private arrange(rows: number): boolean {
    const { diagram } = this.state();
    this.findRange();
    const range = this.range();
    const { count } = this;
    const key = JSON.stringify([this.asked, diagram.quantity, range, rows]);
    if (key === this.drawn || count === 0) return false;
    const fresh = this.drawn === "";
    this.drawn = key;
    if (fresh || this.shown?.quantity !== diagram.quantity) this.previous = this.shown;
    if (this.previous !== null && this.previous.quantity !== diagram.quantity) this.previous = null;
    this.shown = new OrbitPicture(diagram.axial_forcing, diagram.quantity, range, count, rows, RECORDED);
    this.fill(this.shown, this.context.colour);
    this.picture.redraw();
    return true;
  }

  private fill(picture: OrbitPicture, colour: Colours): void {
    for (const { numbers, from, to, coarse } of this.columns) picture.add(numbers, from, to, coarse, colour);
  }

  /** The range of the axis that nobody chose: that of the dots. */
  private findRange(): void {
    const { quantity } = this.state().diagram;
    if (quantity === "impact_phase") return;
    let low = Infinity;
    let high = -Infinity;
    for (const { numbers } of this.columns) {
      const part = extent(numbers, columnOf(quantity), DIAGRAM_COLUMNS.length);
      if (part === null) continue;
      low = Math.min(low, part[0]);
      high = Math.max(high, part[1]);
    }
    if (!(low <= high)) return;
    const range = padded([quantity === "normalised_speed" ? 0 : low, high]);
    const wider = range[0] < this.automatic[0] || range[1] > this.automatic[1];
    const finer = range[1] - range[0] < 0.7 * (this.automatic[1] - this.automatic[0]);
    if (wider || finer) this.automatic = quantity === "normalised_speed" ? [0, range[1]] : range;
  }

  private async fetchBranches(): Promise<void> {
    const { system, diagram } = this.state();
    if (!diagram.branches || diagram.quantity === "angular_speed") return;
    const { restitution } = system;
    const key = JSON.stringify([restitution, diagram.axial_forcing]);
    if (key === this.branchesAsked) return;
    this.branchesAsked = key;
    try {
      const request = { call: "branches", restitution, axial_forcing: diagram.axial_forcing } as const;
      await this.context.client.series("diagram-branches", [request], ({ json, numbers }) => {
        this.branches = { json: json as BranchesJson, numbers };
        this.picture.redraw();
        this.describe();
      });
    } catch (error) {
      if (this.branchesAsked === key) this.branchesAsked = "";
      tellFailure(this.context, error);
    }
  }

  private paint(pen: Pen, plot: Plot): void {
    this.previous?.paint(pen, plot);
    if (this.shown?.quantity === this.state().diagram.quantity) this.shown.paint(pen, plot);
    this.paintLines(pen, plot, this.context.colour);
  }

  /** The same dots in the colours of print, finely enough for it. */
  private paintPrinted(pen: Pen, plot: Plot, colour: Colours): void {
    const { axial_forcing, quantity } = this.state().diagram;
    const count = Math.max(this.count, 2);
    const picture = new OrbitPicture(axial_forcing, quantity, this.range(), count, Math.round(count * 0.5), RECORDED);
    this.fill(picture, colour);
    picture.paint(pen, plot);
    this.paintLines(pen, plot, colour);
  }

  private paintLines(pen: Pen, plot: Plot, colour: Colours): void {
    const { diagram, system } = this.state();
    const here = axialForcing(system);
    const x = plot.left + plot.width * plot.x.scale.share(here);
    pen.path([x, plot.top, x, plot.top + plot.height], { stroke: colour("--picture-muted"), width: 1, dash: [2, 3] });
    if (diagram.branches && this.branches !== null) paintBranches(pen, plot, this.branches, diagram.quantity, colour);
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
    const { diagram, system } = this.state();
    const seen = describeDiagram(this.columns, diagram, system.restitution, this.count);
    const branches = diagram.branches && this.branches !== null ? ` ${describeBifurcations(this.branches)}` : "";
    setText(this.alternative, seen + branches);
  }
}

/** What the columns depend on: the amplitude of the system does not count, for the forcing takes its place. */
function keyOf({ system, ...others }: Wanted): string {
  const { amplitude: _, ...rest } = system;
  return JSON.stringify([others, others.rotation ? rest : system.restitution]);
}

export const view: View = new DiagramView();
