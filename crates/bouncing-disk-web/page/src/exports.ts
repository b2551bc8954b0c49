/** Files of a view, saved by the browser. */

import type { Offer } from "./contract";
import { element } from "./elements";

export const fileName = ({ name, kind }: Offer): string => `${name.trim().replace(/\s+/g, "-").toLowerCase()}.${kind}`;

/** How long (ms) a browser may take to begin with saving. */
const PATIENCE = 60_000;

export async function save(offer: Offer): Promise<void> {
  const address = URL.createObjectURL(await offer.make());
  element("a", { href: address, download: fileName(offer) }).click();
  setTimeout(() => URL.revokeObjectURL(address), PATIENCE);
}
