/** What views that compute have in common: when they ask, answers that do not come, and verdicts. */

import { Cancelled, messageOf, type Context, type Offer, type State, type View } from "../contract";
import { debounced, element } from "../elements";
import { REST } from "../presets";
import type { ImpactStart, MotionStart, SystemParameters, VerdictJson } from "../protocol";
import { say, told, WORDS } from "../words";

/** What the vertical motion of a system depends on. */
export const mapKey = ({ system }: State): string =>
  JSON.stringify([MAP_NAMES.map((name) => system[name]), system.set]);
const MAP_NAMES = ["amplitude", "angular_frequency", "preload_acceleration", "restitution", "contact_time"] as const;

/** The map of a system, or that of two numbers; the library refuses one with contacts that take time. */
export type MapParameters = Readonly<SystemParameters> | Readonly<Record<"axial_forcing" | "restitution", number>>;

/** The impact with which the orbits of a state begin. */
export const impactOf = ({ start: { impact_phase, normalised_speed } }: Pick<State, "start">): ImpactStart => ({
  impact_phase,
  normalised_speed,
});

/** How the motion of a state begins. */
export const motionStartOf = ({ start, thrown }: State): MotionStart =>
  thrown === null ? { kind: "impact", ...start } : { kind: "flight", ...thrown };

export async function verdictOf({ client }: Context, slot: string, map: MapParameters, start: ImpactStart) {
  return (await client.ask<VerdictJson>(slot, { call: "orbit", map, start })).json;
}

/** Says what went wrong; a request that another one replaced went not wrong. */
export function tellFailure(context: Context, error: unknown): void {
  if (!(error instanceof Cancelled)) context.status(messageOf(error), "error");
}

/** How long (ms) views wait before they begin, so that a slider does not ask for all that it passes. */
const PAUSE = 60;

/** A view that computes something a little after the last change of the state, and ends with it when it is hidden. */
export abstract class ComputingView implements View {
  protected readonly compute: ReturnType<typeof debounced<[]>>;

  constructor(
    protected readonly context: Context,
    private readonly slots: readonly string[],
  ) {
    this.compute = debounced(PAUSE, () => this.attempt(() => this.fetch()));
  }

  abstract show(state: State, fresh: boolean): void;
  abstract offers(): Offer[];
  protected abstract readonly draw: () => void;
  /** Asks for what is not there or on its way. */
  protected abstract fetch(): Promise<void>;

  hide(): void {
    this.compute.stop();
    for (const slot of this.slots) this.context.client.cancel(slot);
  }

  redraw(): void {
    this.draw();
    this.compute();
  }

  /** Says what goes wrong. */
  protected attempt(act: () => Promise<void>): void {
    act().catch((error: unknown) => tellFailure(this.context, error));
  }
}

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

/**
 * A caution that depends on the map alone, or on the impact too. A map of which no verdict comes has none, and its own
 * view says why; nor have contacts that take time.
 */
export class Caution {
  readonly root = element("p", { class: "caution", hidden: true });
  private readonly asked = new Asked<void>();

  /** Gives the text for a state; null where there is nothing to say. */
  constructor(private readonly textOf: (context: Context, state: State) => Promise<string | null>) {}

  show(context: Context, state: State): void {
    const ask = async () => {
      this.root.hidden = true;
      const text = state.system.contact_time > 0 ? null : await this.textOf(context, state);
      this.root.hidden = text === null;
      this.root.textContent = text;
    };
    this.asked.get([mapKey(state), impactOf(state)], ask).catch(() => {});
  }
}

/** Says so where rounding, and not the model, decides what a disk does after a rest. */
export const roundingCaution = (slot: string, what: string): Caution =>
  new Caution(async (context, state) => {
    const { rounding_dependent } = await verdictOf(context, slot, state.system, impactOf({ start: REST }));
    return rounding_dependent ? say(WORDS.asking.rounding, { what }) : null;
  });

/** Says so where a motion from rest and the shared start end on two attractors: views that begin so then differ. */
export const attractorsCaution = (): Caution =>
  new Caution(async (context, state) => {
    const own = await verdictOf(context, "attractors-start", state.system, impactOf(state));
    const rest = await verdictOf(context, "attractors-rest", state.system, impactOf({ start: REST }));
    const decided = own.kind !== "undecided" && rest.kind !== "undecided";
    if (!decided || (own.kind === rest.kind && own.impacts === rest.impacts)) return null;
    const [first = "", other = ""] = [rest, own].map(({ text }) => told(text).replace(/, multipliers.*|\.$/s, ""));
    return say(WORDS.asking.two_attractors, { rest: first, start: other });
  });
