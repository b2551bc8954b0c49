/** What the orbit under the cursor does for good, and the whole diagram in words, by the library's verdicts. */

import type { Context, State } from "../../contract";
import { debounced, element, Facts, section, setText } from "../../elements";
import { brief, grouped, plain, withError } from "../../numbers";
import type { DiagramJson, VerdictJson } from "../../protocol";
import { contactPeriods } from "../../state";
import { impactOf, mapOf, tellFailure, verdictOf } from "../asking";
import { areDrawn, endText, forcingText, isPlain } from "./branches";
import { DESCRIBED, RECORDED, TRANSIENT } from "./columns";

const NAMES = ["Γ", "Orbit", "Period", "Multipliers", "Exponent per impact"] as const;
const HINT = "Point at the diagram: the orbit of that forcing from the shared start.";
const CAUTION =
  "Rounding-dependent: after a rest the orbit is in the same state again, and the cycle shown was chosen by rounding.";

export class Verdict {
  readonly root: HTMLElement;
  private readonly facts = new Facts(NAMES, "Orbit under the cursor");
  private readonly sentence = element("p", {}, HINT);
  private readonly caution = element("p", { class: "caution", hidden: true }, CAUTION);
  private readonly ask = debounced(90, (forcing: number, state: State) => void this.fetch(forcing, state));

  constructor(private readonly context: Context) {
    const title = element("h3", {}, "Orbit under the cursor");
    const parts = [title, this.facts.root, this.sentence, this.caution];
    this.root = section("Orbit under the cursor", "panel", ...parts);
  }

  point(forcing: number, state: State): void {
    this.facts.set("Γ", plain(forcing, 6));
    this.ask(forcing, state);
  }

  stop(): void {
    this.ask.stop();
    this.context.client.cancel("diagram-orbit");
  }

  private async fetch(forcing: number, state: State): Promise<void> {
    const map = { ...mapOf(state), axial_forcing: forcing };
    try {
      this.tell(forcing, await verdictOf(this.context, "diagram-orbit", map, impactOf(state)));
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private tell(forcing: number, verdict: VerdictJson): void {
    const { impacts, platform_periods: periods } = verdict;
    const kind = verdict.kind.replace("-", " ");
    const round = impacts === null ? "–" : `${count(impacts, "impact")} in ${count(periods ?? 0, "period")}`;
    this.facts.set("Orbit", kind);
    this.facts.set("Period", round);
    this.facts.set("Multipliers", verdict.multipliers?.map(complex).join(", ") ?? "–");
    this.facts.set("Exponent per impact", withError(verdict.exponent, verdict.exponent_error));
    // The library writes for terminals, too.
    setText(this.sentence, verdict.text.replaceAll("+-", "±"));
    this.caution.hidden = !verdict.rounding_dependent;
    const words = verdict.rounding_dependent ? ", rounding-dependent" : "";
    this.context.announce(`Γ ${plain(forcing, 4)}: ${kind}, ${round}${words}`);
  }
}

function count(number: number, word: string): string {
  return `${number} ${word}${number === 1 ? "" : "s"}`;
}

function complex([real, imaginary]: readonly [number, number]): string {
  if (imaginary === 0) return plain(real, 3);
  return `${plain(real, 3)} ${imaginary < 0 ? "\u2212" : "+"} ${plain(Math.abs(imaginary), 3)}i`;
}

const SAMPLES = 5;
const slotOf = (sample: number): string => `diagram-words-${sample}`;

/** What some orbits of a diagram do for good: for those who do not see it. */
export function verdictsOf(context: Context, state: State): Promise<VerdictJson[]> {
  if (!isPlain(state)) return Promise.resolve([]);
  const asked = samplesOf(state).map((axial_forcing, sample) =>
    verdictOf(context, slotOf(sample), { ...mapOf(state), axial_forcing }, impactOf(state)),
  );
  return Promise.all(asked);
}

export function cancelVerdicts({ client }: Context): void {
  for (let sample = 0; sample < SAMPLES; sample += 1) client.cancel(slotOf(sample));
}

export function describeDiagram(
  state: State,
  verdicts: readonly VerdictJson[],
  count: number,
  told: DiagramJson,
): string {
  const { axial_forcing, quantity, drive } = state.diagram;
  const [low, high] = axial_forcing;
  const samples = samplesOf(state);
  const does = verdicts.map(
    (verdict, index) => `${behaviour(verdict)} at ${forcingText(samples[index] ?? NaN, axial_forcing)}`,
  );
  const forGood = `What the vertical motion does for good: ${does.join(", ")}`;
  const contact = state.system.contact_time === 0 ? "" : `; a contact lasts ${brief(contactPeriods(state.system), 3)} periods, ` +
    "and a dot is a release, as the impact of which it is the rigid rebound";
  const end = isPlain(state) ? forGood : `The platform moves as ${drive}${contact}`;
  return (
    `The ${DESCRIBED[quantity].name} of the orbits from the shared start, ${RECORDED} impacts of each after ` +
    `${leftOut(told)}, for Γ from ${endText(low, axial_forcing)} to ${endText(high, axial_forcing)} at a coefficient ` +
    `of restitution of ${brief(state.system.restitution)}. ${end}.${unsettled(count, told, areDrawn(state))}`
  );
}

function samplesOf({ diagram }: State): number[] {
  const [low, high] = diagram.axial_forcing;
  return Array.from({ length: SAMPLES }, (_, sample) => low + ((high - low) * (sample + 0.5)) / SAMPLES);
}

function leftOut({ left_out }: DiagramJson): string {
  const more = left_out > TRANSIENT ? ` (where that is not enough, up to ${grouped(String(left_out))})` : "";
  return `${TRANSIENT}${more}`;
}

function unsettled(count: number, { unsettled: number, left_out }: DiagramJson, lines: boolean): string {
  if (number === 0) return "";
  const some = `${number} of the ${count} orbits ${number === 1 ? "has" : "have"} not`;
  const of = number === count ? "None of the orbits has" : some;
  const end = lines ? "; the lines are where they end." : ".";
  return ` ${of} settled after ${grouped(String(left_out))} impacts: their dots are still on their way${end}`;
}

function behaviour({ kind, impacts }: VerdictJson): string {
  if (kind === "periodic") return `period ${impacts ?? 0}`;
  if (kind === "chaotic") return "chaos";
  if (kind === "chattering") return `a rest every ${count(impacts ?? 0, "impact")}`;
  return kind === "at-rest" ? "rest for ever" : "undecided";
}
