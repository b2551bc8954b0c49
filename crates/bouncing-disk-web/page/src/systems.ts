/** The systems of the paper's tables, and others made from them. */

import type { State } from "./contract";
import type { SystemParameters } from "./protocol";
import { DEFAULT_SYSTEM } from "./state";

const { PI } = Math;

/** Table I's c (m), phi_L (rad) and a_e (m), and a lag (rad). */
interface Hand {
  stroke?: number;
  angle?: number;
  contact?: number;
  lag?: number;
}

/** The hand of Table I with other numbers; A and a_e Phi are the sides of the stroke, Eq. (13). */
export function tossOf({ stroke = 0.25, angle = 0.55, contact = 0.135, lag = 0 }: Hand): Partial<SystemParameters> {
  return {
    amplitude: stroke * Math.cos(angle),
    twist_amplitude: (stroke * Math.sin(angle)) / contact,
    phase_lag: lag,
    contact_radius: contact,
  };
}

/** Table I, with the restitution of Sec. IV, which a single toss does not depend on. */
export const TABLE_ONE: Readonly<SystemParameters> = { ...DEFAULT_SYSTEM, ...tossOf({}) };

/** Multiple tosses with the semielliptical motion of Fig. 6(d): theta = -0.26 pi, Gamma_T = 1. */
export const multipleToss: Readonly<SystemParameters> = {
  ...DEFAULT_SYSTEM,
  ...withTwist({ ...DEFAULT_SYSTEM, phase_lag: -0.26 * PI }, 1),
};

/** The same system with the amplitude of this axial forcing, Gamma = A omega²/(pi g). */
export function withForcing(system: SystemParameters, forcing: number): SystemParameters {
  return { ...system, amplitude: (forcing * PI * system.preload_acceleration) / system.angular_frequency ** 2 };
}

/** The same system with the twist of this angular forcing, Gamma_T = a_g² Phi omega²/(a_e pi g mu). */
export function withTwist(system: SystemParameters, forcing: number): SystemParameters {
  const { contact_radius, gyration_radius, friction, preload_acceleration, angular_frequency } = system;
  const unit = (contact_radius * PI * preload_acceleration * friction) / (gyration_radius * angular_frequency) ** 2;
  return { ...system, twist_amplitude: forcing * unit };
}

/** At rest on the platform at its lowest point, where a single toss begins: an impact without speed. */
export const REST: State["start"] = { impact_phase: 1.5 * PI, normalised_speed: 0, angular_speed: 0 };

/** A drive frequency (Hz), the largest angular speed of the stator (rad/s) and a preload acceleration (m/s²). */
interface Drive {
  frequency?: number;
  speed?: number;
  preload?: number;
}

export function motorOf({ frequency = 70e3, speed = 30, preload = 9.8 }: Drive): Partial<SystemParameters> {
  const angular_frequency = 2 * PI * frequency;
  return { angular_frequency, twist_amplitude: speed / angular_frequency, preload_acceleration: preload };
}

/** The motor of Table III, its "70" read as the drive frequency in kHz. */
export const MOTOR: Readonly<SystemParameters> = {
  amplitude: 1e-8,
  twist_amplitude: 0,
  angular_frequency: 0,
  phase_lag: 0,
  contact_radius: 1.25e-3,
  gyration_radius: 6.3e-3,
  friction: 0.1,
  restitution: 0.5,
  preload_acceleration: 9.8,
  load_acceleration: 0,
  ...motorOf({}),
};
