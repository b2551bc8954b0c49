/** The branches of the present window: asked for, kept, drawn and told. */

import type { Context, State } from "../../contract";
import type { Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import type { Pen } from "../../drawing/pen";
import type { BranchesJson } from "../../protocol";
import { tellFailure } from "../failures";
import { describeBifurcations, paintBranches } from "./branches";
import type { Branches } from "./branches";

const SLOT = "diagram-branches";

export class BranchLines {
  private found: (Branches & { readonly restitution: number }) | null = null;
  private asked = "";
  private done = "";

  constructor(private readonly context: Context) {}

  /** Asks for those of a state, unless they are there (or none is wanted: ready) or on their way (missing). */
  async fetch(state: State): Promise<"ready" | "came" | "missing"> {
    const { restitution } = state.system;
    const { axial_forcing } = state.diagram;
    const key = JSON.stringify([restitution, axial_forcing]);
    if (!isDrawn(state)) return "ready";
    if (key === this.asked) return key === this.done ? "ready" : "missing";
    this.asked = key;
    this.context.status("Continuing the branches", "busy");
    try {
      await this.context.client.series(SLOT, [{ call: "branches", restitution, axial_forcing }], (response) => {
        this.found = { json: response.json as BranchesJson, numbers: response.numbers, restitution };
      });
      this.done = key;
      return this.asked === key ? "came" : "missing";
    } catch (error) {
      if (this.asked === key) this.asked = this.done = "";
      tellFailure(this.context, error);
      return "missing";
    }
  }

  /** What does not come is asked for when it is wanted again. */
  cancel(): void {
    this.context.client.cancel(SLOT);
    this.asked = this.done;
  }

  paint(pen: Pen, plot: Plot, state: State, colour: Colours): void {
    const lines = this.of(state);
    if (lines !== null) paintBranches(pen, plot, lines, state.diagram.quantity, colour);
  }

  describe(state: State): string {
    const lines = this.of(state);
    return lines === null ? "" : ` ${describeBifurcations(lines, state.diagram.axial_forcing)}`;
  }

  /** Those of another window are the same lines; those of another coefficient of restitution are others. */
  private of(state: State): Branches | null {
    return isDrawn(state) && this.found?.restitution === state.system.restitution ? this.found : null;
  }
}

function isDrawn({ diagram }: State): boolean {
  return diagram.branches && diagram.quantity !== "angular_speed";
}
