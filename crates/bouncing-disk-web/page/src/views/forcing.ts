/** The axial forcing parameter of a system, and the system of a forcing. */

import type { SystemParameters } from "../protocol";

export function axialForcing(system: Readonly<SystemParameters>): number {
  return (system.amplitude * system.angular_frequency ** 2) / (Math.PI * system.preload_acceleration);
}

export function amplitudeOf(axialForcing: number, system: Readonly<SystemParameters>): number {
  return (axialForcing * Math.PI * system.preload_acceleration) / system.angular_frequency ** 2;
}
