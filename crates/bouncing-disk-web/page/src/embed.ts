/** The page in a frame of another one: the view alone, with a way to all of it. */

import { isEmbedded, link } from "./address";
import type { State } from "./contract";
import { element } from "./elements";
import { say, WORDS } from "./words";

/** The element for the other page, as text. */
export function frameOf(state: State): string {
  const address = link(state).replace(/(\?[^#]*)?#/, (_, query?: string) => `${query ? `${query}&` : "?"}embed#`);
  const title = say(WORDS.embed.title, { view: WORDS.views[state.view].title });
  const frame = element("iframe", { src: address, title, width: 640, height: 480, loading: "lazy", style: "border: 0" });
  return frame.outerHTML;
}

/** Leaves the view alone where the page is embedded, and gives what tells the state to the link to all of it. */
export function embedded(place: HTMLElement): (state: State) => void {
  if (!isEmbedded()) return () => {};
  const full = element("a", { target: "_blank", class: "in-full" }, WORDS.embed.full);
  document.documentElement.dataset["embed"] = "";
  place.append(full);
  return (state) => full.setAttribute("href", link(state));
}
