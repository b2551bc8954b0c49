/** Basins of attraction: where the orbit of every start ends. */

import { Cancelled, type Context, type Offer, type State } from "../contract";
import { crossAt, pixelX, pixelY, type Axes, type Plot } from "../drawing/axes";
import { ONE_COLUMN, PARTS, plotOffers, tableOffers } from "../drawing/files";
import type { Pen } from "../drawing/pen";
import { confined, WindowPicture, type Point, type Window2 } from "../drawing/window";
import { div, element, setText } from "../elements";
import { brief, percent, plain } from "../numbers";
import { say, WORDS } from "../words";
import type { AttractorsJson, ImpactStart, Range } from "../protocol";
import { DEFAULT_STATE } from "../state";
import { ComputingView, mapKey, roundingCaution } from "./asking";
import { Cells, computeCells, gridOf, type Grid } from "./basins/cells";
import { describe, labelsOf, Legend, printedLegend } from "./basins/legend";

const TEXTS = WORDS.basins;

const SPEEDS: Range = [0, 1000];
const PHASES: Range = [-1, 2];
/** The smallest speed that a start can have. */
const LEAST_SPEED = 1e-9;

export class BasinsView extends ComputingView {
  private readonly picture: WindowPicture;
  private readonly rounding = roundingCaution("basins-rest", WORDS.asking.rounding_basins);
  private readonly legend = new Legend(this.rounding.root);
  private readonly alternative = element("p", { class: "alternative" });
  private found: AttractorsJson | null = null;
  private cells: Cells | null = null;
  /** Those of the window before. */
  private previous: Cells | null = null;
  private asked = "";
  /** The map of the attractors that are known. */
  private mapFound = "";
  private complete = false;
  /** The attractors of another map are being looked for: what is seen is of the one before. */
  private stale = false;
  protected readonly draw = (): void => this.picture.redraw();

  constructor(host: HTMLElement, context: Context) {
    super(context, ["basins"]);
    this.picture = new WindowPicture({
      className: "picture-basins",
      label: TEXTS.label,
      axes: () => this.axes(),
      paint: (pen, plot) => this.paint(pen, plot),
      window: () => ({ x: this.basins.phase_periods, y: this.basins.normalised_speed }),
      move: (window, settled) => this.move(window, settled),
      reset: () => context.change({ basins: DEFAULT_STATE.basins }),
      point: (at) => this.point(at),
      pick: (at) => this.choose(at),
    });
    host.append(
      div("bar", element("span", { class: "remark" }, TEXTS.hint), this.picture.tools),
      div("beside", div("main-part", this.picture.layers.root, this.alternative), this.legend.root),
    );
  }

  show(state: State): void {
    this.rounding.show(this.context, state);
    this.redraw();
  }

  offers(): Offer[] {
    const { found, basins, cells } = this;
    // What is half done is not given away: it has the labels of some of its cells.
    if (cells === null || found === null || this.stale || !this.complete) return [];
    const state = this.context.state();
    return [
      ...tableOffers({
        name: TEXTS.file,
        parameters: { picture: "basins", ...valuesOf(state), basins, ...found },
        columns: ["phase_periods", "normalised_speed", "label"],
        rows: () => cells.rows(),
      }),
      ...plotOffers({
        name: TEXTS.file,
        title: TEXTS.title,
        basis: { state, names: PARTS.map },
        width: ONE_COLUMN,
        height: ONE_COLUMN * 0.9,
        axes: this.axes(),
        paint: (pen, plot) => {
          cells.paint(pen, plot);
          this.paintAttractors(pen, plot);
        },
        legend: printedLegend(found, cells.shares()),
      }),
    ];
  }

  private get basins(): State["basins"] {
    return this.context.state().basins;
  }

  private axes(): Axes {
    const { phase_periods, normalised_speed } = this.basins;
    return {
      x: { label: WORDS.axes.phase, range: phase_periods },
      y: { label: WORDS.axes.speed, range: normalised_speed },
    };
  }

  private move(window: Window2, settled: boolean): void {
    const phase_periods = confined(window.x, [1e-9, 3], PHASES);
    const normalised_speed = confined(window.y, [1e-9, 1000], SPEEDS);
    this.context.change({ basins: { phase_periods, normalised_speed } }, { settled });
  }

  protected async fetch(): Promise<void> {
    const laid = this.picture.layOut();
    if (laid === null) return;
    const state = this.context.state();
    const grid = gridOf(this.basins, laid.columns, laid.rows);
    const key = JSON.stringify([mapKey(state), grid]);
    if (key === this.asked) return;
    this.asked = key;
    this.complete = false;
    this.context.status(TEXTS.computing, "busy");
    const { axial_forcing, restitution } = valuesOf(state);
    const at = { forcing: brief(axial_forcing), restitution: brief(restitution) };
    setText(this.alternative, say(TEXTS.coming, at));
    const began = performance.now();
    try {
      await this.fill(await this.attractorsOf(state), state, grid);
    } catch (error) {
      if (this.asked === key) this.asked = "";
      // Nor does a picture of another map stand where there is none of this one.
      if (!(error instanceof Cancelled)) {
        this.clear();
        setText(this.alternative, say(TEXTS.none, at));
        this.draw();
      }
      throw error;
    }
    this.complete = true;
    const seconds = ((performance.now() - began) / 1000).toFixed(2);
    this.context.status(say(TEXTS.computed, { ...at, phases: grid.phases, speeds: grid.speeds, seconds }));
    const window = [...grid.phase_periods, ...grid.normalised_speed].map((end) => brief(end));
    const [from = "", to = "", low = "", high = ""] = window;
    setText(this.alternative, say(TEXTS.seen, { ...at, from, to, low, high }));
  }

  private async attractorsOf(state: State): Promise<AttractorsJson> {
    const name = mapKey(state);
    this.stale = this.found === null || name !== this.mapFound;
    this.legend.dim(this.stale);
    this.draw();
    if (this.found !== null && !this.stale) return this.found;
    const request = { call: "attractors", map: state.system } as const;
    const { json } = await this.context.client.series<AttractorsJson>("basins", [request]);
    // No cell of another map stands under this legend.
    this.clear();
    this.found = json;
    this.mapFound = name;
    this.legend.show(json, null);
    this.draw();
    return json;
  }

  private clear(): void {
    Object.assign(this, { stale: false, found: null, cells: null, previous: null });
    this.legend.show(null, null);
  }

  private async fill(found: AttractorsJson, state: State, grid: Grid): Promise<void> {
    const cells = new Cells(grid, labelsOf(found));
    await computeCells(this.context, state, grid, (labels, from) => {
      if (this.cells !== cells) Object.assign(this, { previous: this.cells, cells });
      cells.add(labels, from);
      this.context.status(say(TEXTS.progress, { percent: percent(from / grid.speeds, 0) }), "busy");
      this.draw();
    });
    this.legend.show(found, cells.shares());
  }

  private paint(pen: Pen, plot: Plot): void {
    for (const cells of [this.previous, this.cells]) cells?.paint(pen, plot);
    const paper = { fill: "--picture-paper", opacity: 0.75 };
    if (this.stale) pen.rect(plot.left, plot.top, plot.width, plot.height, paper);
    else this.paintAttractors(pen, plot);
    paintMark(pen, plot, this.context.state().start, true);
  }

  private paintAttractors(pen: Pen, plot: Plot): void {
    for (const { impact } of this.found?.attractors ?? []) if (impact !== null) paintMark(pen, plot, impact, false);
  }

  private point(at: Point | null): void {
    if (at === null || this.found === null || this.stale) return;
    const label = this.cells?.at(...at) ?? null;
    if (label === null) return;
    const [phase, speed] = at;
    const end = nameOf(label, this.found) ?? TEXTS.undecided_here;
    this.legend.point(say(TEXTS.pointed, { phase: plain(phase, 4), speed: plain(speed, 4), end }));
  }

  private choose([phase, speed]: Point): void {
    const whole = phase - Math.floor(phase);
    const start = { impact_phase: whole * 2 * Math.PI, normalised_speed: Math.max(speed, LEAST_SPEED) };
    this.context.change({ start, view: "toss" });
  }
}

/** What a caption says of the map. */
const valuesOf = ({ system: { restitution }, summary }: State) => ({
  axial_forcing: summary?.axial_forcing ?? NaN,
  restitution,
});

/** What the cells of a label end on; null where that is undecided. */
function nameOf(label: number, found: AttractorsJson): string | null {
  const attractor = found.attractors.find((one) => one.label === label);
  return attractor === undefined ? null : describe(attractor, found);
}

/** An impact, in every period that the window may show. */
function paintMark(pen: Pen, plot: Plot, { impact_phase, normalised_speed }: ImpactStart, upright: boolean): void {
  for (let turns = -1; turns <= 2; turns += 1) {
    const x = pixelX(plot, impact_phase / (2 * Math.PI) + turns);
    const path = crossAt(x, pixelY(plot, normalised_speed), upright ? 6 : 4.5, upright);
    pen.path(path, { stroke: "--attractor-halo", width: 4 });
    pen.path(path, { stroke: "--attractor-mark", width: 1.8 });
  }
}
