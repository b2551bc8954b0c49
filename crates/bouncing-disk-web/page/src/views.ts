/** The views, in the order of their tabs. */

import type { View } from "./contract";
import { VIEWS as PLACEHOLDERS } from "../dev/placeholders";
import { view as basins } from "./views/basins";
import { view as diagram } from "./views/diagram";
import { view as toss } from "./views/toss";

export const VIEWS: readonly View[] = [toss, diagram, basins, PLACEHOLDERS[3]!];
