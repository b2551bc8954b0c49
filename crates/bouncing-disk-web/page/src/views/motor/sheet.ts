/** The panel of a motor's data sheet. */

import type { Context } from "../../contract";
import { button, div, element, labelled, section } from "../../elements";
import type { MotorSheet, SheetJson } from "../../protocol";
import { WORDS } from "../../words";
import { tellFailure } from "../asking";
import { LabelledField } from "../varied";
import type { Known } from "./requests";

const TEXTS = WORDS.motor.sheet;

/** The data sheet: edited or pasted, shown and exported as JSON. */
export class SheetPanel {
  readonly root: HTMLElement;
  private readonly text = element("textarea", {
    rows: 9, spellcheck: "false", "aria-label": TEXTS.label, class: "sheet-text",
    oninput: () => (this.typed = true),
  }); // prettier-ignore
  private typed = false;
  private readonly mass: LabelledField;
  private readonly quality: LabelledField;
  private readonly twists = element("input", { type: "checkbox", onchange: () => this.yield() });

  constructor(
    private readonly context: Context,
    private readonly take: (read: SheetJson) => void,
  ) {
    this.mass = new LabelledField(TEXTS.mass, context, () => this.yield());
    this.quality = new LabelledField(TEXTS.quality, context, () => this.yield());
    const stator = [this.mass.root, this.quality.root, labelled(TEXTS.twists, this.twists)];
    const use = button(TEXTS.use, () => void this.read(() => this.text.value));
    const parts = [element("h3", {}, TEXTS.title), div("bar", ...stator), this.text, div("bar", use)];
    this.root = section(TEXTS.title, "panel", ...parts, element("p", { class: "remark" }, TEXTS.remark));
  }

  /** Shows a sheet; its text, unless somebody is about to write another one. */
  show({ text, sheet }: Known): void {
    if (!this.typed) this.text.value = text;
    if (sheet === null) return;
    const { kind, mass = 0, quality = 300 } = sheet.stator ?? {};
    this.mass.show([mass], { unit: "kg" });
    this.quality.show([quality]);
    this.twists.checked = kind === "axial_twist";
    for (const input of [this.quality.input, this.twists]) input.disabled = mass === 0;
  }

  /** Puts the mode of the fields into the sheet; what they do not show stays: volts, a resonance, a second mode. */
  private yield(): void {
    const [[mass], [quality]] = [this.mass, this.quality].map((field) => field.numbers() ?? []) as [number[], number[]];
    if (mass === 0) return this.context.change({ motor: { stator: null } });
    void this.read(() => {
      const { stator, ...rigid } = JSON.parse(this.text.value) as MotorSheet;
      const other = stator?.kind === "axial_and_torsional" ? stator.kind : "axial";
      const kind = this.twists.checked ? "axial_twist" : other;
      return JSON.stringify({ ...rigid, stator: { ...stator, kind, mass, quality } });
    });
  }

  /** Takes a sheet, or says what is wrong with it. */
  private async read(written: () => string): Promise<void> {
    try {
      const { json } = await this.context.client.ask<SheetJson>("motor-read", { call: "sheet_read", text: written() });
      this.typed = false;
      this.take(json);
      this.context.status(TEXTS.read);
    } catch (error) {
      tellFailure(this.context, error);
    }
  }
}
