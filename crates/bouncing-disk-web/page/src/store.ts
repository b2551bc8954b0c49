/** The present state, and the way in which it changes: nothing that the library refuses ever becomes the state. */

import { Cancelled, messageOf, Refused, type Change, type Client, type State } from "./contract";
import type { MotionStart, Refusal, Summary } from "./protocol";
import { changed, DEFAULT_STATE } from "./state";
import { say, WORDS } from "./words";

export interface ChangeOptions {
  settled?: boolean;
  /** Called with what is wrong, where the library refuses this change. Without it the sentence goes to `refused`. */
  refused?: (refusal: Refusal) => void;
  /** Called when the change has become the state. */
  taken?: () => void;
}

interface Listener {
  /** Another state; `cause` says whether the address follows it or it follows the address. */
  changed(state: State, cause: { settled: boolean; fromAddress: boolean }): void;
  refused(message: string): void;
}

type Waiting = Readonly<{ change: Change; options: ChangeOptions }>;

/** The kind of a refusal that is none: there was no answer. */
const BROKEN = "broken";

/** An address is mended part by part so many times at most. */
const MOST_MENDINGS = 12;

export class Store {
  private present: State = DEFAULT_STATE;
  private queue: Waiting[] = [];
  private pumping = false;
  /** A state of an address is being checked; what is asked for meanwhile changes that one, and waits for it. */
  private opening = false;
  /** How many addresses there have been: what was asked for before the last one is of no interest any more. */
  private addresses = 0;

  constructor(
    private readonly client: Client,
    private readonly listener: Listener,
  ) {}

  state(): State {
    return this.present;
  }

  /** True while a change waits for the library's word. */
  private busy(): boolean {
    return this.pumping || this.opening;
  }

  change(change: Change, options: ChangeOptions = {}): void {
    const waiting = { change, options };
    if (!this.busy() && !needsCheck(change)) return this.commit(changed(this.present, change), [waiting]);
    this.queue.push(waiting);
    void this.pump();
  }

  /** The first state of the page, or one of its address: what is refused has its default, with a sentence for each. */
  async open(state: State): Promise<void> {
    const address = ++this.addresses;
    this.opening = true;
    this.queue = [];
    let candidate = state;
    for (let tries = 0; tries < MOST_MENDINGS; tries++) {
      const { thrown, mass } = candidate;
      const checked = await this.checked(candidate, { system: {}, start: {}, thrown, mass });
      if (address !== this.addresses) return;
      const { refusal } = checked;
      candidate = checked.state;
      if (refusal === undefined) break;
      const broken = refusal.kind === BROKEN;
      this.listener.refused(broken ? refusal.message : say(WORDS.address.impossible, { message: refusal.message }));
      if (broken) break;
      candidate = changed(candidate, { thrown, ...mended(refusal, tries) });
    }
    this.opening = false;
    this.commit(candidate, [], true);
    void this.pump();
  }

  private async pump(): Promise<void> {
    if (this.busy()) return;
    this.pumping = true;
    try {
      while (this.queue.length > 0 && !this.opening) await this.take(this.queue.splice(0));
    } finally {
      this.pumping = false;
    }
  }

  /** What waited is checked as one change; only where that is refused, one by one. */
  private async take(batch: readonly Waiting[], address = this.addresses): Promise<void> {
    const wanted = batch.reduce((before, { change }) => changed(before, change), this.present);
    const change: Change = Object.assign({}, ...batch.map((waiting) => waiting.change));
    const { state, refusal } = await this.checked(wanted, change);
    if (address !== this.addresses) return;
    const [first] = batch as [Waiting];
    if (refusal === undefined) this.commit(state, batch);
    else if (batch.length > 1) {
      for (const waiting of batch) if (address === this.addresses) await this.take([waiting], address);
    } else if (first.options.refused) first.options.refused(refusal);
    else this.listener.refused(refusal.message);
  }

  private commit(state: State, batch: readonly Waiting[], fromAddress = false): void {
    this.present = state;
    const settled = fromAddress || batch.some((waiting) => waiting.options.settled !== false);
    this.listener.changed(state, { settled, fromAddress });
    for (const waiting of batch) waiting.options.taken?.();
  }

  /** A state as the library has it, of which this change is new; and what it says against it, if anything. */
  private async checked(wanted: State, change: Change): Promise<{ state: State; refusal?: Refusal }> {
    const { client } = this;
    let state = wanted;
    const motion = (slot: string, start: MotionStart) =>
      client.ask(slot, { call: "motion", system: state.system, start, periods: 1, samples_per_period: 2 });
    try {
      if (change.system || change.mass !== undefined) state = await resolved(client, "check", wanted);
      const { system, mass, start, thrown, motor } = state;
      if (change.start)
        await only(motion("check start", { kind: "impact", ...start }), (refusal) => ofStart(refusal, change));
      if (change.thrown && thrown !== null) {
        const asked = motion("check throw", { kind: "flight", ...thrown });
        await only(asked, (refusal) => ({ ...refusal, quantity: "thrown" }));
      }
      const { stator } = motor;
      if (stator !== null) {
        const asked = client.ask("check stator", { call: "sheet_of_system", system, mass, stator });
        await only(asked, (refusal) => {
          return { ...refusal, quantity: "stator", message: say(WORDS.form.stator, { message: refusal.message }) };
        });
      }
      return { state };
    } catch (error) {
      if (error instanceof Refused) return { state: wanted, refusal: error.refusal };
      if (error instanceof Cancelled) return { state };
      // The module broke down: what it has not said to be legal does not become the state.
      return { state, refusal: { kind: BROKEN, quantity: null, range: null, message: messageOf(error) } };
    }
  }
}

/** The state with all that its system sets, and with what follows from that. */
export async function resolved(client: Client, slot: string, state: State): Promise<State & { summary: Summary }> {
  const { json: summary } = await client.ask<Summary>(slot, { call: "check", system: state.system, mass: state.mass });
  return { ...state, system: summary.system, summary };
}

/** Waits for an answer. A refusal counts as `of` sees it; others are the business of the view that meets them. */
async function only(answer: Promise<unknown>, of: (refusal: Refusal) => Refusal | null): Promise<void> {
  try {
    await answer;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    const own = of(error.refusal);
    if (own !== null) throw new Refused(own);
  }
}

/** What the library calls the parts of a start where a motion begins with it; `check` knows nothing of them. */
const START_NAMES: Readonly<Record<string, string>> = {
  phase: "impact_phase",
  axial_impact_velocity: "normalised_speed",
  tangential_impact_velocity: "angular_speed",
};
/** The speed of an impact is its velocity (disk minus platform) without the sign. */
const SPEEDS = "[0, inf)";

/** A refusal of the start in the words of the form; an impact so hard that its flight is too long is one, too. */
function ofStart(refusal: Refusal, change: Change): Refusal | null {
  const name = START_NAMES[refusal.quantity ?? ""] ?? refusal.quantity ?? "";
  if (refusal.kind === "computation" && change.start?.normalised_speed !== undefined) return refusal;
  if (!Object.hasOwn(DEFAULT_STATE.start, name)) return null;
  return { ...refusal, quantity: name, range: name === "normalised_speed" ? SPEEDS : refusal.range };
}

const needsCheck = (change: Change): boolean =>
  change.system !== undefined || change.start !== undefined || change.mass !== undefined ||
  Boolean(change.thrown) || Boolean(change.motor?.stator); // prettier-ignore

/** The change that takes a refused quantity back to its default; after some tries, all that can be refused. */
function mended(refusal: Refusal, tries: number): Change {
  const { system, mass, start } = DEFAULT_STATE;
  const name = (refusal.quantity ?? "")
    .replace(/^contact([ .]time|_periods)$/, "contact_time")
    .replace(/^restitution .*/, "restitution")
    .replace("axial_forcing", "amplitude");
  if (tries < MOST_MENDINGS / 2) {
    if (Object.hasOwn(system, name)) return { system: { [name]: system[name as keyof typeof system] } };
    if (Object.hasOwn(start, name)) return { start: { [name]: start[name as keyof typeof start] } };
    if (name === "thrown") return { thrown: null };
    if (name === "mass") return { mass };
    if (name === "stator") return { motor: { stator: null } };
  }
  return { system, mass, start, thrown: null, motor: { stator: null } };
}
