/** The views, in the order of their tabs. */

import type { View } from "./contract";
import { view as basins } from "./views/basins";
import { view as diagram } from "./views/diagram";
import { view as motor } from "./views/motor";
import { view as toss } from "./views/toss";

export const VIEWS: readonly View[] = [toss, diagram, basins, motor];
