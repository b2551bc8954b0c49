/** The orbit diagram in words, for those who do not see it: what some of its orbits do for good, by the library's verdict. */

import type { Context, State } from "../../contract";
import { brief, grouped } from "../../drawing/numbers";
import type { VerdictJson } from "../../protocol";
import { RECORDED, TRANSIENT } from "./computation";
import type { Told } from "./computation";
import { endText, forcingText } from "./forcing_text";
import { DESCRIBED } from "./quantity";

const SAMPLES = 5;

export class Description {
  private key = "";
  private coming = Promise.resolve();
  private verdicts: readonly VerdictJson[] = [];

  constructor(private readonly context: Context) {}

  /** Asks for the verdicts on the samples of a state, unless they are there or on their way. */
  fetch(state: State): Promise<void> {
    const { impact_phase, normalised_speed } = state.start;
    const { restitution } = state.system;
    const key = JSON.stringify([state.diagram.axial_forcing, restitution, impact_phase, normalised_speed]);
    if (key === this.key) return this.coming;
    this.key = key;
    const start = { impact_phase, normalised_speed };
    const asked = samplesOf(state).map((axial_forcing, index) =>
      this.context.client.ask(`${SLOT}-${index}`, { call: "orbit", axial_forcing, restitution, start }),
    );
    this.coming = Promise.all(asked).then(
      (answers) => {
        if (this.key === key) this.verdicts = answers.map(({ json }) => json as VerdictJson);
      },
      (error: unknown) => {
        // What did not come is asked for when it is wanted again.
        if (this.key === key) this.key = "";
        throw error;
      },
    );
    return this.coming;
  }

  cancel(): void {
    for (let index = 0; index < SAMPLES; index += 1) this.context.client.cancel(`${SLOT}-${index}`);
  }

  words(state: State, count: number, told: Told): string {
    const { axial_forcing, quantity } = state.diagram;
    const [low, high] = axial_forcing;
    const does = this.verdicts.map(
      (verdict, index) => `${behaviour(verdict)} at ${forcingText(samplesOf(state)[index] ?? NaN, axial_forcing)}`,
    );
    return (
      `The ${DESCRIBED[quantity].name} of the orbits from the shared start, ${RECORDED} impacts of each after ` +
      `${leftOut(told)}, for Γ from ${endText(low, axial_forcing)} to ${endText(high, axial_forcing)} at a coefficient ` +
      `of restitution of ${brief(state.system.restitution)}. What the vertical motion does for good: ` +
      `${does.join(", ")}.${unsettled(count, told, quantity !== "angular_speed" && state.diagram.branches)}`
    );
  }
}

const SLOT = "diagram-words";

function samplesOf({ diagram }: State): number[] {
  const [low, high] = diagram.axial_forcing;
  return Array.from({ length: SAMPLES }, (_, sample) => low + ((high - low) * (sample + 0.5)) / SAMPLES);
}

function leftOut({ leftOut }: Told): string {
  return leftOut > TRANSIENT
    ? `${TRANSIENT} (where that is not enough, up to ${grouped(String(leftOut))})`
    : String(TRANSIENT);
}

function unsettled(count: number, { unsettled: number, leftOut }: Told, lines: boolean): string {
  if (number === 0) return "";
  const some = `${number} of the ${count} orbits ${number === 1 ? "has" : "have"} not`;
  const of = number === count ? "None of the orbits has" : some;
  const end = lines ? "; the lines are where they end." : ".";
  return ` ${of} settled after ${grouped(String(leftOut))} impacts: their dots are still on their way${end}`;
}

function behaviour({ kind, impacts }: VerdictJson): string {
  const round = `${impacts ?? 0} impact${impacts === 1 ? "" : "s"}`;
  if (kind === "periodic") return `period ${impacts ?? 0}`;
  if (kind === "chaotic") return "chaos";
  if (kind === "chattering") return `a rest every ${round}`;
  return kind === "at-rest" ? "rest for ever" : "undecided";
}
