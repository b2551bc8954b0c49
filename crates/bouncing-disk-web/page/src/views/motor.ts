/** The motor of the shared system: data sheet, run-up, and what it does under load. */

import "./views.css";

import { Cancelled } from "../contract";
import type { Context, Offer, State, View } from "../contract";
import { ScreenChart } from "../drawing/chart_screen";
import type { Chart } from "../drawing/chart";
import { debounced, element, oncePerFrame, setText } from "../drawing/elements";
import { clamp } from "../drawing/scale";
import type { MotorSheet, Range, ReportJson, StallJson } from "../protocol";
import { tellFailure } from "./failures";
import { loadCharts, transientChart } from "./motor/charts";
import { MEMBERS, operate, PASSES, reportOf, sheetOf, stallOf, transientOf } from "./motor/computation";
import type { Operation, Pass, Transient } from "./motor/computation";
import { motorOffers } from "./motor/offers";
import { ReportPanel } from "./motor/report_panel";
import { SheetPanel } from "./motor/sheet_panel";
import type { Imported } from "./motor/sheet_panel";
import { describeCurves, describeRunUp, whyNothingTurns } from "./motor/words";

const REMARK =
  `Bands are two standard errors wide on either side; run-ups are means of ${MEMBERS} motors. ` +
  "A hollow circle is a load under which the motion has not settled: its numbers are the best so far. " +
  "A cross is a load that drives the rotor.";

const SLOTS = ["motor-report", "motor-transient", "motor-loads", "motor-stall"] as const;

/** Two charts above each other fill a window of any height, as far as they can still be read. */
const chartHeight = (): number => clamp(window.innerHeight / 2 - 150, 230, 560);

class MotorView implements View {
  readonly name = "motor";
  readonly title = "Motor";
  readonly description = "The system as a motor: data sheet, run-up, speed, power and efficiency against load.";
  private context!: Context;
  private sheetPanel!: SheetPanel;
  private readonly reportPanel = new ReportPanel();
  private readonly runUpChart = new ScreenChart(chartHeight);
  private readonly curveCharts = [0, 1, 2].map(() => new ScreenChart(chartHeight));
  private readonly remark = element("p", { class: "remark" });
  private sheet: MotorSheet | null = null;
  private text = "";
  private report: ReportJson | null = null;
  private transient: Transient | null = null;
  private operations: readonly Operation[] = [];
  /** The operation under the load of the sheet. */
  private own: Operation | null = null;
  /** Why there is no run-up, and no curve, where they cannot be computed. */
  private problems: { runUp?: string; curve?: string } = {};
  private loads: Range = [0, 1];
  private stall: StallJson | null = null;
  private imported: Imported | null = null;
  /** The state that is shown, and the one that is computed or was: "" if none is. */
  private shown = "";
  private asked = "";
  private complete = false;
  private readonly compute = debounced(150, () => void this.fetch());
  private readonly draw = oncePerFrame(() => this.paint());

  mount(host: HTMLElement, context: Context): void {
    this.context = context;
    this.sheetPanel = new SheetPanel(context, (imported) => {
      this.imported = imported;
      context.change({ system: imported.system, mass: imported.mass });
    });
    const [speed, power, efficiency] = this.curveCharts;
    host.append(
      element(
        "div",
        { class: "motor" },
        this.reportPanel.trap,
        element(
          "section",
          { "aria-label": "Run-up and speed" },
          ...[this.runUpChart, speed].map((chart) => chart?.root ?? ""),
        ),
        element(
          "section",
          { "aria-label": "Power and efficiency" },
          ...[power, efficiency].map((chart) => chart?.root ?? ""),
          this.remark,
        ),
        element("div", { class: "motor-words" }, this.reportPanel.root, this.sheetPanel.root),
      ),
    );
    setText(this.remark, REMARK);
  }

  show(): void {
    const key = keyOf(this.context.state());
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
    for (const slot of SLOTS) this.context.client.cancel(slot);
    if (!this.complete) this.asked = "";
  }

  redraw(): void {
    this.draw();
  }

  offers(): Offer[] {
    const { sheet, text, transient, operations, own } = this;
    if (sheet === null || text === "") return [];
    const runUp = transient === null ? null : transientChart(transient, own);
    return motorOffers({ sheet, text, transient, operations, runUp, curves: this.curves() });
  }

  private curves(): Chart[] {
    if (this.operations.length === 0 || this.report === null) return [];
    return loadCharts(this.operations, this.loads, this.report.largest_torque, this.stall);
  }

  private forget(): void {
    for (const slot of SLOTS) this.context.client.cancel(slot);
    this.asked = "";
    this.complete = false;
    this.sheet = null;
    this.text = "";
    this.report = null;
    this.transient = null;
    this.operations = [];
    this.own = null;
    this.stall = null;
    this.problems = {};
    this.sheetPanel.show("");
    this.reportPanel.clear();
  }

  private async fetch(): Promise<void> {
    const state = this.context.state();
    const key = keyOf(state);
    if (key === this.asked) return;
    this.forget();
    this.draw();
    this.asked = key;
    try {
      await this.computeAll(state, key);
    } catch (error) {
      if (this.asked === key && error instanceof Cancelled) this.asked = "";
      tellFailure(this.context, error);
    }
  }

  private async computeAll(state: State, key: string): Promise<void> {
    const { context } = this;
    const present = () => this.asked === key;
    context.status("Reading the data sheet", "busy");
    const sheet = this.sheetKnown(state) ?? (await sheetOf(context, state));
    const { json } = await context.client.ask("motor-write", { call: "sheet_write", sheet });
    if (!present()) return;
    this.sheet = sheet;
    this.text = (json as { text: string }).text;
    this.sheetPanel.show(this.text);
    const report = await reportOf(context, sheet);
    if (!present()) return;
    this.report = report;
    this.reportPanel.report(report);
    this.draw();
    const still = whyNothingTurns(report);
    if (still !== null) {
      this.complete = true;
      this.reportPanel.still();
      context.status(still);
      return;
    }
    context.status("Computing the run-up", "busy");
    try {
      const transient = await transientOf(context, sheet, state.motor.rise_times);
      if (!present()) return;
      this.transient = transient;
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      if (!present()) return;
      this.problems.runUp = messageOf(error);
    }
    this.reportPanel.runUp(this.transient, this.own, this.problems.runUp);
    this.draw();
    await this.computeCurve(sheet, report, state, present);
  }

  private async computeCurve(
    sheet: MotorSheet,
    report: ReportJson,
    state: State,
    present: () => boolean,
  ): Promise<void> {
    const { points, loads } = state.motor;
    const [low, high] = [loads[0] * report.largest_torque, loads[1] * report.largest_torque];
    this.loads = [low, high];
    const torques = Array.from({ length: points }, (_, index) => low + ((high - low) * index) / (points - 1));
    const [rough, fine] = PASSES;
    try {
      await this.sweep(sheet, torques, rough, present);
      if (!present()) return;
      await this.sweep(sheet, torques, fine, present);
      if (!present()) return;
      // It takes longest where nothing bounces, and is the last to be missed.
      await this.findStall(sheet, present);
    } catch (error) {
      if (error instanceof Cancelled || !present()) throw error;
      this.problems.curve = messageOf(error);
      this.draw();
      throw error;
    }
    if (!present()) return;
    this.complete = true;
    const { runUp } = this.problems;
    if (runUp !== undefined) {
      this.context.status(runUp, "error");
      return;
    }
    const unsettled = this.operations.filter(({ status }) => status === 1).length;
    const runaway = this.operations.filter(({ status }) => status === 2).length;
    const words = [`Run-up and ${points} loads are computed`];
    if (unsettled > 0) words.push(`under ${unsettled} of them the motion has not settled`);
    if (runaway > 0) words.push(runaway === 1 ? "one of them drives the rotor" : `${runaway} of them drive the rotor`);
    this.context.status(`${words.join("; ")}.`);
  }

  /** The loads of the curve, and with them that of the sheet, so that there is one steady speed on the page. */
  private async sweep(
    sheet: MotorSheet,
    torques: readonly number[],
    pass: Pass,
    present: () => boolean,
  ): Promise<void> {
    const { load_torque } = sheet;
    const asked = torques.includes(load_torque) ? torques : [...torques, load_torque];
    const error = `${100 * pass.relative_error} %`;
    this.context.status(`Computing the operation under ${asked.length} loads with an error of ${error}`, "busy");
    const found = await operate(this.context, sheet, asked, pass);
    if (!present() || this.report === null) return;
    this.operations = found.slice(0, torques.length);
    this.own = found[asked.indexOf(load_torque)] ?? null;
    if (this.own !== null) this.reportPanel.operation(this.own, this.report);
    this.reportPanel.runUp(this.transient, this.own, this.problems.runUp);
    this.draw();
  }

  /** A stall load that cannot be found is no failure of the view. */
  private async findStall(sheet: MotorSheet, present: () => boolean): Promise<void> {
    this.context.status("Searching the stall load", "busy");
    try {
      const stall = await stallOf(this.context, sheet);
      if (!present()) return;
      this.stall = stall;
      this.reportPanel.stall(stall);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      if (present()) this.reportPanel.stall(null, messageOf(error));
    }
    this.draw();
  }

  /** The sheet that was read, as long as the system is still that of it: it may say more than the system does. */
  private sheetKnown(state: State): MotorSheet | null {
    const { imported } = this;
    if (imported === null || imported.mass !== state.mass) return null;
    const names = Object.keys(state.system) as (keyof typeof state.system)[];
    return names.every((name) => imported.system[name] === state.system[name]) ? imported.sheet : null;
  }

  private paint(): void {
    const { colour } = this.context;
    const { report, transient, problems } = this;
    const still = report === null ? null : whyNothingTurns(report);
    setText(this.remark, still ?? REMARK);
    for (const { root } of [this.runUpChart, ...this.curveCharts]) root.hidden = still !== null;
    if (transient === null || report === null) {
      this.runUpChart.showWord(problems.runUp ?? "The run-up is being computed.");
    } else {
      const words = describeRunUp(transient, this.own, report);
      this.runUpChart.show(transientChart(transient, this.own), colour, words);
    }
    const charts = this.curves();
    const words = describeCurves(this.operations, this.stall);
    this.curveCharts.forEach((place, index) => {
      const chart = charts[index];
      if (chart === undefined) place.showWord(problems.curve ?? `${CURVES[index]} is being computed.`);
      else place.show(chart, colour, words[index]);
    });
  }
}

const CURVES = ["The speed against the load", "The power", "The efficiency"] as const;

const keyOf = ({ system, mass, motor }: State): string => JSON.stringify([system, mass, motor]);

const messageOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

export const view: View = new MotorView();
