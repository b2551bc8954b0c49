/** Basins of attraction: where the orbit of every start ends. */

import "./views.css";

import { Cancelled } from "../contract";
import type { Context, Offer, State, View } from "../contract";
import { layOut, paintAxes, pixelX, pixelY } from "../drawing/axes";
import type { Axis, Plot } from "../drawing/axes";
import type { Colours } from "../drawing/colours";
import { debounced, element, setText } from "../drawing/elements";
import { ONE_COLUMN, pictureOffers, PRINT_SIZE, tableOffers } from "../drawing/files";
import { confined } from "../drawing/gestures";
import type { Window2 } from "../drawing/gestures";
import { brief, percent, plain } from "../drawing/numbers";
import type { Pen } from "../drawing/pen";
import { linearScale } from "../drawing/scale";
import { paintStretched, WindowPicture } from "../drawing/window_picture";
import type { AttractorsJson, Range } from "../protocol";
import { Cells, isUndecided } from "./basins/cells";
import { computeCells, findAttractors, gridsOf } from "./basins/computation";
import { describe, labelsOf, Legend, undecidedShare } from "./basins/legend";
import { paintTitle, printedLegend, TITLE_HEIGHT } from "./basins/print";
import { tellFailure } from "./failures";
import { axialForcing } from "./forcing";
import { RoundingCaution } from "./rounding";

const SPEEDS: Range = [0, 1000];
const PHASES: Range = [-1, 2];
/** The smallest speed that a start can have. */
const LEAST_SPEED = 1e-9;

class BasinsView implements View {
  readonly name = "basins";
  readonly title = "Basins";
  readonly description =
    "All starts by phase and speed of their first impact, coloured by the attractor that they end on.";
  private context!: Context;
  private picture!: WindowPicture;
  private readonly rounding = new RoundingCaution(
    "basins-rest",
    "the cycle in which this disk comes to rest again and again was chosen by rounding.",
  );
  private readonly legend = new Legend(this.rounding.root);
  private readonly alternative = element("p", { class: "alternative" });
  private found: AttractorsJson | null = null;
  private layers: Cells[] = [];
  private previous: Cells | null = null;
  private asked = "";
  private mapAsked = "";
  private complete = false;
  /** The attractors of another map are being looked for: what is seen is of the one before. */
  private stale = false;
  private readonly compute = debounced(60, () => void this.fetch());

  mount(host: HTMLElement, context: Context): void {
    this.context = context;
    this.picture = new WindowPicture(
      {
        className: "picture-basins",
        label: "Basins of attraction.",
        axes: () => this.axes(),
        paint: (pen, plot) => this.paint(pen, plot),
        window: () => ({ x: this.state().basins.phase_periods, y: this.state().basins.normalised_speed }),
        move: (window, settled) => this.move(window, settled),
        reset: () => context.change({ basins: { phase_periods: [0, 1], normalised_speed: [0, 5] } }),
        point: (at) => this.point(at),
        pick: (at) => this.choose(at),
      },
      context,
    );
    const hint =
      "× one impact of a periodic attractor, + the shared start. A click runs that start in the first view.";
    host.append(
      element("div", { class: "bar" }, element("span", { class: "remark" }, hint), this.picture.tools),
      element(
        "div",
        { class: "beside" },
        element("div", { class: "main-part" }, this.picture.layers.root, this.alternative),
        this.legend.root,
      ),
    );
  }

  show(state: State): void {
    void this.rounding.show(this.context, state);
    this.picture.redraw();
    this.compute();
  }

  hide(): void {
    this.compute.stop();
    this.context.client.cancel("basins");
    this.context.client.cancel("basins-attractors");
    if (!this.complete) this.asked = "";
    if (this.found === null || this.stale) this.mapAsked = "";
  }

  redraw(): void {
    for (const cells of [...this.layers, this.previous]) cells?.repaint(labelsOf(this.found), this.context.colour);
    this.picture.redraw();
    this.compute();
  }

  offers(): Offer[] {
    const { system, basins } = this.state();
    const cells = this.layers[this.layers.length - 1];
    const { found } = this;
    // What is half done is not given away: it has the labels of some of its cells.
    if (cells === undefined || found === null || this.stale || !this.complete) return [];
    const known = labelsOf(found);
    const forcing = axialForcing(system);
    const legend = printedLegend(found, cells.shares());
    return [
      ...tableOffers({
        name: "basins",
        parameters: {
          picture: "basins",
          axial_forcing: forcing,
          restitution: system.restitution,
          basins,
          ...found,
        },
        columns: ["phase_periods", "normalised_speed", "label"],
        rows: () => cells.rows(),
      }),
      ...pictureOffers({
        name: "basins",
        title: "Basins of attraction",
        width: ONE_COLUMN,
        height: ONE_COLUMN * 0.9 + legend.height,
        paint: (pen, colour, width, height) => {
          const { x, y } = this.axes();
          paintTitle(pen, colour, width, forcing, system.restitution);
          const laid = layOut(pen, width, height - legend.height - TITLE_HEIGHT, x, y, PRINT_SIZE);
          const plot = { ...laid, top: laid.top + TITLE_HEIGHT };
          cells.repaint(known, colour);
          pen.clipped(plot.left, plot.top, plot.width, plot.height, () => {
            paintStretched(pen, plot, cells.canvas, cells.window);
            this.paintMarks(pen, plot, colour, false);
          });
          paintAxes(pen, plot, colour);
          legend.paint(pen, colour, height - legend.height);
          cells.repaint(known, this.context.colour);
        },
      }),
    ];
  }

  private state(): State {
    return this.context.state();
  }

  private axes(): { x: Axis; y: Axis } {
    const { phase_periods, normalised_speed } = this.state().basins;
    return {
      x: { label: "phase of impact *τ*_{imp}/2π (periods)", scale: linearScale(phase_periods) },
      y: { label: "normalised impact speed |*w*_{A}Γ/(*ωA*)|", scale: linearScale(normalised_speed) },
    };
  }

  private move(window: Window2, settled: boolean): void {
    const phase_periods = confined(window.x, [1e-9, 3], PHASES);
    const normalised_speed = confined(window.y, [1e-9, 1000], SPEEDS);
    this.context.change({ basins: { phase_periods, normalised_speed } }, { settled });
  }

  private async fetch(): Promise<void> {
    const laid = this.picture.layOut();
    if (laid === null) return;
    const { system, basins } = this.state();
    const wanted = { axial_forcing: axialForcing(system), restitution: system.restitution };
    const [coarse, fine] = gridsOf(basins, laid.columns, laid.rows);
    const key = JSON.stringify([wanted, fine]);
    if (key === this.asked) return;
    this.asked = key;
    this.complete = false;
    this.context.status("Computing attractors and basins", "busy");
    const at = `Γ = ${brief(wanted.axial_forcing)} and a restitution of ${brief(wanted.restitution)}`;
    setText(this.alternative, `The basins at ${at} are being computed.`);
    const began = performance.now();
    try {
      const map = JSON.stringify(wanted);
      if (map !== this.mapAsked || this.found === null || this.stale) {
        this.mapAsked = map;
        this.stale = true;
        this.legend.dim(true);
        this.picture.redraw();
        const found = await findAttractors(this.context, wanted);
        if (this.mapAsked !== map) return;
        // No cell of another map stands under this legend.
        this.clear();
        this.found = found;
        this.legend.show(found, null);
        this.picture.redraw();
      }
      if (this.asked !== key) return;
      await this.fill(wanted, [coarse, fine], laid.columns, key);
      if (this.asked !== key) return;
      this.complete = true;
      this.previous = null;
      const seconds = (performance.now() - began) / 1000;
      this.context.status(
        `${fine.phases} × ${fine.speeds} starts at Γ = ${brief(wanted.axial_forcing)} in ${seconds.toFixed(2)} s.`,
      );
      this.describe();
    } catch (error) {
      if (this.asked === key) this.asked = "";
      // Nor does a picture of another map stand where there is none of this one.
      if (!(error instanceof Cancelled)) {
        this.clear();
        this.mapAsked = "";
        setText(this.alternative, `There are no basins at ${at}.`);
        this.picture.redraw();
      }
      tellFailure(this.context, error);
    }
  }

  private clear(): void {
    this.stale = false;
    this.found = null;
    this.layers = [];
    this.previous = null;
    this.legend.clear();
  }

  private async fill(
    wanted: { axial_forcing: number; restitution: number },
    grids: Parameters<typeof computeCells>[2],
    columns: number,
    key: string,
  ): Promise<void> {
    const layers = grids.map((grid) => new Cells(grid, Math.max(1, Math.min(4, Math.round(columns / grid.phases)))));
    let begun = false;
    await computeCells(this.context, wanted, grids, (labels, index, from) => {
      if (this.asked !== key) return;
      if (!begun) {
        begun = true;
        this.previous = this.layers[1] ?? null;
        this.layers = layers;
      }
      layers[index]?.add(labels, from, labelsOf(this.found), this.context.colour);
      if (index === 1) this.context.status(`Computing basins: ${percent(from / (grids[1]?.speeds ?? 1), 0)}`, "busy");
      this.picture.redraw();
    });
    const fine = layers[1];
    if (this.asked === key && fine !== undefined && this.found !== null) this.legend.show(this.found, fine.shares());
  }

  private paint(pen: Pen, plot: Plot): void {
    for (const cells of [this.previous, ...this.layers]) {
      if (cells !== null) paintStretched(pen, plot, cells.canvas, cells.window);
    }
    if (this.stale) {
      const paper = { fill: this.context.colour("--picture-paper"), opacity: 0.75 };
      pen.rect(plot.left, plot.top, plot.width, plot.height, paper);
    }
    this.paintMarks(pen, plot, this.context.colour, true);
  }

  private paintMarks(pen: Pen, plot: Plot, colour: Colours, withStart: boolean): void {
    const mark = (phase: number, speed: number, upright: boolean) => {
      // The same impact in every period that the window shows.
      for (let turns = -1; turns <= 2; turns += 1) {
        const x = pixelX(plot, phase / (2 * Math.PI) + turns);
        const y = pixelY(plot, speed);
        const arm = upright ? 6 : 4.5;
        const path = upright
          ? [x - arm, y, x + arm, y, NaN, NaN, x, y - arm, x, y + arm]
          : [x - arm, y - arm, x + arm, y + arm, NaN, NaN, x - arm, y + arm, x + arm, y - arm];
        pen.path(path, { stroke: colour("--attractor-halo"), width: 4 });
        pen.path(path, { stroke: colour("--attractor-mark"), width: 1.8 });
      }
    };
    for (const { impact } of (this.stale ? null : this.found)?.attractors ?? []) {
      if (impact !== null) mark(impact.impact_phase, impact.normalised_speed, false);
    }
    const { start } = this.state();
    if (withStart) mark(start.impact_phase, start.normalised_speed, true);
  }

  private point(at: readonly [number, number] | null): void {
    if (at === null || this.found === null || this.stale) return;
    const [phase, speed] = at;
    const label = this.layers[1]?.at(phase, speed) ?? this.layers[0]?.at(phase, speed) ?? null;
    if (label === null) return;
    const text = this.nameOf(label, this.found);
    this.legend.point(`Phase ${plain(phase, 4)} periods, speed ${plain(speed, 4)}: ${text}`);
  }

  private nameOf(label: number, found: AttractorsJson): string {
    if (isUndecided(label, labelsOf(found))) return "undecided.";
    const attractor = found.attractors.find((one) => one.label === label);
    return attractor === undefined ? "undecided." : describe(attractor, found);
  }

  private choose([phase, speed]: readonly [number, number]): void {
    const whole = phase - Math.floor(phase);
    const start = { impact_phase: whole * 2 * Math.PI, normalised_speed: Math.max(speed, LEAST_SPEED) };
    this.context.announce(`Start at phase ${plain(whole, 3)} periods and speed ${plain(speed, 3)}`);
    this.context.change({ start, view: "toss" });
  }

  private describe(): void {
    const fine = this.layers[1];
    if (this.found === null || fine === undefined) return;
    const known = labelsOf(this.found);
    const { phase_periods: x, normalised_speed: y } = fine.grid;
    const shares = fine.shares();
    const undecided = undecidedShare(this.found, shares) ?? 0;
    const parts: string[] = [];
    for (const [label, share] of shares) {
      if (!isUndecided(label, known)) parts.push(`${percent(share)} end so: ${this.nameOf(label, this.found).replace(/\.$/, "")}`);
    }
    setText(
      this.alternative,
      `Of the starts with phases from ${brief(x[0])} to ${brief(x[1])} periods and normalised speeds from ` +
        `${brief(y[0])} to ${brief(y[1])}, ${parts.join("; ")}; ${percent(undecided)} are undecided.`,
    );
  }
}

export const view: View = new BasinsView();
