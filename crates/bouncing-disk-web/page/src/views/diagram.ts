/** The orbit diagram: what impacts repeat, over the forcing. */

import type { Context, Offer, State } from "../contract";
import { clamp, pixelX, type Axes, type Plot } from "../drawing/axes";
import { PARTS, plotOffers, tabbed, tableOffers, TWO_COLUMNS, type Basis } from "../drawing/files";
import type { Pen } from "../drawing/pen";
import { confined, WindowPicture, type Window2 } from "../drawing/window";
import { button, choice, copy, div, element, setText } from "../elements";
import { plain } from "../numbers";
import { say, WORDS } from "../words";
import { DIAGRAM_COLUMNS, type DiagramJson, type Range, type VerdictJson } from "../protocol";
import { DEFAULT_STATE } from "../state";
import { Asked, ComputingView, impactOf } from "./asking";
import { areDrawn, BRANCHES, branchesOf, isPlain, paintBranches, tablesOf, type Branches } from "./diagram/branches";
import { computeColumns, DESCRIBED, distinctImpacts, LENGTHS, TRANSIENT, type Wanted } from "./diagram/columns";
import { Dots } from "./diagram/dots";
import { describeBifurcations, describeDiagram, SAMPLE_SLOTS, Verdict, verdictsOf } from "./diagram/words";

const TEXTS = WORDS.diagram;

/** More columns than this no eye tells apart, and a telephone has to compute them. */
const MOST_COLUMNS = 2048;
const FORCING_BOUNDS: Range = [1e-3, 1e3];
/** Impacts in tables are rounded to this share of the window. */
const FINENESS = 1e-6;

export class DiagramView extends ComputingView {
  private readonly picture: WindowPicture;
  private readonly verdict: Verdict;
  private readonly quantity = choice(TEXTS.quantity, TEXTS.quantities, (quantity) =>
    this.context.change({ diagram: { quantity, range: null } }),
  );
  private readonly drive = choice(TEXTS.platform, TEXTS.drives, (drive) => this.context.change({ diagram: { drive } }));
  private readonly branchesBox = element("input", {
    type: "checkbox",
    onchange: () => this.context.change({ diagram: { branches: this.branchesBox.checked } }),
  });
  private readonly alternative = element("p", { class: "alternative" });
  private readonly copy = button(TEXTS.copy, () => void this.copyTable(), { hidden: true });
  private readonly dots = new Dots();
  private readonly columns = new Asked<void>();
  private readonly branches = new Asked<void>();
  private readonly verdicts = new Asked<VerdictJson[]>();
  /** The branches that came last, with the coefficient of restitution of their map. */
  private lines: (Branches & { readonly restitution: number }) | null = null;
  /** What was computed, when all is there. */
  private sentence = "";
  private orbits: DiagramJson = { resting: 0, unsettled: 0, left_out: TRANSIENT };
  protected readonly draw = (): void => this.picture.redraw();

  constructor(host: HTMLElement, context: Context) {
    super(context, ["diagram", BRANCHES, ...SAMPLE_SLOTS]);
    this.verdict = new Verdict(context);
    this.picture = new WindowPicture({
      className: "picture-wide",
      label: TEXTS.label,
      axes: () => this.axes(),
      paint: (pen, plot) => this.paint(pen, plot),
      window: () => ({ x: this.diagram.axial_forcing, y: this.dots.range(this.diagram) }),
      move: (window, settled) => this.move(window, settled),
      reset: () => context.change({ diagram: { axial_forcing: DEFAULT_STATE.diagram.axial_forcing, range: null } }),
      point: (at) => {
        if (at !== null && isPlain(context.state())) this.verdict.point(at[0], context.state());
      },
      pick: ([forcing]) => this.choose(forcing),
    });
    const parts = TEXTS.legend.split(/\{(\w+)\}/);
    const lines = parts.map((part, index) => (index % 2 === 0 ? part : element("span", { class: `line ${part}` })));
    const legend = element("p", { class: "legend" }, ...lines);
    const branches = element("label", {}, this.branchesBox, ` ${TEXTS.branches}`);
    host.append(
      div("bar", this.quantity.root, this.drive.root, branches, this.picture.tools),
      div(
        "beside",
        div("main-part", this.picture.layers.root),
        this.verdict.root,
        element("div", {}, legend, this.alternative, this.copy),
      ),
    );
  }

  show(state: State, fresh: boolean): void {
    const { quantity, branches, drive } = state.diagram;
    this.verdict.follow(state, fresh);
    this.quantity.select.value = quantity;
    this.drive.select.value = drive;
    this.branchesBox.checked = branches;
    this.branchesBox.disabled = quantity === "angular_speed" || !isPlain(state);
    this.redraw();
  }

  override hide(): void {
    super.hide();
    this.verdict.stop();
  }

  offers(): Offer[] {
    const state = this.context.state();
    const { system, start, diagram } = state;
    const lines = this.linesOf(state);
    const widths = [diagram.axial_forcing, this.dots.range(diagram)].map(([low, high]) => high - low);
    const step = FINENESS * Math.min(1, ...widths);
    return [
      ...tableOffers({
        name: TEXTS.file,
        parameters: { picture: "orbit diagram", system, start, diagram, ...LENGTHS, rounded_to: step },
        columns: [DIAGRAM_COLUMNS[0], "impact_phase_rad", "normalised_speed", "angular_speed_per_omega_phi", "impacts"],
        rows: () => distinctImpacts(this.dots.columns, step),
      }),
      ...(lines === null ? [] : tablesOf(lines, state).flatMap(tableOffers)),
      ...plotOffers({
        name: TEXTS.file,
        title: TEXTS.title,
        basis: basisOf(state, lines),
        width: TWO_COLUMNS,
        height: TWO_COLUMNS * 0.5,
        axes: this.axes(),
        paint: (pen, plot) => this.paint(pen, plot),
      }),
    ];
  }

  private get diagram(): State["diagram"] {
    return this.context.state().diagram;
  }

  private axes(): Axes {
    const { label, widest } = DESCRIBED[this.diagram.quantity];
    return {
      x: { label: WORDS.axes.forcing, range: this.diagram.axial_forcing },
      y: { label, range: this.dots.range(this.diagram), widest },
    };
  }

  private move(window: Window2, settled: boolean): void {
    const { diagram } = this;
    const { widths, bounds } = DESCRIBED[diagram.quantity];
    const before = this.dots.range(diagram);
    const axial_forcing = confined(window.x, [1e-9, 100], FORCING_BOUNDS, diagram.axial_forcing);
    const range = confined(window.y, widths, bounds, before);
    const same = range[0] === before[0] && range[1] === before[1];
    this.context.change({ diagram: { axial_forcing, range: same ? diagram.range : range } }, { settled });
  }

  /** Asks for the columns, branches and verdicts of the present window, unless they are there or on their way. */
  protected async fetch(): Promise<void> {
    const laid = this.picture.layOut();
    if (laid === null) return;
    const state = this.context.state();
    const { system, diagram } = state;
    const outdated = () => this.context.state() !== state;
    const wanted = {
      system,
      start: impactOf(state),
      axial_forcing: diagram.axial_forcing,
      count: clamp(laid.columns, 2, MOST_COLUMNS),
      rotation: diagram.quantity === "angular_speed" && isPlain(state),
      drive: diagram.drive,
    };
    try {
      const name = keyOf(wanted);
      const columns = this.columns.get(name, () => this.fetchDots(name, wanted, laid.rows));
      if (this.dots.arrange(diagram, laid.rows)) this.draw();
      await columns;
      if (outdated()) return;
      const { restitution } = system;
      const window = diagram.axial_forcing;
      // The verdicts come from the other worker, at the same time.
      const [verdicts] = await Promise.all([
        this.verdicts.get([window, restitution, wanted.start, isPlain(state)], () => verdictsOf(this.context, state)),
        areDrawn(state) && this.branches.get([window, restitution], () => this.fetchBranches(state)),
      ]);
      if (outdated()) return;
      const seen = describeDiagram(state, verdicts, this.dots.count, this.orbits);
      const lines = this.linesOf(state);
      this.copy.hidden = lines === null || lines.json.bifurcations.length === 0;
      setText(this.alternative, lines === null ? seen : `${seen} ${describeBifurcations(lines, window)}`);
    } catch (error) {
      if (!outdated()) throw error;
    }
  }

  private async fetchDots(name: string, wanted: Wanted, rows: number): Promise<void> {
    // Those of the last window do not keep the columns waiting.
    this.context.client.cancel(BRANCHES);
    this.dots.begin(name, wanted.count);
    const began = performance.now();
    this.context.status(TEXTS.computing, "busy");
    this.orbits = await computeColumns(this.context, wanted, (columns) => {
      this.dots.take(columns, this.diagram, rows);
      this.draw();
    });
    this.dots.end(this.diagram, rows);
    this.draw();
    const seconds = ((performance.now() - began) / 1000).toFixed(2);
    this.sentence = say(TEXTS.computed, { count: wanted.count, seconds });
    this.context.status(this.sentence);
  }

  private async fetchBranches(state: State): Promise<void> {
    this.context.status(TEXTS.computing_branches, "busy");
    const branches = await branchesOf(this.context, state);
    this.lines = { ...branches, restitution: state.system.restitution };
    this.context.status(this.sentence);
    this.draw();
  }

  private async copyTable(): Promise<void> {
    const state = this.context.state();
    const lines = this.linesOf(state);
    if (lines === null) return;
    await copy(tabbed(tablesOf(lines, state)[0]), this.context.status, TEXTS.copied, TEXTS.not_copied);
  }

  /** Those of another window are the same lines; those of another coefficient of restitution are others. */
  private linesOf(state: State): Branches | null {
    return areDrawn(state) && this.lines?.restitution === state.system.restitution ? this.lines : null;
  }

  private paint(pen: Pen, plot: Plot): void {
    this.dots.paint(pen, plot, this.diagram.quantity);
    const state = this.context.state();
    const x = pixelX(plot, state.summary?.axial_forcing ?? NaN);
    pen.path([x, plot.top, x, plot.top + plot.height], { stroke: "--picture-muted", width: 1, dash: [2, 3] });
    const lines = this.linesOf(state);
    if (lines !== null) paintBranches(pen, plot, lines, state.diagram.quantity);
  }

  /** Gives the shared system the amplitude of this forcing. */
  private choose(forcing: number): void {
    const { state, change, status } = this.context;
    change(
      { system: { set: [["axial_forcing", forcing]] } },
      { taken: () => status(say(TEXTS.chosen, { forcing: plain(forcing, 6), amplitude: plain(state().system.amplitude, 5) })) },
    );
  }
}

/** What the diagram depends on: the vertical motion on less than the rotation. */
function basisOf(state: State, lines: Branches | null): Basis {
  const { quantity, drive, axial_forcing } = state.diagram;
  const names = quantity === "angular_speed" ? PARTS.rotation : PARTS.vertical;
  const driven = drive === "sine" ? [] : [say(WORDS.files.drive, { drive: TEXTS.drives[drive] })];
  const branches = !lines?.json.branches ? [] : [TEXTS.key, describeBifurcations(lines, axial_forcing)];
  return { state, names, more: [...driven, ...branches] };
}

/** What the columns depend on: the amplitude of the system does not count, for the forcing takes its place. */
function keyOf({ system, ...others }: Wanted): string {
  const { amplitude: _, ...rest } = system;
  const { restitution, contact_time, angular_frequency } = system;
  return JSON.stringify([others, others.rotation ? rest : [restitution, contact_time && [contact_time, angular_frequency]]]);
}
