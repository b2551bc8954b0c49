/** The panel of a motor's data sheet. */

import type { Context } from "../../contract";
import { button, div, element, section } from "../../elements";
import type { SheetJson } from "../../protocol";
import { WORDS } from "../../words";
import { tellFailure } from "../asking";

const TEXTS = WORDS.motor.sheet;

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

  constructor(
    private readonly context: Context,
    private readonly take: (imported: SheetJson) => void,
  ) {
    const use = button(TEXTS.use, () => void this.read(this.text.value));
    const open = button(TEXTS.open, () => this.file.click());
    const parts = [element("h3", {}, TEXTS.title), this.text, div("bar", use, open, this.file)];
    this.root = section(TEXTS.title, "panel", ...parts, element("p", { class: "remark" }, TEXTS.remark));
  }

  /** Shows a text, unless somebody is about to write another one. */
  show(text: string): void {
    if (!this.typed) this.text.value = text;
  }

  private async read(text: string): Promise<void> {
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
    this.text.value = await file.text();
    this.typed = true;
    await this.read(this.text.value);
  }
}
