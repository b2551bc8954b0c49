/** What the orbit under the cursor does for good, in words and numbers. */

import type { Context, State } from "../../contract";
import { debounced, element, Facts, setText } from "../../drawing/elements";
import { plain, withError } from "../../drawing/numbers";
import type { VerdictJson } from "../../protocol";
import { tellFailure } from "../failures";

const NAMES = ["Γ", "Orbit", "Period", "Multipliers", "Exponent per impact"] as const;

export class Verdict {
  readonly root = element("section", { class: "panel", "aria-label": "Orbit under the cursor" });
  private readonly facts = new Facts(NAMES, "Orbit under the cursor");
  private readonly sentence = element(
    "p",
    {},
    "Point at the diagram: the orbit of that forcing from the shared start.",
  );
  private readonly caution = element("p", { class: "caution", hidden: true });
  private asked = NaN;
  private readonly ask = debounced(90, (forcing: number, state: State) => void this.fetch(forcing, state));

  constructor(private readonly context: Context) {
    this.root.append(element("h3", {}, "Orbit under the cursor"), this.facts.root, this.sentence, this.caution);
  }

  point(forcing: number, state: State): void {
    this.asked = forcing;
    this.facts.set("Γ", plain(forcing, 6));
    this.ask(forcing, state);
  }

  stop(): void {
    this.ask.stop();
    this.context.client.cancel("diagram-orbit");
  }

  private async fetch(forcing: number, { system, start }: State): Promise<void> {
    const { impact_phase, normalised_speed } = start;
    try {
      const { json } = await this.context.client.ask("diagram-orbit", {
        call: "orbit",
        axial_forcing: forcing,
        restitution: system.restitution,
        start: { impact_phase, normalised_speed },
      });
      if (this.asked === forcing) this.tell(forcing, json as VerdictJson);
    } catch (error) {
      tellFailure(this.context, error);
    }
  }

  private tell(forcing: number, verdict: VerdictJson): void {
    const { impacts, platform_periods: periods } = verdict;
    const round = impacts === null ? "–" : `${count(impacts, "impact")} in ${count(periods ?? 0, "period")}`;
    this.facts.set("Orbit", verdict.kind.replace("-", " "));
    this.facts.set("Period", round);
    this.facts.set("Multipliers", verdict.multipliers?.map(complex).join(", ") ?? "–");
    this.facts.set("Exponent per impact", withError(verdict.exponent, verdict.exponent_error));
    // The library writes for terminals, too.
    setText(this.sentence, verdict.text.replaceAll("+-", "±"));
    this.caution.hidden = !verdict.rounding_dependent;
    setText(
      this.caution,
      verdict.rounding_dependent
        ? "Rounding-dependent: after a rest the orbit is in the same state again, and the cycle shown was chosen by " +
            "rounding."
        : "",
    );
    const words = verdict.rounding_dependent ? ", rounding-dependent" : "";
    this.context.announce(`Γ ${plain(forcing, 4)}: ${verdict.kind.replace("-", " ")}, ${round}${words}`);
  }
}

function count(number: number, word: string): string {
  return `${number} ${word}${number === 1 ? "" : "s"}`;
}

function complex([real, imaginary]: readonly [number, number]): string {
  if (imaginary === 0) return plain(real, 3);
  return `${plain(real, 3)} ${imaginary < 0 ? "\u2212" : "+"} ${plain(Math.abs(imaginary), 3)}i`;
}
