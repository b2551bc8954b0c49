/** The motor of the shared system: data sheet, run-up, and what it does under load. */

import { Cancelled, messageOf, type Context, type Offer, type State, type View, type ViewKind } from "../contract";
import { clamp } from "../drawing/axes";
import { ScreenChart, type Chart } from "../drawing/chart";
import { debounced, div, element, oncePerFrame, section, setText } from "../elements";
import type { MotorSheet, Range, ReportJson, SheetJson, StallJson } from "../protocol";
import { WORDS } from "../words";
import { Asked, tellFailure } from "./asking";
import { loadCharts, motorOffers, transientChart } from "./motor/charts";
import {
  membersOf, operate, PASSES, reportOf, sheetOf, SheetPanel, stallOf, transientOf, SLOT, type Operation, type Transient,
} from "./motor/sheet"; // prettier-ignore
import { describeCurves, describeRunUp, ReportPanel, whyNothingTurns } from "./motor/words";

const remarkOf = (sheet: MotorSheet | null): string =>
  `Bands are two standard errors wide on either side; run-ups are means of ${membersOf(sheet)} motors. ` +
  "A hollow circle is a load under which the motion has not settled: its numbers are the best so far. " +
  "A cross is a load that drives the rotor.";

const CURVES = ["The speed against the load", "The power", "The efficiency"] as const;

/** Two charts above each other fill a window of any height, as far as they can still be read. */
const chartHeight = (): number => clamp(window.innerHeight / 2 - 150, 230, 560);

class Known {
  sheet: MotorSheet | null = null;
  text = "";
  report: ReportJson | null = null;
  transient: Transient | null = null;
  operations: readonly Operation[] = [];
  /** The operation under the load of the sheet. */
  own: Operation | null = null;
  /** Why there is no run-up, and no curve, where they cannot be computed. */
  problems: { runUp?: string; curve?: string } = {};
  loads: Range = [0, 1];
  stall: StallJson | null = null;
}

class MotorView implements View {
  private readonly sheetPanel: SheetPanel;
  private readonly reportPanel = new ReportPanel();
  private readonly runUpChart = new ScreenChart(chartHeight);
  private readonly curveCharts = CURVES.map(() => new ScreenChart(chartHeight));
  private readonly remark = element("p", { class: "remark" });
  private known = new Known();
  private imported: SheetJson | null = null;
  /** What the motor that is shown depends on. */
  private shown = "";
  private readonly all = new Asked<void>();
  private readonly compute = debounced(150, () => void this.fetch());
  private readonly draw = oncePerFrame(() => this.paint());

  constructor(
    host: HTMLElement,
    private readonly context: Context,
  ) {
    this.sheetPanel = new SheetPanel(context, (imported) => {
      this.imported = imported;
      context.change({ system: imported.system, mass: imported.mass });
      this.show(context.state());
    });
    const [runUp, speed, power, efficiency] = [this.runUpChart, ...this.curveCharts].map(({ root }) => root);
    const charts = [
      section("Run-up and speed", null, runUp ?? null, speed ?? null),
      section("Power and efficiency", null, power ?? null, efficiency ?? null, this.remark),
    ];
    const words = div("motor-words", this.reportPanel.root, this.sheetPanel.root);
    host.append(div("motor", this.reportPanel.trap, ...charts, words));
  }

  show(state: State): void {
    const key = this.keyOf(state);
    // What is known of one motor never stands under another one, however long that one takes.
    if (key !== this.shown) {
      this.shown = key;
      this.forget();
    }
    this.compute();
    this.draw();
  }

  hide(): void {
    this.compute.stop();
    this.context.client.cancel(SLOT);
  }

  redraw(): void {
    this.draw();
  }

  offers(): Offer[] {
    const { sheet, text, transient, operations, own } = this.known;
    if (sheet === null || text === "") return [];
    const runUp = transient === null ? null : transientChart(transient, own);
    return motorOffers({ sheet, text, transient, operations, runUp, curves: this.curves() });
  }

  private curves(): Chart[] {
    const { operations, loads, report, stall } = this.known;
    return operations.length === 0 || report === null ? [] : loadCharts(operations, loads, report.largest_torque, stall);
  } // prettier-ignore

  private forget(): void {
    this.context.client.cancel(SLOT);
    this.all.forget();
    this.known = new Known();
    this.sheetPanel.show("");
    this.reportPanel.clear();
  }

  private async fetch(): Promise<void> {
    const state = this.context.state();
    try {
      await this.all.get(this.keyOf(state), () => this.computeAll(state, (this.known = new Known())));
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  /** Fills in what is known of a motor; where another one is shown, what is asked for next is cancelled. */
  private async computeAll(state: State, known: Known): Promise<void> {
    const { context, reportPanel } = this;
    context.status("Reading the data sheet", "busy");
    const sheet = this.sheetKnown(state) ?? (await sheetOf(context, state));
    const { json } = await context.client.ask<{ text: string }>(SLOT, { call: "sheet_write", sheet });
    known.sheet = sheet;
    known.text = json.text;
    this.sheetPanel.show(known.text);
    this.sheetPanel.stator(sheet.stator ?? null);
    const report = await reportOf(context, sheet);
    known.report = report;
    reportPanel.report(report);
    this.draw();
    const still = whyNothingTurns(report);
    if (still !== null) {
      reportPanel.still();
      context.status(still);
      return;
    }
    context.status("Computing the run-up", "busy");
    try {
      known.transient = await transientOf(context, sheet, state.motor.rise_times);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      known.problems.runUp = messageOf(error);
    }
    reportPanel.runUp(known.transient, known.own, known.problems.runUp);
    this.draw();
    try {
      for (const pass of PASSES) await this.sweep(sheet, report, state, pass, known);
      // It takes longest where nothing bounces, and is the last to be missed.
      await this.findStall(sheet, known);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      known.problems.curve = messageOf(error);
      this.draw();
      throw error;
    }
    if (known.problems.runUp !== undefined) context.status(known.problems.runUp, "error");
    else context.status(summaryOf(known.operations));
  }

  /** The loads of the curve, and with them that of the sheet, so that there is one steady speed on the page. */
  private async sweep(
    sheet: MotorSheet,
    report: ReportJson,
    { motor: { points, loads } }: State,
    pass: (typeof PASSES)[number],
    known: Known,
  ): Promise<void> {
    const [low, high] = [loads[0] * report.largest_torque, loads[1] * report.largest_torque];
    const torques = Array.from({ length: points }, (_, index) => low + ((high - low) * index) / (points - 1));
    const { load_torque } = sheet;
    const asked = torques.includes(load_torque) ? torques : [...torques, load_torque];
    const error = `${100 * pass.relative_error} %`;
    this.context.status(`Computing the operation under ${asked.length} loads with an error of ${error}`, "busy");
    const found = await operate(this.context, sheet, asked, pass);
    known.loads = [low, high];
    known.operations = found.slice(0, torques.length);
    known.own = found[asked.indexOf(load_torque)] ?? null;
    if (known.own !== null) this.reportPanel.operation(known.own, report);
    this.reportPanel.runUp(known.transient, known.own, known.problems.runUp);
    this.draw();
  }

  /** A stall load that cannot be found is no failure of the view. */
  private async findStall(sheet: MotorSheet, known: Known): Promise<void> {
    this.context.status("Searching the stall load", "busy");
    let problem = "";
    try {
      known.stall = await stallOf(this.context, sheet);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      problem = messageOf(error);
    }
    this.reportPanel.stall(known.stall, problem);
    this.draw();
  }

  /** The sheet that was read, as long as the system is still that of it: it may say more than the system does. */
  private sheetKnown(state: State): MotorSheet | null {
    const { imported } = this;
    if (imported === null || imported.mass !== state.mass) return null;
    const names = Object.keys(state.system) as (keyof typeof state.system)[];
    return names.every((name) => imported.system[name] === state.system[name]) ? imported.sheet : null;
  }

  private keyOf(state: State): string {
    return JSON.stringify([state.system, state.mass, state.motor, this.sheetKnown(state)?.stator ?? null]);
  }

  private paint(): void {
    const { report, transient, problems, own, operations, stall } = this.known;
    const still = report === null ? null : whyNothingTurns(report);
    setText(this.remark, still ?? remarkOf(this.known.sheet));
    for (const { root } of [this.runUpChart, ...this.curveCharts]) root.hidden = still !== null;
    if (transient === null || report === null)
      this.runUpChart.showWord(problems.runUp ?? "The run-up is being computed.");
    else this.runUpChart.show(transientChart(transient, own), describeRunUp(transient, own, report));
    const charts = this.curves();
    const words = describeCurves(operations, stall);
    this.curveCharts.forEach((place, index) => {
      const chart = charts[index];
      if (chart === undefined) place.showWord(problems.curve ?? `${CURVES[index]} is being computed.`);
      else place.show(chart, words[index]);
    });
  }
}

function summaryOf(operations: readonly Operation[]): string {
  const unsettled = operations.filter(({ status }) => status === 1).length;
  const runaway = operations.filter(({ status }) => status === 2).length;
  const words = [`Run-up and ${operations.length} loads are computed`];
  if (unsettled > 0) words.push(`under ${unsettled} of them the motion has not settled`);
  if (runaway > 0) words.push(runaway === 1 ? "one of them drives the rotor" : `${runaway} of them drive the rotor`);
  return `${words.join("; ")}.`;
}

export const motor: ViewKind = {
  name: "motor",
  ...WORDS.views.motor,
  make: (host, context) => new MotorView(host, context),
};
