/** The motor of the shared system: data sheet, run-up, and what it does under load. */

import { Cancelled, messageOf, type Context, type Offer, type State } from "../contract";
import { clamp, evenly } from "../drawing/axes";
import { ScreenChart, type Chart } from "../drawing/chart";
import { PARTS, rowsOf, statorWords } from "../drawing/files";
import { byId, div, element, oncePerFrame, roomBelow, section, setText } from "../elements";
import { percent } from "../numbers";
import { changed, MOST_RISE_TIMES } from "../state";
import { TRANSIENT_COLUMNS, type MotorSheet, type ReportJson, type SheetJson } from "../protocol";
import { say, WORDS } from "../words";
import { Asked, attractorsCaution, ComputingView } from "./asking";
import { loadCharts, motorOffers, transientChart } from "./motor/charts";
import { Known, membersOf, operate, PASSES, reportOf, sheetOf, stallOf, transientOf, SLOT } from "./motor/requests";
import type { Pass } from "./motor/requests";
import { SheetPanel } from "./motor/sheet";
import { describeCurves, describeRunUp, ReportPanel, whyNothingTurns } from "./motor/words";

const CURVES = Object.values(WORDS.motor.curves);

/** Loads of the curve, from none to the largest torque of friction. */
const LOADS = 9;

/** A run-up that does not come this near (relative) to the steady speed goes on, three times as long, so many times. */
const NEAR = 0.05;
const LENGTHENINGS = 3;

/** Two charts above each other fill a window of any height, as far as they can still be read. */
const chartHeight = (): number => clamp(roomBelow(byId("views")) / 2 - 108, 180, 560);

export class MotorView extends ComputingView {
  private readonly sheetPanel: SheetPanel;
  private readonly reportPanel = new ReportPanel();
  private readonly runUpChart = new ScreenChart(chartHeight);
  private readonly curveCharts = CURVES.map(() => new ScreenChart(chartHeight));
  private readonly remark = element("p", { class: "remark" });
  private readonly attractors = attractorsCaution();
  private known = new Known();
  /** The sheet that was read, and the motor of which it may say more than the state does. */
  private read: { sheet: SheetJson; of: string } | null = null;
  /** What the motor that is shown depends on. */
  private shown = "";
  private readonly all = new Asked<void>();
  protected readonly draw = oncePerFrame(() => this.paint());

  constructor(host: HTMLElement, context: Context) {
    super(context, [SLOT]);
    this.sheetPanel = new SheetPanel(context, (read) => {
      const { system, mass, sheet } = read;
      const change = { system, mass, motor: { stator: sheet.stator ?? null } };
      this.read = { sheet: read, of: motorOf(changed(context.state(), change)) };
      // One that says nothing new is shown again all the same.
      this.shown = "";
      context.change(change);
    });
    const [speed, ...others] = this.curveCharts.map(({ root }) => root);
    const charts = [
      section(WORDS.motor.panels.run_up, null, this.runUpChart.root, speed ?? null),
      section(WORDS.motor.panels.power, null, ...others, this.remark),
    ];
    const words = div("motor-words", this.reportPanel.root, this.sheetPanel.root);
    host.append(div("motor", this.attractors.root, this.reportPanel.trap, ...charts, words));
  }

  show(state: State): void {
    const key = keyOf(state);
    // What is known of one motor never stands under another one, however long that one takes.
    if (key !== this.shown) this.forget();
    this.shown = key;
    this.attractors.show(this.context, state);
    this.redraw();
  }

  offers(): Offer[] {
    const { text, transient, own } = this.known;
    if (text === "") return [];
    const runUp = transient === null ? null : transientChart(transient, own);
    const state = this.context.state();
    const basis = { state, names: PARTS.rotor, more: statorWords(state) };
    return motorOffers(this.known, runUp, this.curves(), basis);
  }

  private curves(): Chart[] {
    const { operations, report, stall } = this.known;
    return report === null ? [] : loadCharts(operations, report.largest_torque, stall);
  }

  private forget(): void {
    this.context.client.cancel(SLOT);
    this.all.forget();
    this.known = new Known();
    this.sheetPanel.show(this.known);
  }

  protected async fetch(): Promise<void> {
    const state = this.context.state();
    await this.all.get(keyOf(state), () => this.computeAll(state, this.known));
  }

  /** Fills in what is known of a motor; where another one is shown, what is asked for next is cancelled. */
  private async computeAll(state: State, known: Known): Promise<void> {
    const { context } = this;
    context.status(WORDS.motor.reading, "busy");
    const { sheet, text } = this.read?.of === motorOf(state) ? this.read.sheet : await sheetOf(context, state);
    Object.assign(known, { sheet, text });
    this.sheetPanel.show(known);
    const report = await reportOf(context, sheet);
    known.report = report;
    this.draw();
    const still = whyNothingTurns(report);
    if (still !== null) return context.status(still);
    const { rise_times } = state.motor;
    known.problems = {};
    if (known.transient === null) await this.runUp(sheet, rise_times, known);
    try {
      for (const pass of PASSES.slice(known.passes)) {
        await this.sweep(sheet, report, pass, known);
        // A run-up is shown until it is steady, or said not to be.
        for (let times = 1; known.passes === 0 && times <= LENGTHENINGS && !isSteady(known); times += 1)
          await this.runUp(sheet, Math.min(rise_times * 3 ** times, MOST_RISE_TIMES), known);
        known.passes += 1;
      }
      // It takes longest where nothing bounces, and is the last to be missed.
      if (known.stall === null) await this.findStall(sheet, known);
    } catch (error) {
      known.problems.curve = problemOf(error);
      this.draw();
      throw error;
    }
    if (known.problems.runUp !== undefined) context.status(known.problems.runUp, "error");
    else context.status(say(WORDS.motor.done, { loads: known.operations.length }));
  }

  private async runUp(sheet: MotorSheet, rise_times: number, known: Known): Promise<void> {
    this.context.status(say(WORDS.motor.running_up, { rise_times }), "busy");
    try {
      known.transient = await transientOf(this.context, sheet, rise_times);
    } catch (error) {
      known.problems.runUp = problemOf(error);
    }
    this.draw();
  }

  /** The loads of the curve, and with them that of the sheet, so that there is one steady speed on the page. */
  private async sweep(sheet: MotorSheet, report: ReportJson, pass: Pass, known: Known): Promise<void> {
    const torques = evenly([0, report.largest_torque], LOADS);
    const { load_torque } = sheet;
    const asked = torques.includes(load_torque) ? torques : [...torques, load_torque];
    const values = { loads: asked.length, error: percent(pass.relative_error, 0) };
    this.context.status(say(known.passes === 0 ? WORDS.motor.rough_curve : WORDS.motor.sharp_curve, values), "busy");
    const found = await operate(this.context, sheet, asked, pass);
    known.operations = found.slice(0, torques.length);
    known.own = found[asked.indexOf(load_torque)] ?? null;
    this.draw();
  }

  /** A stall load that cannot be found is no failure of the view. */
  private async findStall(sheet: MotorSheet, known: Known): Promise<void> {
    this.context.status(WORDS.motor.searching_stall, "busy");
    try {
      known.stall = await stallOf(this.context, sheet);
    } catch (error) {
      known.problems.stall = problemOf(error);
    }
    this.draw();
  }

  private paint(): void {
    const { report, transient, problems, own, operations, stall } = this.known;
    this.reportPanel.show(this.known);
    const still = report === null ? null : whyNothingTurns(report);
    setText(this.remark, still ?? say(WORDS.motor.remark, { members: membersOf(this.known.sheet) }));
    for (const { root } of [this.runUpChart, ...this.curveCharts]) root.hidden = still !== null;
    if (transient === null || report === null) this.runUpChart.showWord(problems.runUp ?? WORDS.motor.run_up_coming);
    else {
      const rising = isSteady(this.known) ? "" : ` ${WORDS.motor.still_rising}`;
      this.runUpChart.show(transientChart(transient, own), describeRunUp(transient, own, report) + rising);
    }
    const charts = this.curves();
    const words = describeCurves(operations, stall);
    const rough = this.known.passes === 0 ? `${WORDS.motor.rough} ` : "";
    this.curveCharts.forEach((place, index) => {
      const chart = charts[index];
      if (chart === undefined) place.showWord(problems.curve ?? CURVES[index] ?? "");
      else place.show(chart, rough + (words[index] ?? ""));
    });
  }
}

/** What tells motors apart, and what tells their pictures apart. */
const motorOf = ({ system, mass, motor }: State): string => JSON.stringify([system, mass, motor.stator]);
const keyOf = ({ system, mass, motor }: State): string => JSON.stringify([system, mass, motor]);

/** What the library says against a motor; where another one is shown by now, nothing. */
function problemOf(error: unknown): string {
  if (error instanceof Cancelled) throw error;
  return messageOf(error);
}

/** Whether the last quarter of the run-up is at the steady speed; nobody knows before there is one. */
function isSteady({ transient, own }: Known): boolean {
  if (transient === null || own?.status !== 0) return true;
  const rows = [...rowsOf(transient.numbers, TRANSIENT_COLUMNS.length)].slice(-Math.ceil(transient.json.points / 4));
  return [rows[0], rows.at(-1)].every((row) => {
    const [speed = NaN, error = NaN] = row?.slice(1) ?? [];
    const slack = NEAR * Math.abs(own.speed) + 3 * Math.hypot(error, own.speed_error);
    return Math.abs(speed - own.speed) <= slack;
  });
}
