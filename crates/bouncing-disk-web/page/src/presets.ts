/** The states of every figure and table of the paper; `words.json` says what to see in each. */

import type { Change, State } from "./contract";
import file from "./presets.json";
import { changed, DEFAULT_STATE } from "./state";
import { WORDS } from "./words";

export type Panel = Readonly<{ label: string; change: Change }>;

export type Preset = Readonly<Record<"id" | "place" | "title" | "text", string> & { panels: readonly Panel[] }>;

type Id = keyof typeof WORDS.presets;

/** What the library writes, from the defaults: the panels, ... */
const PANELS = file.panels as unknown as Readonly<Record<Id, readonly Change[]>>;

type Courses = typeof WORDS.courses;
/** ... and the steps of the courses. */
export const STEPS = file.steps as unknown as {
  readonly [Course in keyof Courses]: Readonly<Record<keyof Courses[Course]["steps"], Change>>;
};

/** At rest on the platform at its lowest point, where a single toss begins: an impact without speed. */
export const REST: State["start"] = file.steps.tour.rest.start;

/** In the order of the paper. */
export const PRESETS: readonly Preset[] = (Object.keys(WORDS.presets) as Id[]).map((id) => {
  const { panels: labels, ...words } = WORDS.presets[id];
  return { id, ...words, panels: PANELS[id].map((change, index) => ({ label: labels[index] ?? "", change })) };
});

/** Fig. 10(a) is the exception of its figure. */
export const openingPanel = ({ id, panels }: Preset): Panel => panels[id === "fig10" ? 1 : 0] as Panel;

/** The state that a panel opens. What it does not name has its default. */
export const stateOf = ({ change }: Pick<Panel, "change">): State => changed(DEFAULT_STATE, change);
