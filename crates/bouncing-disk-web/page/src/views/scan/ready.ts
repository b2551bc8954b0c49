/** Scans that are ready made: the system, and what is computed of it. */

import type { Change, State } from "../../contract";
import { bouncing, motor, toss } from "../../presets";
import { DEFAULT_STATE } from "../../state";
import { WORDS } from "../../words";

const { best_hand, preload, basin_share, exponent } = WORDS.scan.ready;

const of = (label: string, system: Change, scan: Partial<State["scan"]>): { label: string; change: Change } => ({
  label,
  change: { ...system, view: "scan", scan: { ...DEFAULT_STATE.scan, family: null, ...scan } },
});

export const READY = [
  of(best_hand, toss({}), { family: "phase_lag", range: [0, 1.4] }),
  // The range of Fig. 11, 80 to 280 mN.
  of(preload, motor({}), { over: "preload_acceleration", range: [2.43, 8.51], points: 13, result: "motor_speed" }),
  of(basin_share, bouncing(0.45), { over: "axial_forcing", range: [0.3, 0.62], points: 33, result: "share_periodic" }),
  of(exponent, bouncing(0.45), { over: "axial_forcing", range: [0.34, 0.58], points: 121, result: "orbit_exponent" }),
];
