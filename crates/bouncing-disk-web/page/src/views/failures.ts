/** What a view does with an answer that does not come. */

import { Cancelled, Refused } from "../contract";
import type { Context } from "../contract";

/** Says what went wrong; a request that another one replaced went not wrong. */
export function tellFailure(context: Context, error: unknown): void {
  if (error instanceof Cancelled) return;
  const message =
    error instanceof Refused ? error.refusal.message : error instanceof Error ? error.message : String(error);
  context.status(message, "error");
}
