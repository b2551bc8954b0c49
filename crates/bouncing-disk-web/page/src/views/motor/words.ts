/** The motor in words: regime, warnings, traps, steady speed, run-up and curves. */

import { element, Facts, section, setText } from "../../elements";
import { grouped, plain, prefixOf, quantity, quantityWithError, toldApart, withError } from "../../numbers";
import type { IntervalJson, ReportJson, StallJson, TrapJson } from "../../protocol";
import type { Operation, Transient } from "./sheet";

const NAMES = [
  "Regime", "Forcing Γ", "Contact time over the period", "Static indentation over A", "Largest torque of friction", "Steady speed", "Amplitude", "Time constant", "Stall load",
] as const; // prettier-ignore

export class ReportPanel {
  readonly root = section("Report", "panel");
  private readonly facts = new Facts(NAMES, "The motor in numbers");
  /** Stands above the curves, which a trap makes those of another motion than one would expect. */
  readonly trap = element("p", { class: "caution trap", hidden: true });
  private readonly warnings = element("ul", { class: "warnings" });
  private readonly warned = element("summary", { class: "warned" });
  private readonly warningsBox = element("details", { hidden: true }, this.warned, this.warnings);
  private readonly text = element("pre", { class: "report", tabindex: 0, "aria-label": "Full report" });

  constructor() {
    const full = element("details", {}, element("summary", {}, "Full report"), this.text);
    this.root.append(element("h3", {}, "Report"), this.facts.root, this.warningsBox, full);
  }

  /** Forgets a motor. */
  clear(): void {
    for (const name of NAMES) this.facts.set(name, "…");
    this.trap.hidden = true;
    this.warningsBox.hidden = true;
    setText(this.text, "");
  }

  report(report: ReportJson): void {
    this.facts.set("Regime", `${regimeOf(report)}${report.regime}`);
    this.facts.set("Forcing Γ", plain(report.axial_forcing, 5));
    const [[, time], [, depth]] = report.contact;
    this.facts.set("Contact time over the period", time);
    this.facts.set("Static indentation over A", depth);
    this.facts.set("Largest torque of friction", quantity(report.largest_torque, "N m"));
    this.trap.hidden = report.trap === null;
    if (report.trap !== null) setText(this.trap, describeTrap(report.trap, report));
    const { length } = report.warnings;
    this.warningsBox.hidden = length === 0;
    setText(this.warned, length === 1 ? "1 warning" : `${length} warnings`);
    this.warnings.replaceChildren(...report.warnings.map((warning) => element("li", {}, warning)));
    setText(this.text, report.text);
  }

  /** Of a motor that nothing turns. */
  still(): void {
    for (const name of ["Steady speed", "Amplitude", "Time constant", "Stall load"]) this.facts.set(name, "–");
  }

  runUp(transient: Transient | null, own: Operation | null, problem = ""): void {
    const known = transient === null ? problem || "…" : timeConstant(transient.json, own);
    this.facts.set("Time constant", known);
  }

  operation(own: Operation, report: ReportJson): void {
    this.facts.set("Steady speed", steadySpeed(own, report.largest_torque));
    const known = own.amplitude === null ? "as the system says" : `${quantity(own.amplitude, "m")} ${under(own.load_torque)}`;
    this.facts.set("Amplitude", known);
  }

  stall(stall: StallJson | null, problem = ""): void {
    this.facts.set("Stall load", stall === null ? problem || "–" : describeStall(stall));
  }
}

/** What a regime leaves out. */
const regimeOf = ({ system, yields }: ReportJson): string =>
  `${yields ? "without a rotor" : ""}${yields && system.contact_time > 0 ? ", " : ""}` +
  `${system.contact_time > 0 ? "of rigid impacts" : ""}${yields || system.contact_time > 0 ? ": " : ""}`;

/** What turns nothing, or null for a motor that may turn. */
export function whyNothingTurns(report: ReportJson): string | null {
  const nothing = "nothing turns the rotor: there is no run-up, and no curve.";
  if (report.angular_forcing === null || !(report.largest_torque > 0)) return `Without friction ${nothing}`;
  return report.angular_forcing === 0 ? `Without a twist of the stator ${nothing}` : null;
}

const under = (load: number): string =>
  load === 0 ? "without load" : `under the load of the sheet, ${quantity(load, "N m")}`;

const overpowered = ({ load_torque }: Operation, largest: number): string =>
  `the load of the sheet, ${quantity(load_torque, "N m")}, is more than ` +
  `the ${quantity(largest, "N m")} that friction holds at most`;

/** The steady speed under the load of the sheet, with no more digits than are known. */
export function steadySpeed(own: Operation, largestTorque: number): string {
  if (own.status === 2) return `none: ${overpowered(own, largestTorque)}`;
  if (own.status === 1) {
    const why = own.shortfall === null ? "" : `; ${readable(own.shortfall)}`;
    return `not settled, ${plain(own.speed, 3)} rad/s so far ${under(own.load_torque)}${why}`;
  }
  return `${withError(own.speed, own.speed_error)} rad/s ${under(own.load_torque)}`;
}

/** What a motor lacks, as the library's ASCII says it. */
const readable = (text: string): string =>
  text
    .replace(/-?[\d.]+e-?\d+/g, (digits) => plain(Number(digits), 3))
    .replace("+-", "±")
    .replace("rad/s^2", "rad/s²");

/** A time with its 95 % interval, with the digits that the interval leaves: "852 ms (95 % interval 824 to 889 ms)". */
function time({ value, low, high }: IntervalJson): string {
  const { factor, symbol } = prefixOf(value);
  const decimals = Math.min(20, Math.max(0, 1 - Math.floor(Math.log10((high - low || value) * factor))));
  const [middle, from, to] = [value, low, high].map((one) => grouped((one * factor).toFixed(decimals)));
  return `${middle} ${symbol}s (95 % interval ${from} to ${to} ${symbol}s)`;
}

/** The time constant of a run-up that has one. */
export function timeConstant({ rise, refusal }: Transient["json"], own: Operation | null): string {
  if (own?.status === 2) return "none: the load drives the rotor";
  if (rise === null) return `none: ${refusal ?? "it is not known"}`;
  if (rise.form === "ramp") return "none: the run-up is nearer to a straight line than to an exponential";
  return time(rise.constant);
}

/** What a run-up tends to, which its own end does not tell, and its form. */
export function describeRunUp({ json }: Transient, own: Operation | null, report: ReportJson): string {
  if (own?.status === 2) {
    const why = overpowered(own, report.largest_torque).replace(/^t/, "T");
    return `${why}: it drives the rotor faster and faster, and there is no steady speed.`;
  }
  const steady =
    own === null ? "The steady speed is being computed." : `Steady speed: ${steadySpeed(own, report.largest_torque)}.`;
  const { rise, refusal } = json;
  if (rise === null) return `${steady} The time constant is undefined: ${refusal ?? "it is not known"}.`;
  const missed = `${plain(rise.residual, 2)} rad/s, root mean square`;
  return rise.form === "exponential"
    ? `${steady} An exponential with a time constant of ${time(rise.constant)} is nearest to the run-up, and misses it by ${missed}.`
    : `${steady} A straight rise that ends after ${time(rise.constant)} is nearer to the run-up than an exponential, ` +
        `and misses it by ${missed}.`;
}

/** Where a motor is caught in a short cycle, or would be. */
export function describeTrap(trap: TrapJson, report: ReportJson): string {
  const [low, high] = trap.forcing_from_to;
  const [from, to] = toldApart(low, high, 3);
  const [edge] = toldApart(trap.preload_acceleration, report.system.preload_acceleration, 2);
  const reach = `for Γ from ${from} to ${to}`;
  if (trap.caught) {
    return `Trap: this motor, at a preload acceleration of ${edge} m/s², is caught in a short cycle, as it is ${reach}.`;
  }
  const away = plain(100 * Math.abs(trap.relative_distance), 2);
  return (
    `A trap is near, ${away} % away: at a preload acceleration of ${edge} m/s² this motor would be caught in a short ` +
    `cycle, as it is ${reach}.`
  );
}

/** Why a motor has no stall load, or the load. */
export function describeStall(stall: StallJson): string {
  if (stall.torque !== null) return quantityWithError(stall.torque, stall.torque_error, "N m");
  return `none: without load the speed, ${withError(stall.no_load_speed, stall.no_load_speed_error)} rad/s, is none`;
}

/** A sentence for speed, power and efficiency each; none before there is a load. */
export function describeCurves(operations: readonly Operation[], stall: StallJson | null): string[] {
  const known = operations.filter(({ status }) => status !== 2);
  const first = known[0];
  const last = known[known.length - 1];
  if (first === undefined || last === undefined) {
    const away = "Each of the loads computed is more than friction holds, and drives the rotor.";
    return operations.length === 0 ? [] : [away, away, away];
  }
  const at = ({ load_torque }: Operation) => quantityWithError(load_torque, null, "N m");
  const speed = (row: Operation) =>
    row.status === 1
      ? `${plain(row.speed, 3)} rad/s so far, not settled, at ${at(row)}`
      : `${withError(row.speed, row.speed_error)} rad/s at ${at(row)}`;
  const stop = stall === null || stall.torque === null ? "" : ` The motor stalls at ${describeStall(stall)}.`;
  const powerful = known.reduce((best, row) => (row.mechanical_power > best.mechanical_power ? row : best));
  // A drift is in no error: numbers of what is not settled stand without one.
  const settled = ({ status }: Operation, known: string, rough: string) =>
    status === 1 ? `${rough} so far, not settled` : known;
  const power = settled(
    powerful,
    quantityWithError(powerful.mechanical_power, powerful.mechanical_power_error, "W"),
    quantity(powerful.mechanical_power, "W"),
  );
  const efficient = known
    .filter(({ efficiency }) => efficiency > 0)
    .reduce<Operation | null>((best, row) => (best === null || row.efficiency > best.efficiency ? row : best), null);
  return [
    `From ${speed(first)} to ${speed(last)}.${stop}`,
    powerful.mechanical_power > 0
      ? `Of the loads computed, the load takes most power at ${at(powerful)}: ${power}.`
      : "None of the loads computed takes power from the motor.",
    efficient === null
      ? "None of the loads computed takes power from the motor, which has no efficiency there."
      : "Of the loads computed, the best efficiency is " +
        `${settled(
          efficient,
          `${withError(efficient.efficiency, efficient.efficiency_error, 100)} %`,
          `${plain(100 * efficient.efficiency, 3)} %`,
        )} at ${at(efficient)}.`,
  ];
}
