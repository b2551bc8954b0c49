/** The numbers that follow from the parameters, as the module gives them. */

import { element, symbol } from "./elements";
import { shown } from "./numbers";
import type { Summary } from "./protocol";

const seconds = (value: number): string => {
  if (value >= 0.1) return `${shown(value, 4)} s`;
  return value >= 1e-4 ? `${shown(value * 1e3, 4)} ms` : `${shown(value * 1e6, 4)} µs`;
};

const metres = (value: number): string => {
  if (value >= 1e-2 || value === 0) return `${shown(value, 4)} m`;
  return value >= 1e-5 ? `${shown(value * 1e3, 4)} mm` : `${shown(value * 1e6, 4)} µm`;
};

export class Readout {
  private readonly list = element("dl", { class: "readout" });
  private readonly sentence = element("p", { class: "bounces" });

  constructor(host: HTMLElement) {
    host.append(this.list, this.sentence);
  }

  show(summary: Summary): void {
    const { angular_forcing, rise_time } = summary;
    const rows: [string, string, string][] = [
      ["Γ_T", "angular forcing", angular_forcing === null ? "none, no friction" : shown(angular_forcing, 4)],
      ["Aω²/g", "peak acceleration", `${shown(summary.peak_acceleration, 4)} g`],
      ["2π/ω", "period", seconds(summary.period)],
      ["c", "stroke", metres(summary.stroke)],
      ["t_r", "rise time", rise_time === null ? "none" : seconds(rise_time)],
    ];
    this.list.replaceChildren(
      ...rows.map(([sign, name, value]) =>
        element("div", {}, element("dt", {}, symbol(sign), ` ${name}`), element("dd", {}, value)),
      ),
    );
    this.sentence.textContent = summary.bounces
      ? "The platform falls away from a disk at rest on it: the disk bounces."
      : "The platform never falls away from a disk at rest on it.";
  }
}
