/** What a preset is: a figure or table of the paper, and its panels. */

import type { Change } from "../contract";

export interface Panel {
  /** "(a)", or what the panel varies. */
  readonly label: string;
  readonly change: Change;
}

export interface Preset {
  readonly id: string;
  /** "Fig. 6" */
  readonly place: string;
  readonly title: string;
  /** Two sentences on what to see. */
  readonly text: string;
  readonly panels: readonly [Panel, ...Panel[]];
  /** The panel that the preset opens; without it the first one. */
  readonly opens?: number;
}
