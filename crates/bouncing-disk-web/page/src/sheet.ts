/** A sheet to print: the pictures of a view, its parameters, the task that is open, and the link, also as a code. */

import { renderSVG } from "uqr";
import { isLocal, link } from "./address";
import type { Offer, State } from "./contract";
import { PARTS, valuesOf } from "./drawing/files";
import { div, element, rich } from "./elements";
import { shortLabelOf } from "./form";
import { toHash } from "./state";
import { say, WORDS } from "./words";

/** Lines to write on. */
const LINES = 3;

/** Puts the sheet into the page, which shows it in print alone, and prints it. */
export async function printSheet(state: State, offers: readonly Offer[]): Promise<void> {
  const pictures = await Promise.all(offers.filter(({ kind }) => kind === "svg").map(pictureOf));
  if (pictures.length === 0) throw new Error(WORDS.sheet.nothing);
  const local = isLocal();
  const address = local ? toHash(state) : link(state);
  const numbers = div("printed-numbers", element("dl", {}, ...parameters(state)));
  // A code of a whole link has some 90 modules in a row, of 0.65 mm: telephones read half of that.
  numbers.insertAdjacentHTML("beforeend", renderSVG(address, { ecc: "L", border: 4 }));
  const sheet = element(
    "section",
    { class: "printed" },
    element("h1", {}, say(WORDS.sheet.title, { view: WORDS.views[state.view].title })),
    div("printed-pictures", ...pictures),
    div("printed-task", ...openTask()),
    numbers,
    element("p", {}, local ? WORDS.sheet.unpublished : WORDS.sheet.scan, element("small", {}, address)),
  );
  document.querySelector(".printed")?.remove();
  document.body.append(sheet);
  const done = () => {
    for (const { src } of pictures) URL.revokeObjectURL(src);
    sheet.remove();
  };
  window.addEventListener("afterprint", done, { once: true });
  window.print();
}

async function pictureOf(offer: Offer): Promise<HTMLImageElement> {
  const image = element("img", { src: URL.createObjectURL(await offer.make()), alt: offer.name });
  await image.decode();
  return image;
}

/** What the lesson or the note above the view says, without the answer, and room to write. */
function openTask(): Node[] {
  const open = document.querySelector(".tour:not([hidden]), #note:not([hidden])");
  const words = [...(open?.querySelectorAll("h2, p:not(.tour details p)") ?? [])].map((part) => part.cloneNode(true));
  if (words.length === 0) words.push(element("h2", {}, WORDS.sheet.task));
  return [...words, ...Array.from({ length: LINES }, () => div("printed-line"))];
}

function parameters(state: State): HTMLElement[] {
  return valuesOf({ state, names: state.thrown === null ? PARTS.all : PARTS.rotor }).map(({ parameter, value }) => {
    const name = element("dt", {}, `${shortLabelOf(parameter)} `, ...rich(parameter.symbol));
    return element("div", {}, name, element("dd", {}, value));
  });
}
