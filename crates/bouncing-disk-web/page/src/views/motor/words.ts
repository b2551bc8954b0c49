/** The motor in words: regime, warnings, traps, steady speed, run-up and curves. */

import { element, Facts, section, setText } from "../../elements";
import { grouped, plain, prefixOf, quantity, quantityWithError, toldApart, withError } from "../../numbers";
import type { IntervalJson, ReportJson, StallJson, TrapJson } from "../../protocol";
import { counted, say, WORDS } from "../../words";
import type { Operation, Transient } from "./requests";

const TEXTS = WORDS.motor;

export class ReportPanel {
  readonly root = section(TEXTS.report, "panel");
  private readonly facts = new Facts(TEXTS.facts, TEXTS.facts_label);
  /** Stands above the curves, which a trap makes those of another motion than one would expect. */
  readonly trap = element("p", { class: "caution trap", hidden: true });
  private readonly warnings = element("ul", { class: "warnings" });
  private readonly warned = element("summary", { class: "warned" });
  private readonly warningsBox = element("details", { hidden: true }, this.warned, this.warnings);
  private readonly text = element("pre", { class: "report", tabindex: 0, "aria-label": TEXTS.full_report });

  constructor() {
    const full = element("details", {}, element("summary", {}, TEXTS.full_report), this.text);
    this.root.append(element("h3", {}, TEXTS.report), this.facts.root, this.warningsBox, full);
  }

  /** Forgets a motor. */
  clear(): void {
    this.facts.clear("…");
    this.trap.hidden = true;
    this.warningsBox.hidden = true;
    setText(this.text, "");
  }

  report(report: ReportJson): void {
    const [[, contact_time], [, indentation]] = report.contact;
    const forcing = plain(report.axial_forcing, 5);
    const torque = quantity(report.largest_torque, "N m");
    this.facts.set({ regime: regimeOf(report), forcing, contact_time, indentation, torque });
    this.trap.hidden = report.trap === null;
    if (report.trap !== null) setText(this.trap, describeTrap(report.trap, report));
    this.warningsBox.hidden = report.warnings.length === 0;
    setText(this.warned, counted(TEXTS.warnings, report.warnings.length));
    this.warnings.replaceChildren(...report.warnings.map((warning) => element("li", {}, warning)));
    setText(this.text, report.text);
  }

  /** Of a motor that nothing turns. */
  still(): void {
    this.facts.set({ speed: "–", amplitude: "–", constant: "–", stall: "–" });
  }

  runUp(transient: Transient | null, own: Operation | null, problem = ""): void {
    this.facts.set({ constant: transient === null ? problem || "…" : timeConstant(transient.json, own) });
  }

  operation(own: Operation, report: ReportJson): void {
    const known = own.amplitude === null ? TEXTS.as_system : `${quantity(own.amplitude, "m")} ${under(own.load_torque)}`;
    this.facts.set({ speed: steadySpeed(own, report.largest_torque), amplitude: known });
  }

  stall(stall: StallJson | null, problem = ""): void {
    this.facts.set({ stall: stall === null ? problem || "–" : describeStall(stall) });
  }
}

/** The regime, and what it leaves out. */
function regimeOf({ system, yields, regime }: ReportJson): string {
  const limits = [yields && TEXTS.without_rotor, system.contact_time > 0 && TEXTS.of_rigid].filter((one) => one !== false);
  return limits.length === 0 ? regime : `${limits.join(", ")}: ${regime}`;
}

/** What turns nothing, or null for a motor that may turn. */
export function whyNothingTurns(report: ReportJson): string | null {
  if (report.angular_forcing === null || !(report.largest_torque > 0)) return TEXTS.no_friction;
  return report.angular_forcing === 0 ? TEXTS.no_twist : null;
}

const under = (load: number): string =>
  load === 0 ? TEXTS.no_load : say(TEXTS.own_load, { load: quantity(load, "N m") });

/** A sentence on a load that is too large for friction. */
const overpowered = (text: string, { load_torque }: Operation, largest: number): string =>
  say(text, { load: quantity(load_torque, "N m"), largest: quantity(largest, "N m") });

/** The steady speed under the load of the sheet, with no more digits than are known. */
export function steadySpeed(own: Operation, largestTorque: number): string {
  if (own.status === 2) return overpowered(TEXTS.speed_none, own, largestTorque);
  const load = under(own.load_torque);
  if (own.status === 0) return say(TEXTS.speed_known, { speed: withError(own.speed, own.speed_error), load });
  const why = own.shortfall === null ? "" : `; ${own.shortfall}`;
  return `${say(TEXTS.speed_unsettled, { speed: plain(own.speed, 3), load })}${why}`;
}

/** A time with its 95 % interval, with the digits that the interval leaves: "852 ms (95 % interval 824 to 889 ms)". */
function time({ value, low, high }: IntervalJson): string {
  const { factor, symbol } = prefixOf(value);
  const decimals = Math.min(20, Math.max(0, 1 - Math.floor(Math.log10((high - low || value) * factor))));
  const told = (one: number) => grouped((one * factor).toFixed(decimals));
  return say(TEXTS.interval, { value: told(value), low: told(low), high: told(high), unit: `${symbol}s` });
}

const REFUSALS: Readonly<Record<string, string>> = TEXTS.refusals;

/** Why a run-up has no time constant: what the library says of it has its numbers to the last digit. */
const whyNone = ({ refusal }: Transient["json"]): string =>
  REFUSALS[typeof refusal === "string" ? refusal : (Object.keys(refusal ?? {})[0] ?? "")] ?? TEXTS.unknown;

/** The time constant of a run-up that has one. */
export function timeConstant(json: Transient["json"], own: Operation | null): string {
  const { rise } = json;
  if (own?.status === 2) return TEXTS.constant_driven;
  if (rise === null) return say(TEXTS.constant_none, { why: whyNone(json) });
  if (rise.form === "ramp") return TEXTS.constant_ramp;
  return time(rise.constant);
}

/** What a run-up tends to, which its own end does not tell, and its form. */
export function describeRunUp({ json }: Transient, own: Operation | null, report: ReportJson): string {
  const largest = report.largest_torque;
  if (own?.status === 2) return overpowered(TEXTS.runs_away, own, largest);
  const steady = own === null ? TEXTS.steady_coming : say(TEXTS.steady, { speed: steadySpeed(own, largest) });
  const { rise } = json;
  if (rise === null) return `${steady} ${say(TEXTS.constant_undefined, { why: whyNone(json) })}`;
  const values = { constant: time(rise.constant), missed: plain(rise.residual, 2) };
  return `${steady} ${say(rise.form === "exponential" ? TEXTS.exponential : TEXTS.ramp, values)}`;
}

/** Where a motor is caught in a short cycle, or would be. */
export function describeTrap(trap: TrapJson, report: ReportJson): string {
  const [low, high] = trap.forcing_from_to;
  const [from, to] = toldApart(low, high, 3);
  const [preload] = toldApart(trap.preload_acceleration, report.system.preload_acceleration, 2);
  const away = plain(100 * Math.abs(trap.relative_distance), 2);
  return say(trap.relative_distance === 0 ? TEXTS.trap : TEXTS.trap_near, { preload, from, to, away });
}

/** Why a motor has no stall load, or the load. */
export function describeStall(stall: StallJson): string {
  if (stall.torque !== null) return quantityWithError(stall.torque, stall.torque_error, "N m");
  return say(TEXTS.no_stall, { speed: withError(stall.no_load_speed, stall.no_load_speed_error) });
}

/** A sentence for speed, power and efficiency each; none before there is a load. */
export function describeCurves(operations: readonly Operation[], stall: StallJson | null): string[] {
  const known = operations.filter(({ status }) => status !== 2);
  const [first, last] = [known[0], known.at(-1)];
  if (first === undefined || last === undefined)
    return operations.length === 0 ? [] : Array.from({ length: 3 }, () => TEXTS.all_driven);
  const at = ({ load_torque }: Operation) => quantityWithError(load_torque, null, "N m");
  const best = (of: "mechanical_power" | "efficiency") =>
    known.reduce((one, other) => (other[of] > one[of] || Number.isNaN(one[of]) ? other : one));
  // A drift is in no error: numbers of what is not settled stand without one.
  const speed = (row: Operation) =>
    row.status === 1
      ? say(TEXTS.speed_at_unsettled, { speed: plain(row.speed, 3), load: at(row) })
      : say(TEXTS.speed_at, { speed: withError(row.speed, row.speed_error), load: at(row) });
  const settled = ({ status }: Operation, known: string, rough: string) =>
    status === 1 ? say(TEXTS.so_far, { value: rough }) : known;
  const stop = stall === null || stall.torque === null ? "" : ` ${say(TEXTS.stalls, { load: describeStall(stall) })}`;
  const [powerful, efficient] = [best("mechanical_power"), best("efficiency")];
  const { mechanical_power, mechanical_power_error } = powerful;
  const watts = quantityWithError(mechanical_power, mechanical_power_error, "W");
  const share = efficient.efficiency;
  const percents = `${withError(share, efficient.efficiency_error, 100)} %`;
  const most = { load: at(powerful), power: settled(powerful, watts, quantity(mechanical_power, "W")) };
  const finest = { load: at(efficient), efficiency: settled(efficient, percents, `${plain(100 * share, 3)} %`) };
  return [
    `${say(TEXTS.from_to, { first: speed(first), last: speed(last) })}${stop}`,
    mechanical_power > 0 ? say(TEXTS.most_power, most) : TEXTS.no_power,
    share > 0 ? say(TEXTS.best_efficiency, finest) : TEXTS.no_efficiency,
  ];
}
