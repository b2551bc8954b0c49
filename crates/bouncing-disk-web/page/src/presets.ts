/** A preset for every figure and table of the paper: what it shows, the view, and the parameters of each panel. */

import type { State } from "./contract";
import { DISK_FIGURES, DOUGH, TOSS_TABLES } from "./presets/disk";
import { MOTOR_FIGURES, MOTOR_TABLE } from "./presets/motor";
import type { Panel, Preset } from "./presets/preset";
import { changed, DEFAULT_STATE } from "./state";

export type { Panel, Preset };

/** In the order of the paper. */
export const PRESETS: readonly Preset[] = [...DISK_FIGURES, ...MOTOR_FIGURES, DOUGH, ...TOSS_TABLES, MOTOR_TABLE];

export const openingPanel = ({ panels, opens = 0 }: Preset): Panel => panels[opens] ?? panels[0];

/** The state that a panel opens. What it does not name has its default. */
export const stateOf = (panel: Panel): State => changed(DEFAULT_STATE, panel.change);
