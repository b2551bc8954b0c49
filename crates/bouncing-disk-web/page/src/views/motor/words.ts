/** The motor in words: regime, warnings, traps, steady speed, run-up and curves. */

import { element, Facts, section, setText } from "../../elements";
import { grouped, plain, prefixOf, quantity, shown, withError } from "../../numbers";
import type { AxialMotionJson, IntervalJson, ReportJson, StallJson, TrapJson } from "../../protocol";
import { roundOf, say, WORDS } from "../../words";
import type { Known, Operation, Row, Transient } from "./requests";

const TEXTS = WORDS.motor;

export class ReportPanel {
  readonly root = section(TEXTS.report, "panel");
  private readonly facts = new Facts(TEXTS.facts, TEXTS.facts_label);
  /** Stands above the curves, which a trap makes those of another motion than one would expect. */
  readonly trap = element("p", { class: "caution trap", hidden: true });
  private readonly warnings = element("ul", { class: "warnings" });

  constructor() {
    this.root.append(element("h3", {}, TEXTS.report), this.facts.root, this.warnings);
  }

  /** All that is known of a motor; what is on its way has dots. */
  show({ report, transient, own, stall, problems }: Known): void {
    const later = report === null || whyNothingTurns(report) === null ? "…" : "–";
    if (report === null) this.facts.clear(later);
    else {
      const [[, contact_periods], [, indentation]] = report.contact;
      this.facts.set({
        ...{ regime: regimeOf(report), forcing: plain(report.axial_forcing, 5), contact_periods, indentation },
        torque: quantity(report.largest_torque, "N m"),
        speed: own === null ? later : steadySpeed(own, report.largest_torque),
        amplitude: own === null ? later : amplitudeOf(own),
        motion: own === null ? later : describeMotion(own.motion),
        others: own === null ? later : describeOthers(own, report.largest_torque),
        constant: transient === null ? (problems.runUp ?? later) : timeConstant(transient.json, own),
        stall: stall === null ? (problems.stall ?? later) : describeStall(stall),
      });
    }
    this.trap.hidden = !report?.trap;
    if (report?.trap) setText(this.trap, describeTrap(report.trap));
    this.warnings.replaceChildren(...(report?.warnings ?? []).map((warning) => element("li", {}, warning)));
  }
}

/** How the rotor moves up and down, and how long that lasts. */
export function describeMotion(motion: AxialMotionJson | null): string {
  if (motion === null) return TEXTS.motions.none;
  if (motion === "Contact") return TEXTS.motions.contact;
  if ("Periodic" in motion) {
    const { impacts, periods } = motion.Periodic;
    return say(TEXTS.motions.periodic, { round: roundOf(impacts, periods) });
  }
  const { life } = motion.Irregular;
  if ("Mean" in life) return say(TEXTS.motions.mean, { life: quantity(life.Mean, "s") });
  return say(TEXTS.motions.lasting, { time: quantity(life.NoneEndedIn, "s") });
}

/** The motions that coexist with the one reached from rest, numbered as in the chart. */
const describeOthers = ({ others }: Row, largest: number): string =>
  others
    .map((other, index) => {
      const values = { number: index + 2, speed: steadySpeed(other, largest), motion: describeMotion(other.motion) };
      return say(TEXTS.motions.other, values);
    })
    .join("; ") || TEXTS.motions.no_others;

const amplitudeOf = ({ amplitude, load_torque }: Operation): string =>
  amplitude === null ? TEXTS.as_system : `${quantity(amplitude, "m")} ${under(load_torque)}`;

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

/** The steady speed under the load of the sheet, with no more digits than are known. */
export function steadySpeed(own: Operation, largestTorque: number): string {
  const [driving, largest] = [own.load_torque, largestTorque].map((torque) => quantity(torque, "N m"));
  if (own.status === 2) return say(TEXTS.speed_none, { load: driving ?? "", largest: largest ?? "" });
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

/** What a run-up tends to, which its own end does not tell, and how soon. */
export const describeRunUp = ({ json }: Transient, own: Operation | null, { largest_torque }: ReportJson): string =>
  own === null
    ? TEXTS.steady_coming
    : say(TEXTS.steady, { speed: steadySpeed(own, largest_torque), constant: timeConstant(json, own) });

/** Where a motor is caught in a short cycle, or would be. */
export function describeTrap(trap: TrapJson): string {
  const [low, high] = trap.forcing_from_to;
  // With digits enough to find it.
  const digits = [4, 6, 9, 12].find((count) => shown(low, count) !== shown(high, count)) ?? 15;
  const [from, to, preload] = [shown(low, digits), shown(high, digits), shown(trap.preload_acceleration, 9)];
  const away = plain(100 * Math.abs(trap.relative_distance), 2);
  return say(trap.relative_distance === 0 ? TEXTS.trap : TEXTS.trap_near, { preload, from, to, away });
}

/** Why a motor has no stall load, or the load. */
export function describeStall(stall: StallJson): string {
  if (stall.torque !== null) return quantity(stall.torque, "N m", 4, stall.torque_error);
  return say(TEXTS.no_stall, { speed: withError(stall.no_load_speed, stall.no_load_speed_error) });
}

/** A sentence for speed, power and efficiency each; none before there is a load. */
export function describeCurves(operations: readonly Row[], stall: StallJson | null): string[] {
  const known = operations.filter(({ status }) => status !== 2);
  const [first, last] = [known[0], known.at(-1)];
  if (first === undefined || last === undefined)
    return operations.length === 0 ? [] : Array.from({ length: 3 }, () => TEXTS.all_driven);
  const best = (of: "mechanical_power" | "efficiency") =>
    known.reduce((one, other) => (other[of] > one[of] || Number.isNaN(one[of]) ? other : one));
  /** With its load. A drift is in no error: numbers of what is not settled stand without one. */
  const told = (row: Operation, told: (error: number | null) => string, error: number) => ({
    load: quantity(row.load_torque, "N m", 4),
    value: row.status === 1 ? say(TEXTS.so_far, { value: told(null) }) : told(error),
  });
  const speedAt = (row: Operation) =>
    say(TEXTS.speed_at, told(row, (error) => `${withError(row.speed, error)} rad/s`, row.speed_error));
  const stop = stall === null || stall.torque === null ? "" : ` ${say(TEXTS.stalls, { load: describeStall(stall) })}`;
  const several = operations.filter(({ others }) => others.length > 0).length;
  const more = several === 0 ? "" : ` ${say(TEXTS.several, { several, all: operations.length })}`;
  const [powerful, efficient] = [best("mechanical_power"), best("efficiency")];
  const { mechanical_power: power, mechanical_power_error } = powerful;
  const { efficiency: share, efficiency_error } = efficient;
  const most = told(powerful, (error) => quantity(power, "W", 4, error), mechanical_power_error);
  const finest = told(efficient, (error) => `${withError(share, error, 100)} %`, efficiency_error);
  return [
    `${say(TEXTS.from_to, { first: speedAt(first), last: speedAt(last) })}${stop}${more}`,
    power > 0 ? say(TEXTS.most_power, most) : TEXTS.no_power,
    share > 0 ? say(TEXTS.best_efficiency, finest) : TEXTS.no_efficiency,
  ];
}
