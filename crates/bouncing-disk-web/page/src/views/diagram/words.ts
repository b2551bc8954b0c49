/** What the orbit under the cursor does for good, and the whole diagram in words, by the library's verdicts. */

import type { Context, State } from "../../contract";
import { debounced, element, Facts, section, setText } from "../../elements";
import { brief, grouped, minus, plain, withError } from "../../numbers";
import type { DiagramJson, Range, VerdictJson } from "../../protocol";
import { counted, roundOf, say, told, WORDS } from "../../words";
import { impactOf, tellFailure, verdictOf } from "../asking";
import { areDrawn, isPlain, type Branches } from "./branches";
import { RECORDED, TRANSIENT } from "./columns";

const TEXTS = WORDS.diagram;
const CAUTION = say(WORDS.asking.rounding, { what: WORDS.asking.rounding_orbit });

export class Verdict {
  readonly root: HTMLElement;
  private readonly facts = new Facts(TEXTS.facts, TEXTS.orbit);
  private readonly sentence = element("p", {}, TEXTS.hint);
  private readonly caution = element("p", { class: "caution", hidden: true }, CAUTION);
  /** What is read: its forcing, and what else it depends on. */
  private forcing = NaN;
  private own = "";
  private readonly ask = debounced(90, (forcing: number, state: State) => void this.fetch(forcing, state));

  constructor(private readonly context: Context) {
    const spoken = element("div", { "aria-live": "polite" }, this.sentence, this.caution);
    this.root = section(TEXTS.orbit, "panel", element("h3", {}, TEXTS.orbit), this.facts.root, spoken);
  }

  /** A reading of another system or lesson, or of a forcing that is not seen any more, does not stay. */
  follow(state: State, fresh: boolean): void {
    const { system, diagram } = state;
    const own = JSON.stringify([system.restitution, system.contact_time, impactOf(state), diagram.drive]);
    const [low, high] = diagram.axial_forcing;
    if (!fresh && own === this.own && !(this.forcing < low || this.forcing > high)) return;
    Object.assign(this, { own, forcing: NaN });
    this.stop();
    this.facts.clear("–");
    setText(this.sentence, TEXTS.hint);
    this.caution.hidden = true;
  }

  point(forcing: number, state: State): void {
    this.forcing = forcing;
    this.facts.set({ forcing: plain(forcing, 6) });
    this.ask(forcing, state);
  }

  stop(): void {
    this.ask.stop();
    this.context.client.cancel("diagram-orbit");
  }

  private async fetch(forcing: number, state: State): Promise<void> {
    try {
      this.tell(forcing, await verdictOf(this.context, "diagram-orbit", mapAt(forcing, state), impactOf(state)));
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private tell(forcing: number, verdict: VerdictJson): void {
    const { impacts, platform_periods } = verdict;
    const orbit = TEXTS.kinds[verdict.kind];
    const period = impacts === null ? "–" : roundOf(impacts, platform_periods ?? 0);
    const multipliers = verdict.multipliers?.map(complex).join(", ") ?? "–";
    const exponent = withError(verdict.exponent, verdict.exponent_error);
    this.facts.set({ orbit, period, multipliers, exponent });
    setText(this.sentence, `Γ ${plain(forcing, 4)}: ${told(verdict.text)}`);
    this.caution.hidden = !verdict.rounding_dependent;
  }
}

function complex([real, imaginary]: readonly [number, number]): string {
  if (imaginary === 0) return plain(real, 3);
  return `${plain(real, 3)} ${imaginary < 0 ? "\u2212" : "+"} ${plain(Math.abs(imaginary), 3)}i`;
}

const mapAt = (axial_forcing: number, { system: { restitution } }: State) => ({ axial_forcing, restitution });

const SAMPLES = 5;
export const SAMPLE_SLOTS = Array.from({ length: SAMPLES }, (_, sample) => `diagram-words-${sample}`);

/** What some orbits of a diagram do for good: for those who do not see it. */
export function verdictsOf(context: Context, state: State): Promise<VerdictJson[]> {
  if (!isPlain(state)) return Promise.resolve([]);
  const asked = samplesOf(state).map((axial_forcing, sample) =>
    verdictOf(context, SAMPLE_SLOTS[sample] ?? "", mapAt(axial_forcing, state), impactOf(state)),
  );
  return Promise.all(asked);
}

export function describeDiagram(state: State, verdicts: VerdictJson[], count: number, told: DiagramJson): string {
  const { axial_forcing, quantity, drive } = state.diagram;
  const [low = "", high = ""] = axial_forcing.map((end) => endText(end, axial_forcing));
  const { contact_time } = state.system;
  const restitution = brief(state.system.restitution);
  const transient = leftOut(told);
  const forcings = samplesOf(state).map((forcing) => forcingText(forcing, axial_forcing));
  const orbits = verdicts.map((verdict, index) =>
    say(TEXTS.at, { orbit: behaviour(verdict), forcing: forcings[index] ?? "" }),
  );
  const driven = [
    say(TEXTS.driven, { drive: TEXTS.drives[drive] }),
    ...(contact_time === 0 ? [] : [say(TEXTS.contact, { periods: brief(state.summary?.contact_periods ?? NaN, 3) })]),
  ];
  return [
    say(TEXTS.seen, { quantity: TEXTS.quantities[quantity], low, high, restitution, recorded: RECORDED, transient }),
    ...(isPlain(state) ? [say(TEXTS.long_run, { orbits: orbits.join(", ") })] : driven),
    ...(quantity === "angular_speed" ? [noteOf(state)] : []),
    ...(told.resting > 0 ? [say(TEXTS.resting, { count: told.resting })] : []),
    ...unsettled(count, told, areDrawn(state)),
  ].join(" ");
}

/** What there is to say of a diagram of angular speeds. */
function noteOf(state: State): string {
  if (!isPlain(state)) return TEXTS.sine_only;
  if (state.system.friction === 0) return TEXTS.no_friction;
  return state.system.twist_amplitude === 0 ? TEXTS.no_twist : TEXTS.no_branches;
}

function samplesOf({ diagram }: State): number[] {
  const [low, high] = diagram.axial_forcing;
  return Array.from({ length: SAMPLES }, (_, sample) => low + ((high - low) * (sample + 0.5)) / SAMPLES);
}

function leftOut({ left_out }: DiagramJson): string {
  if (left_out <= TRANSIENT) return String(TRANSIENT);
  return say(TEXTS.transient_up_to, { transient: TRANSIENT, most: grouped(String(left_out)) });
}

function unsettled(orbits: number, { unsettled: count, left_out }: DiagramJson, lines: boolean): string[] {
  if (count === 0) return [];
  const { one, many } = TEXTS.unsettled;
  const text = count === orbits ? TEXTS.none_settled : count === 1 ? one : many;
  return [say(text, { count, orbits, impacts: grouped(String(left_out)) }), ...(lines ? [TEXTS.lines] : [])];
}

export const behaviour = ({ kind, impacts }: VerdictJson): string =>
  say(TEXTS.does[kind], { number: impacts ?? 0, impacts: counted(TEXTS.impacts, impacts ?? 0) });

/** "doubling at 0.4860, fold at 0.3333", for the text beside the picture; the first few. */
export function describeBifurcations({ json }: Branches, window: Range): string {
  const kinds: Readonly<Record<string, string>> = TEXTS.bifurcation_kinds;
  const seen = json.bifurcations.filter(({ axial_forcing: at }) => at >= window[0] && at <= window[1]);
  const words = seen.map(({ kind, axial_forcing }) =>
    say(TEXTS.bifurcation, { kind: kinds[kind] ?? kind, forcing: forcingText(axial_forcing, window) }),
  );
  const distinct = [...new Set(words)];
  if (json.branches === 0) return TEXTS.no_branch;
  if (distinct.length === 0) return TEXTS.no_bifurcation;
  const more = distinct.length > 6 ? [say(TEXTS.more, { count: distinct.length - 6 })] : [];
  return say(TEXTS.bifurcations, { list: [...distinct.slice(0, 6), ...more].join(", ") });
}

/** Four decimals, or three more than the width of the window has zeros. */
function forcingText(value: number, [low, high]: Range): string {
  const needed = 3 - Math.floor(Math.log10(high - low) + 1);
  return minus(value.toFixed(Math.min(Math.max(4, needed), 17)));
}

/** The end of a window, without zeros that say nothing. */
const endText = (value: number, window: Range): string => forcingText(value, window).replace(/\.?0+$/, "");
