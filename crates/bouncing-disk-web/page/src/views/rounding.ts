/** Says so where rounding, and not the model, decides what a disk does after a rest. */

import { Cancelled } from "../contract";
import type { Context, State } from "../contract";
import { element } from "../drawing/elements";
import type { VerdictJson } from "../protocol";
import { axialForcing } from "./forcing";

/** A disk at rest on the platform at its lowest point: the cycle after a rest does not depend on what was before. */
const REST = { impact_phase: 1.5 * Math.PI, normalised_speed: 0 };

export class RoundingCaution {
  readonly root = element("p", { class: "caution", hidden: true });
  private asked = "";

  constructor(
    private readonly slot: string,
    text: string,
  ) {
    this.root.textContent = `Rounding-dependent: ${text}`;
  }

  /** Asks once for each map. A map of which no verdict comes has no caution, and its own view says why. */
  async show(context: Context, { system }: State): Promise<void> {
    const map = { axial_forcing: axialForcing(system), restitution: system.restitution };
    const key = JSON.stringify(map);
    if (key === this.asked) return;
    this.asked = key;
    this.root.hidden = true;
    try {
      const { json } = await context.client.ask(this.slot, { call: "orbit", ...map, start: REST });
      if (this.asked === key) this.root.hidden = !(json as VerdictJson).rounding_dependent;
    } catch (error) {
      if (error instanceof Cancelled && this.asked === key) this.asked = "";
    }
  }
}
