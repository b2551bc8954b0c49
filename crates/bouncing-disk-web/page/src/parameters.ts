/** The form of all parameters. */

import type { State } from "./contract";
import { element } from "./elements";
import { Field, type Propose } from "./field";
import { GROUPS } from "./parameter_list";
import type { Summary } from "./protocol";

export class Parameters {
  private readonly fields: Field[] = [];
  private summary: Summary | null = null;

  constructor(host: HTMLElement, propose: Propose) {
    for (const { title, parameters } of GROUPS) {
      const fields = parameters.map((parameter) => new Field(parameter, propose));
      this.fields.push(...fields);
      host.append(
        element("details", { class: "group", open: true },
          element("summary", {}, title), ...fields.map((field) => field.element)),
      ); // prettier-ignore
    }
  }

  /** What follows from the state that is shown next. */
  follow(summary: Summary): void {
    this.summary = summary;
  }

  show(state: State, fresh: boolean): void {
    for (const field of this.fields) field.show(state, this.summary, fresh);
  }
}
