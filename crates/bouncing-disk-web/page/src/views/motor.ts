/** The motor of the shared system: data sheet, run-up, and what it does under load. */

import "./views.css";

import { Cancelled } from "../contract";
import type { Context, Offer, State, View } from "../contract";
import { ScreenChart } from "../drawing/chart_screen";
import type { Chart } from "../drawing/chart";
import { debounced, element, oncePerFrame, setText } from "../drawing/elements";
import { withError } from "../drawing/numbers";
import { clamp } from "../drawing/scale";
import type { MotorSheet, Range, ReportJson, StallJson } from "../protocol";
import { tellFailure } from "./failures";
import { loadCharts, transientChart } from "./motor/charts";
import { ERRORS, MEMBERS, operate, reportOf, sheetOf, stallOf, transientOf } from "./motor/computation";
import type { Operation, Transient } from "./motor/computation";
import { motorOffers } from "./motor/offers";
import { ReportPanel } from "./motor/report_panel";
import { SheetPanel } from "./motor/sheet_panel";
import type { Imported } from "./motor/sheet_panel";
import { describeCurves } from "./motor/words";

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
  private operations: Operation[] = [];
  private loads: Range = [0, 1];
  private stall: StallJson | null = null;
  private imported: Imported | null = null;
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
    setText(
      this.remark,
      `Bands are two standard errors wide on either side; run-ups are means of ${MEMBERS} motors. ` +
        "A hollow circle is a load under which the motion has not settled: its numbers are the best so far. " +
        "A cross is a load that drives the rotor.",
    );
  }

  show(): void {
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
    const { sheet, text, transient, operations } = this;
    if (sheet === null || text === "") return [];
    const runUp = transient === null ? null : transientChart(transient);
    return motorOffers({ sheet, text, transient, operations, runUp, curves: this.curves() });
  }

  private curves(): Chart[] {
    if (this.operations.length === 0 || this.report === null) return [];
    return loadCharts(this.operations, this.loads, this.report.largest_torque, this.stall);
  }

  private async fetch(): Promise<void> {
    const state = this.context.state();
    const key = JSON.stringify([state.system, state.mass, state.motor]);
    if (key === this.asked) return;
    this.asked = key;
    this.complete = false;
    for (const slot of SLOTS) this.context.client.cancel(slot);
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
    this.transient = null;
    this.operations = [];
    this.stall = null;
    this.reportPanel.report(report);
    if (!this.turns) {
      this.complete = true;
      this.draw();
      context.status("Without friction nothing turns the rotor: there is no run-up, and no curve.");
      return;
    }
    context.status("Computing the run-up", "busy");
    const transient = await transientOf(context, sheet, state.motor.rise_times);
    if (!present()) return;
    this.transient = transient;
    this.reportPanel.transient(transient.json);
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
    const [rough, fine] = ERRORS;
    await this.sweep(sheet, torques, rough, present);
    if (!present()) return;
    await this.findStall(sheet, present);
    if (!present()) return;
    await this.sweep(sheet, torques, fine, present);
    if (!present()) return;
    this.complete = true;
    const unsettled = this.operations.filter(({ status }) => status === 1).length;
    const runaway = this.operations.filter(({ status }) => status === 2).length;
    const words = [`Run-up and ${points} loads are computed`];
    if (unsettled > 0) words.push(`under ${unsettled} of them the motion has not settled`);
    if (runaway > 0) words.push(runaway === 1 ? "one of them drives the rotor" : `${runaway} of them drive the rotor`);
    this.context.status(`${words.join("; ")}.`);
  }

  private async sweep(
    sheet: MotorSheet,
    torques: readonly number[],
    error: number,
    present: () => boolean,
  ): Promise<void> {
    await operate(this.context, sheet, torques, error, (operation, index) => {
      if (!present()) return;
      this.operations[index] = operation;
      this.context.status(
        `Load ${index + 1} of ${torques.length} with an error of ${100 * error} % of the speed`,
        "busy",
      );
      this.draw();
    });
  }

  /** A motor that no load stops, or that does not turn, has no stall load: that is no failure of the view. */
  private async findStall(sheet: MotorSheet, present: () => boolean): Promise<void> {
    this.context.status("Searching the stall load", "busy");
    try {
      const stall = await stallOf(this.context, sheet);
      if (!present()) return;
      this.stall = stall;
      this.reportPanel.stall(stall);
    } catch (error) {
      if (error instanceof Cancelled) throw error;
      if (present()) this.reportPanel.stall(null, error instanceof Error ? error.message : String(error));
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

  /** Whether there is a torque at all. */
  private get turns(): boolean {
    return this.report === null || this.report.largest_torque > 0;
  }

  private paint(): void {
    const { colour } = this.context;
    for (const { root } of [this.runUpChart, ...this.curveCharts]) root.hidden = !this.turns;
    if (this.transient !== null) {
      const { steady_speed, steady_speed_error } = this.transient.json;
      const steady =
        steady_speed === null
          ? "No steady speed is known."
          : `The speed tends to ${withError(steady_speed, steady_speed_error)} rad/s.`;
      this.runUpChart.show(transientChart(this.transient), colour, steady);
    }
    const words = describeCurves(this.operations, this.stall);
    this.curves().forEach((chart, index) => this.curveCharts[index]?.show(chart, colour, words[index]));
  }
}

export const view: View = new MotorView();
