/** The data sheet: imported by pasting or from a file, shown and exported as JSON. */

import type { Context } from "../../contract";
import { button, element } from "../../drawing/elements";
import type { MotorSheet, SystemParameters } from "../../protocol";
import { tellFailure } from "../failures";

/** What a sheet says of the shared state. */
export interface Imported {
  readonly sheet: MotorSheet;
  readonly system: SystemParameters;
  readonly mass: number;
}

/** A data sheet has some dozen numbers. */
const LONGEST_SHEET = 100_000;

export class SheetPanel {
  readonly root = element("section", { class: "panel", "aria-label": "Data sheet" });
  private readonly text = element("textarea", {
    rows: 9,
    spellcheck: false,
    "aria-label": "Data sheet as JSON",
    class: "sheet-text",
  });
  private readonly file = element("input", { type: "file", accept: ".json,application/json", hidden: true });
  private typed = false;

  constructor(
    private readonly context: Context,
    private readonly take: (imported: Imported) => void,
  ) {
    this.text.addEventListener("input", () => {
      this.typed = true;
    });
    this.file.addEventListener("change", () => void this.readFile());
    this.root.append(
      element("h3", {}, "Data sheet"),
      this.text,
      element(
        "div",
        { class: "bar" },
        button("Use this sheet", () => void this.read(this.text.value)),
        button("Open a file", () => this.file.click()),
        button("Save as JSON", () => this.save()),
        this.file,
      ),
      element(
        "p",
        { class: "remark" },
        "The sheet of the shared system and mass, as the command line and Python read it. " +
          "Paste another one, or edit it.",
      ),
    );
  }

  /** Shows a text, unless somebody is about to write another one. */
  show(text: string): void {
    if (!this.typed) this.text.value = text;
  }

  private async read(text: string): Promise<void> {
    if (text.length > LONGEST_SHEET) {
      this.context.status("This is too long for a data sheet.", "error");
      return;
    }
    try {
      const { json } = await this.context.client.ask("motor-read", { call: "sheet_read", text });
      this.typed = false;
      this.take(json as Imported);
      this.context.status("The data sheet is read: system and mass are those of it now.");
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private async readFile(): Promise<void> {
    const file = this.file.files?.[0];
    this.file.value = "";
    if (file === undefined) return;
    if (file.size > LONGEST_SHEET) {
      this.context.status(`${file.name} is too long for a data sheet.`, "error");
      return;
    }
    this.text.value = await file.text();
    this.typed = true;
    await this.read(this.text.value);
  }

  private save(): void {
    const link = element("a", {
      href: URL.createObjectURL(new Blob([this.text.value], { type: "application/json" })),
      download: "motor.json",
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
}
