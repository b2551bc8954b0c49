/** The views, in the order of their tabs. */

import type { View } from "./contract";
import { VIEWS as PLACEHOLDERS } from "../dev/placeholders";
import { view as basins } from "./views/basins";
import { view as diagram } from "./views/diagram";

const [toss, , , motor] = PLACEHOLDERS as [View, View, View, View];

export const VIEWS: readonly View[] = [toss, diagram, basins, motor];
