/** The hash of the address follows the state, and the state follows it when somebody goes back, forward or edits it. */

import type { State } from "./contract";
import { element } from "./elements";
import { fromHash, toHash } from "./state";
import { WORDS } from "./words";

/** Browsers ignore a page that writes more often than some ten times in a second (ms). */
const PAUSE = 250;

/** Whether the page stands in a frame of another one, without what stands around the view. */
export const isEmbedded = (): boolean => new URLSearchParams(location.search).has("embed");

export class Address {
  private written = "";
  /** The address of the last state that was not in the middle of a drag: where going back leads. */
  private settled = "";
  private waiting: { hash: string; settled: boolean } | null = null;
  private timer: number | undefined;
  /** The browser does not let the page write its address, which is then not the one written. */
  private forbidden = false;

  /** `arrived` gets the state of an address that the page has not written itself. */
  constructor(private readonly arrived: (read: ReturnType<typeof fromHash>) => void) {
    window.addEventListener("hashchange", () => {
      if (location.hash === this.written) return;
      clearTimeout(this.timer);
      Object.assign(this, { timer: undefined, waiting: null, written: location.hash, settled: location.hash });
      this.arrived(fromHash(location.hash));
    });
    window.addEventListener("pagehide", () => this.flush());
  }

  /** The state of the address with which the page was opened. */
  opened(): ReturnType<typeof fromHash> {
    this.written = this.settled = location.hash;
    return fromHash(location.hash);
  }

  /** Writes at once if the last time is long enough ago, else soon. */
  write(state: State, settled: boolean): void {
    const hash = toHash(state);
    // Going back is for the page around a frame.
    this.waiting = { hash, settled: !isEmbedded() && (settled || this.waiting?.settled === true) };
    if (this.timer === undefined) this.flush();
  }

  /** Puts a hash in order that has just been read: no new entry of the history. */
  tidy(state: State): void {
    this.put(toHash(state), false);
    this.settled = this.written;
  }

  private flush(): void {
    const waiting = this.waiting;
    this.waiting = null;
    if (waiting === null) return;
    this.put(waiting.hash, waiting.settled);
    this.timer = window.setTimeout(() => {
      this.timer = undefined;
      this.flush();
    }, PAUSE);
  }

  private put(hash: string, entry: boolean): void {
    // Somebody has just gone to another address, whose event is still to come: that one counts.
    if (location.hash !== this.written && !this.forbidden) return;
    if (hash === this.written && (!entry || hash === this.settled)) return;
    try {
      if (entry && this.written !== this.settled) history.replaceState(null, "", this.settled);
      if (entry) history.pushState(null, "", hash);
      else history.replaceState(null, "", hash);
    } catch {
      // Some browsers forbid this on the disk; the copied link is made from the state, not from the address.
      this.forbidden = true;
    }
    this.written = hash;
    if (entry) this.settled = hash;
  }
}

/** Where the page is published, if it is. */
const published = (): string | undefined => document.querySelector<HTMLLinkElement>('link[rel="canonical"]')?.href;

/** Whether a link leads to a file of this computer, which nobody else has. */
export const isLocal = (): boolean => location.protocol === "file:" && published() === undefined;

/** The address of this state, which from a file on a disk leads to the published page. */
export function link(state: State): string {
  const url = new URL((location.protocol === "file:" && published()) || location.href);
  url.searchParams.delete("embed");
  url.hash = "";
  return url.href + toHash(state);
}

/** Leaves the view alone where the page is embedded, and gives what tells the state to the link to all of it. */
export function embedded(place: HTMLElement): (state: State) => void {
  if (!isEmbedded()) return () => {};
  const full = element("a", { target: "_blank", class: "in-full" }, WORDS.embed.full);
  document.documentElement.dataset["embed"] = "";
  place.append(full);
  return (state) => full.setAttribute("href", link(state));
}
