/** Plausible answers to all requests. The page's tests look at what the page does with them, not at the numbers. */

import type { ImpactStart, MotorSheet, Refusal, Request, SystemParameters } from "../src/protocol";
import { orbit, type Bounce } from "./ball";

export class FakeRefusal extends Error {
  constructor(readonly refusal: Refusal) {
    super(refusal.message);
  }
}

interface Answer {
  json: unknown;
  numbers?: number[];
  bytes?: number[];
}

function demand(legal: boolean, quantity: string, value: number, range: string): void {
  if (legal) return;
  const message = `${quantity} = ${value} is outside ${range}`;
  throw new FakeRefusal({ kind: "out-of-range", quantity, value, range, message });
}

function check(system: SystemParameters): void {
  for (const name of ["amplitude", "twist_amplitude", "friction"] as const) {
    demand(system[name] >= 0, name, system[name], "[0, inf)");
  }
  for (const name of ["angular_frequency", "contact_radius", "gyration_radius", "preload_acceleration"] as const) {
    demand(system[name] > 0, name, system[name], "(0, inf)");
  }
  demand(system.restitution >= 0 && system.restitution < 1, "restitution", system.restitution, "[0, 1)");
  demand(peak(system) <= 1e8, "peak_acceleration", peak(system), "[0, 1e8]");
}

const peak = ({ amplitude, angular_frequency, preload_acceleration }: SystemParameters): number =>
  (amplitude * angular_frequency ** 2) / preload_acceleration;

const bounce = (forcing: number, { impact_phase, normalised_speed }: ImpactStart): Bounce => {
  const range = "(-inf, 0] (disk minus platform, units of g/omega)";
  demand(normalised_speed >= 0, "axial_impact_velocity", -Math.PI * normalised_speed, range);
  return { phase: impact_phase, speed: normalised_speed / (forcing || 1) };
};

const turn = 2 * Math.PI;
const reduced = (phase: number): number => ((phase % turn) + turn) % turn;

function summary(system: SystemParameters): unknown {
  const { friction, contact_radius, gyration_radius, preload_acceleration, twist_amplitude, angular_frequency } =
    system;
  const push = (friction * contact_radius * preload_acceleration) / gyration_radius ** 2;
  const spin = twist_amplitude * angular_frequency;
  return {
    axial_forcing: peak(system) / Math.PI,
    angular_forcing: friction > 0 ? (spin * angular_frequency) / (Math.PI * push) : null,
    period: turn / angular_frequency,
    peak_acceleration: peak(system),
    stroke: Math.hypot(system.amplitude, contact_radius * twist_amplitude),
    rise_time: spin > 0 && push > 0 ? spin / push : null,
    bounces: peak(system) > 1,
  };
}

function motion(request: Extract<Request, { call: "motion" }>): Answer {
  const { system, start, periods, samples_per_period } = request;
  const { amplitude, twist_amplitude, angular_frequency: omega, phase_lag } = system;
  if (start.kind === "impact") bounce(1, start);
  if (start.kind === "flight") demand(start.gap >= 0, "gap", start.gap, "[0, inf)");
  const samples = periods * samples_per_period + 1;
  const numbers: number[] = [];
  const bytes: number[] = [];
  for (let index = 0; index < samples; index++) {
    const tau = (turn * index) / samples_per_period;
    const spin = omega * twist_amplitude * (1 - Math.exp(-tau / 20));
    numbers.push(
      tau / omega, amplitude * (1 + Math.abs(Math.sin(tau / 2))), spin * (tau / omega), 0, spin,
      amplitude * Math.sin(tau),
      twist_amplitude * Math.sin(tau + phase_lag), amplitude * omega * Math.cos(tau),
      omega * twist_amplitude * Math.cos(tau + phase_lag),
    ); // prettier-ignore
    bytes.push(0);
  }
  for (let index = 0; index < periods; index++) {
    numbers.push((turn * index) / omega, 0.74, 4 / 3, 0, 1, amplitude);
    bytes.push(0);
  }
  const energy = { platform_work: 1, restitution_loss: 0.6, friction_loss: 0.2, load_work: 0, stored: 0.2 };
  return { json: { samples, events: periods, event_kinds: ["impact"], energy }, numbers, bytes };
}

function diagram(request: Extract<Request, { call: "diagram" }>): Answer {
  const { axial_forcing, count, columns, start, transient, recorded, system } = request;
  const numbers: number[] = [];
  for (let column = columns[0]; column < columns[1]; column++) {
    const forcing = axial_forcing[0] + ((axial_forcing[1] - axial_forcing[0]) * column) / Math.max(1, count - 1);
    const few = Math.min(transient, 30) + Math.min(recorded, 30);
    const impacts = orbit(forcing, system.restitution, bounce(forcing, start), few).slice(Math.min(transient, 30));
    for (const { phase, speed } of impacts) {
      numbers.push(forcing, reduced(phase), speed * forcing, Math.cos(phase + system.phase_lag));
    }
  }
  return { json: { resting: 0, unsettled: 0, left_out: transient }, numbers };
}

function sheetOf(system: SystemParameters, mass: number): MotorSheet {
  demand(mass > 0, "mass", mass, "(0, inf)");
  return {
    drive_frequency: system.angular_frequency / turn,
    amplitude: system.amplitude,
    peak_angular_speed: system.angular_frequency * system.twist_amplitude,
    twist_amplitude: null,
    phase_lag: system.phase_lag,
    mass,
    density: null,
    rotor_radius: null,
    rotor_thickness: null,
    contact_radius: system.contact_radius,
    gyration_radius: system.gyration_radius,
    preload_force: null,
    preload_acceleration: system.preload_acceleration,
    spring_constant: null,
    friction: system.friction,
    restitution: system.restitution,
    load_torque: system.load_acceleration * mass * system.gyration_radius ** 2,
  };
}

function systemOf(sheet: MotorSheet): SystemParameters {
  const { amplitude, phase_lag, contact_radius, friction, restitution } = sheet;
  const angular_frequency = turn * sheet.drive_frequency;
  const twist_amplitude = (sheet.peak_angular_speed ?? 0) / angular_frequency;
  const gyration_radius = sheet.gyration_radius ?? contact_radius;
  const preload_acceleration = sheet.preload_acceleration ?? 9.8;
  const platform = { amplitude, twist_amplitude, angular_frequency, phase_lag };
  const disk = { contact_radius, gyration_radius, friction, restitution, preload_acceleration, load_acceleration: 0 };
  return { ...platform, ...disk };
}

const PERIODIC = { impacts: 1, platform_periods: 1, multipliers: [[0.25, 0.1], [0.25, -0.1]] }; // prettier-ignore

/** What is not asked for in the tests of the shell has the shape of its answer and hardly more. */
function motorAnswer(request: Request): Answer {
  switch (request.call) {
    case "motor_transient": {
      const numbers = Array.from({ length: request.points }, (_, index) => [
        index,
        21 * (1 - Math.exp(-index / 20)),
        0.2,
      ]);
      const rise = { form: "exponential", constant: { value: 0.8, low: 0.7, high: 0.9 }, residual: 0.2 };
      const json = { points: request.points, rise, refusal: null };
      return { json, numbers: numbers.flat() };
    }
    case "motor_loads": {
      const rows = request.load_torques.map((load) => [
        load,
        21 - 1e5 * load,
        0.1,
        1e-6,
        1e-8,
        4e-6,
        1e-8,
        0.25,
        0.01,
        0,
      ]);
      return { json: { shortfalls: request.load_torques.map(() => null) }, numbers: rows.flat() };
    }
    case "motor_stall":
      return {
        json: {
          torque: 3e-5,
          torque_error: 1e-7,
          bracket: [2.9e-5, 3.1e-5],
          no_load_speed: 21,
          no_load_speed_error: 0.1,
        },
      };
    case "sheet_write":
      return { json: { text: JSON.stringify(request.sheet, null, 2) } };
    case "sheet_read":
      return { json: { sheet: JSON.parse(request.text), system: systemOf(JSON.parse(request.text)), mass: 0.0329 } };
    case "motor_report": {
      const system = systemOf(request.sheet);
      const numbers = { axial_forcing: peak(system) / Math.PI, angular_forcing: 1, largest_torque: 4e-5 };
      const words = { regime: "long chattering", warnings: [], text: "A report of the fake.", trap: null };
      return { json: { ...numbers, ...words, system, mass: request.sheet.mass } };
    }
    default:
      throw new FakeRefusal({
        kind: "request",
        quantity: null,
        value: null,
        range: null,
        message: "the fake cannot do this",
      });
  }
}

/** With the first of these coefficients of friction the fake breaks down, with the second it never ends. */
const BREAKS = 0.06660666;
const HANGS = 0.07770777;

export function answer(request: Request): Answer {
  if ("system" in request && request.system.friction === BREAKS) throw new WebAssembly.RuntimeError("unreachable");
  if (request.call !== "check" && "system" in request && request.system.friction === HANGS) for (;;);
  if ("system" in request) check(request.system);
  switch (request.call) {
    case "check":
      return { json: summary(request.system) };
    case "motion":
      return motion(request);
    case "diagram":
      return diagram(request);
    case "orbit":
      return {
        json: {
          kind: "periodic",
          ...PERIODIC,
          exponent: -0.5,
          exponent_error: null,
          rounding_dependent: false,
          text: "Period 1",
        },
      };
    case "branches":
      return { json: { branches: [], bifurcations: [] } };
    case "attractors":
      return {
        json: {
          attractors: [
            { label: 1, kind: "periodic", text: "One impact in each period", share: 0.4, interval: [0.38, 0.42], lasts: true,
              leads_to: null, impact: { impact_phase: 0.7, normalised_speed: 1.33 } },
            { label: 2, kind: "rest", text: "Chatters", share: 0.6, interval: [0.58, 0.62], lasts: true, leads_to: null,
              impact: null },
          ],
          undecided: 0,
          starts: 1024,
          fastest_start: 3.2,
        },
      }; // prettier-ignore
    case "basins": {
      const [from, to] = request.rows;
      const bytes = Array.from(
        { length: (to - from) * request.phases },
        (_, cell) => 1 + (((cell % request.phases) ^ (from + Math.floor(cell / request.phases))) & 1),
      );
      return { json: {}, bytes };
    }
    case "sheet_of_system":
      return { json: { sheet: sheetOf(request.system, request.mass) } };
    default:
      return motorAnswer(request);
  }
}
