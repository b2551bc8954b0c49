/** The panel of a motor's data sheet. */

import type { Context } from "../../contract";
import { save } from "../../drawing/files";
import { button, div, element, section } from "../../elements";
import type { SheetJson, StatorSheet } from "../../protocol";
import { say, WORDS } from "../../words";
import { typed } from "../../numbers";
import { tellFailure } from "../asking";

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
    const use = button(TEXTS.use, () => void this.read(this.text.value));
    const open = button(TEXTS.open, () => this.file.click());
    const saved = () => save(new Blob([this.text.value], { type: "application/json" }), "motor.json");
    const bar = div("bar", use, open, button(TEXTS.save, saved), this.file);
    const fields = [label(TEXTS.mass, this.mass), label(TEXTS.quality, this.quality), label(TEXTS.twists, this.twists)];
    const remark = (text: string) => element("p", { class: "remark" }, text);
    const stator = element("fieldset", {}, element("legend", {}, TEXTS.stator), ...fields, remark(TEXTS.yields));
    const parts = [element("h3", {}, TEXTS.title), stator, this.text, bar, remark(TEXTS.remark)];
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
    this.quality.value = String(stator?.quality ?? "");
    this.twists.checked = stator?.kind === "axial_twist";
  }

  /** Puts the mode of the fields into the sheet. */
  private yield(): void {
    let sheet: { stator?: StatorSheet };
    try {
      sheet = JSON.parse(this.text.value) as typeof sheet;
    } catch {
      return this.context.status(TEXTS.no_json, "error");
    }
    if (typeof sheet !== "object" || sheet === null) return this.context.status(TEXTS.no_json, "error");
    if (this.mass.value === "") delete sheet.stator;
    else {
      // What the fields do not show stays: volts, a resonance, a second mode.
      const known = sheet.stator;
      const kind = this.twists.checked ? "axial_twist" : known?.kind === "axial_and_torsional" ? known.kind : "axial";
      const [mass, quality] = [1e-3 * (typed(this.mass.value) ?? NaN), typed(this.quality.value || "300") ?? NaN];
      sheet.stator = { ...known, kind, mass, quality };
    }
    void this.read(JSON.stringify(sheet));
  }

  private async read(text: string): Promise<void> {
    if (text.length > LONGEST_SHEET) return this.context.status(TEXTS.too_long, "error");
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
    if (file.size > LONGEST_SHEET)
      return this.context.status(say(TEXTS.file_too_long, { name: file.name }), "error");
    this.text.value = await file.text();
    this.typed = true;
    await this.read(this.text.value);
  }
}
