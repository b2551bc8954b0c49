/** Orbits asked for their verdict, what views do with answers that do not come, and cycles that rounding chose. */

import { Cancelled, messageOf, type Context, type State } from "../contract";
import { element } from "../elements";
import type { ImpactStart, MotionStart, VerdictJson } from "../protocol";
import { axialForcing, contactPeriods } from "../state";
import { say, WORDS } from "../words";

/** The map of the vertical motion of the shared system. */
export const mapOf = ({ system }: State) => ({
  axial_forcing: axialForcing(system),
  restitution: system.restitution,
  contact_periods: contactPeriods(system),
});

export type MapParameters = ReturnType<typeof mapOf>;

/** The impact with which the orbits of a state begin. */
export const impactOf = ({ start: { impact_phase, normalised_speed } }: State): ImpactStart => ({
  impact_phase,
  normalised_speed,
});

/** How the motion of a state begins. */
export const motionStartOf = ({ start, thrown }: State): MotionStart =>
  thrown === null ? { kind: "impact", ...start } : { kind: "flight", ...thrown };

export async function verdictOf(
  context: Context,
  slot: string,
  map: MapParameters,
  start: ImpactStart,
): Promise<VerdictJson> {
  return (await context.client.ask<VerdictJson>(slot, { call: "orbit", ...map, start })).json;
}

/** Says what went wrong; a request that another one replaced went not wrong. */
export function tellFailure(context: Context, error: unknown): void {
  if (!(error instanceof Cancelled)) context.status(messageOf(error), "error");
}

/** A disk at rest on the platform at its lowest point: the cycle after a rest does not depend on what was before. */
const REST = { impact_phase: 1.5 * Math.PI, normalised_speed: 0 };

/** An answer that is asked for once, and again only where something else is wanted or it did not come. */
export class Asked<Value> {
  private key = "";
  private coming: Promise<Value> | null = null;

  forget(): void {
    this.coming = null;
  }

  get(wanted: unknown, ask: () => Promise<Value>): Promise<Value> {
    const key = JSON.stringify(wanted);
    if (this.coming !== null && key === this.key) return this.coming;
    this.key = key;
    const coming = ask();
    this.coming = coming;
    coming.catch(() => {
      if (this.coming === coming) this.coming = null;
    });
    return coming;
  }
}

/** Says so where rounding, and not the model, decides what a disk does after a rest. */
export class RoundingCaution {
  readonly root: HTMLElement;
  private readonly verdict = new Asked<void>();

  constructor(
    private readonly slot: string,
    text: string,
  ) {
    this.root = element("p", { class: "caution", hidden: true }, say(WORDS.asking.rounding, { what: text }));
  }

  /** A map of which no verdict comes has no caution, and its own view says why; nor have contacts that take time. */
  show(context: Context, state: State): void {
    const map = mapOf(state);
    const ask = async () => {
      this.root.hidden = true;
      if (map.contact_periods > 0) return;
      this.root.hidden = !(await verdictOf(context, this.slot, map, REST)).rounding_dependent;
    };
    this.verdict.get(map, ask).catch(() => {});
  }
}

/** Says so where a motion from rest and the shared start end on two attractors: views that begin so then differ. */
export class Attractors {
  readonly root = element("p", { class: "caution", hidden: true });
  private readonly verdicts = new Asked<void>();

  constructor(private readonly slot: string) {}

  show(context: Context, state: State): void {
    const map = mapOf(state);
    const start = impactOf(state);
    const ask = async () => {
      this.root.hidden = true;
      if (map.contact_periods > 0) return;
      const own = await verdictOf(context, `${this.slot}-start`, map, start);
      const rest = await verdictOf(context, `${this.slot}-rest`, map, REST);
      this.root.hidden = own.kind === rest.kind && own.impacts === rest.impacts;
      const [first = "", other = ""] = [rest, own].map(({ text }) => text.replace(/, multipliers.*|\.$/s, ""));
      this.root.textContent = say(WORDS.asking.two_attractors, { rest: first, start: other });
    };
    this.verdicts.get([map, start], ask).catch(() => {});
  }
}
