/** What the motor's view asks for, in the order in which it matters to a reader, and the panel of its data sheet. */

import type { Context, State } from "../../contract";
import { save } from "../../drawing/files";
import { button, div, element, section } from "../../elements";
import {
  OPERATION_COLUMNS, type MotorSheet, type ReportJson, type SheetJson, type StallJson, type StatorSheet,
  type TransientJson,
} from "../../protocol"; // prettier-ignore
import { say, WORDS } from "../../words";
import { tellFailure } from "../asking";

/** Of all that is asked of a motor, one after the other. */
export const SLOT = "motor";
/** The seed of all random numbers, so that everybody gets the same ones. */
export const SEED = 1;
/** Motors of a run-up; those whose contacts take time are nearly alike, and take longer, as those on a stator that yields. */
export const membersOf = (sheet: MotorSheet | null): number =>
  sheet?.contact?.time === undefined && !sheet?.stator ? 16 : 5;
const TRANSIENT_POINTS = 160;
/** The curve is there soon, roughly, and then sharpens: a motor that settles late takes more impacts. */
export const PASSES = [
  { relative_error: 0.1, most_impacts: 5_000_000 },
  { relative_error: 0.02, most_impacts: 20_000_000 },
] as const;
const STALL_ERROR = 0.02;

const WIDTH = OPERATION_COLUMNS.length;

/** One load: a row by the names of `OPERATION_COLUMNS`. */
export type Operation = Record<(typeof OPERATION_COLUMNS)[number], number> & {
  readonly shortfall: string | null;
  /** Of a stator that yields (m). */
  readonly amplitude: number | null;
  /** The relative error that was asked for. */
  readonly wanted: number;
};

export interface Transient {
  readonly json: TransientJson;
  readonly numbers: Float64Array;
}

/** The sheet of the shared system. */
export async function sheetOf({ client }: Context, { system, mass }: State): Promise<MotorSheet> {
  return (await client.ask<SheetJson>(SLOT, { call: "sheet_of_system", system, mass })).json.sheet;
}

export async function reportOf({ client }: Context, sheet: MotorSheet): Promise<ReportJson> {
  return (await client.series<ReportJson>(SLOT, [{ call: "motor_report", sheet }])).json;
}

export function transientOf({ client }: Context, sheet: MotorSheet, rise_times: number): Promise<Transient> {
  const request = { sheet, members: membersOf(sheet), rise_times, points: TRANSIENT_POINTS, seed: SEED };
  return client.series<TransientJson>(SLOT, [{ call: "motor_transient", ...request }]);
}

/** All loads on one vertical motion: points of a curve that share their impacts are told apart best, and cost little
 * more than one of them. */
export async function operate(
  { client }: Context,
  sheet: MotorSheet,
  load_torques: readonly number[],
  pass: (typeof PASSES)[number],
): Promise<Operation[]> {
  const request = { call: "motor_loads", sheet, load_torques, ...pass, seed: SEED } as const;
  type Known = { shortfalls: (string | null)[]; amplitudes: (number | null)[] };
  const { json, numbers } = await client.series<Known>(SLOT, [request]);
  return load_torques.map((_, row) => {
    const columns = OPERATION_COLUMNS.map((name, column) => [name, numbers[row * WIDTH + column]]);
    const shortfall = json.shortfalls[row] ?? null;
    const amplitude = json.amplitudes[row] ?? null;
    return { ...Object.fromEntries(columns), shortfall, amplitude, wanted: pass.relative_error } as Operation;
  });
}

export async function stallOf({ client }: Context, sheet: MotorSheet): Promise<StallJson> {
  const request = { call: "motor_stall", sheet, relative_error: STALL_ERROR, seed: SEED } as const;
  return (await client.series<StallJson>(SLOT, [request])).json;
}

/** A data sheet has some dozen numbers. */
const LONGEST_SHEET = 100_000;
const TEXTS = WORDS.motor.sheet;

const numberField = (name: string, placeholder: string, onchange: () => void): HTMLInputElement =>
  element("input", { type: "text", inputmode: "decimal", size: 8, placeholder, "aria-label": name, onchange });

const label = (words: string, field: HTMLElement): HTMLElement => element("label", { class: "field" }, `${words} `, field);

/** The data sheet: imported by pasting or from a file, shown and exported as JSON. */
export class SheetPanel {
  readonly root: HTMLElement;
  private readonly text = element("textarea", {
    rows: 9, spellcheck: "false", "aria-label": TEXTS.label, class: "sheet-text",
    oninput: () => (this.typed = true),
  }); // prettier-ignore
  private readonly file = element("input", {
    type: "file", accept: ".json,application/json", hidden: true, onchange: () => void this.readFile(),
  }); // prettier-ignore
  private typed = false;
  private readonly mass = numberField(TEXTS.mass, TEXTS.rigid, () => this.yield());
  private readonly quality = numberField(TEXTS.quality, "300", () => this.yield());
  private readonly twists = element("input", { type: "checkbox", onchange: () => void this.yield() });

  constructor(
    private readonly context: Context,
    private readonly take: (imported: SheetJson) => void,
  ) {
    const bar = div(
      "bar",
      button(TEXTS.use, () => void this.read(this.text.value)),
      button(TEXTS.open, () => this.file.click()),
      button(TEXTS.save, () => save(new Blob([this.text.value], { type: "application/json" }), "motor.json")),
      this.file,
    );
    const stator = element(
      "fieldset", {}, element("legend", {}, TEXTS.stator), label(TEXTS.mass, this.mass),
      label(TEXTS.quality, this.quality), label(TEXTS.twists, this.twists),
      element("p", { class: "remark" }, TEXTS.yields),
    ); // prettier-ignore
    const remark = element("p", { class: "remark" }, TEXTS.remark);
    const parts = [element("h3", {}, TEXTS.title), stator, this.text, bar, remark];
    this.root = section(TEXTS.title, "panel", ...parts);
  }

  /** Shows a text, unless somebody is about to write another one. */
  show(text: string): void {
    if (!this.typed) this.text.value = text;
  }

  /** Shows the stator of a sheet. */
  stator(stator: StatorSheet | null): void {
    if (this.root.contains(document.activeElement)) return;
    this.mass.value = stator?.mass === undefined ? "" : String(Number((1e3 * stator.mass).toPrecision(12)));
    this.quality.value = stator?.quality === undefined ? "" : String(stator.quality);
    this.twists.checked = stator?.kind === "axial_twist";
  }

  /** Puts the mode of the fields into the sheet. */
  private yield(): void {
    let sheet: { stator?: StatorSheet };
    try {
      sheet = JSON.parse(this.text.value) as typeof sheet;
    } catch {
      this.context.status(TEXTS.no_json, "error");
      return;
    }
    if (this.mass.value === "") delete sheet.stator;
    else {
      // What the fields do not show stays: volts, a resonance, a second mode.
      const known = sheet.stator;
      const kind = this.twists.checked ? "axial_twist" : known?.kind === "axial_and_torsional" ? known.kind : "axial";
      const [mass, quality] = [1e-3 * Number(this.mass.value), Number(this.quality.value || "300")];
      sheet.stator = { ...known, kind, mass, quality };
    }
    void this.read(JSON.stringify(sheet));
  }

  private async read(text: string): Promise<void> {
    if (text.length > LONGEST_SHEET) {
      this.context.status(TEXTS.too_long, "error");
      return;
    }
    try {
      const { json } = await this.context.client.ask<SheetJson>("motor-read", { call: "sheet_read", text });
      this.typed = false;
      this.take(json);
      this.context.status(TEXTS.read);
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private async readFile(): Promise<void> {
    const file = this.file.files?.[0];
    this.file.value = "";
    if (file === undefined) return;
    if (file.size > LONGEST_SHEET) {
      this.context.status(say(TEXTS.file_too_long, { name: file.name }), "error");
      return;
    }
    this.text.value = await file.text();
    this.typed = true;
    await this.read(this.text.value);
  }
}
