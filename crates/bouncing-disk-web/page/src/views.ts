/** The views, in the order of their tabs. */

import type { View } from "./contract";
import { VIEWS as PLACEHOLDERS } from "../dev/placeholders";

export const VIEWS: readonly View[] = PLACEHOLDERS;
