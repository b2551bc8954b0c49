/** The figures of the paper to choose from, the keyboard's help and what this is. */

import { element, kept } from "./elements";
import { PRESETS, type Preset } from "./presets";

function dialog(title: string, name: string, ...content: Node[]): HTMLDialogElement {
  const made = element("dialog", { class: name, "aria-labelledby": `${name}-title` });
  const close = element(
    "button",
    { type: "button", class: "quiet close", "aria-label": "Close", onclick: () => made.close() },
    "×",
  );
  made.append(element("div", { class: "sheet" }, element("h2", { id: `${name}-title` }, title), close, ...content));
  // A click beside the sheet closes it.
  made.addEventListener("click", (event) => {
    if (event.target === made) made.close();
  });
  document.body.append(made);
  return made;
}

export function presetDialog(choose: (preset: Preset) => void): HTMLDialogElement {
  const cards = PRESETS.map((preset) =>
    element(
      "button",
      {
        type: "button",
        class: "card",
        "data-preset": preset.id,
        onclick: () => {
          made.close();
          choose(preset);
        },
      },
      element("b", {}, preset.place),
      element("span", {}, preset.title),
    ),
  );
  const made = dialog(
    "Figures and tables of the paper",
    "presets",
    element("p", {}, "Each opens the view and the parameters that come nearest to it, and says what to see."),
    element("div", { class: "cards" }, ...cards),
  );
  made.addEventListener("keydown", (event) => {
    const by = ({ ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 } as Record<string, number>)[event.key];
    const at = cards.indexOf(document.activeElement as HTMLButtonElement);
    if (by === undefined || at < 0) return;
    event.preventDefault();
    cards[(at + by + cards.length) % cards.length]?.focus();
  });
  return made;
}

const KEYS: readonly [string, string][] = [
  ["1 2 3 4", "Toss, orbit diagram, basins, motor"],
  ["p", "figures and tables of the paper"],
  ["t", "guided tour; in it → next, ← back, Esc end"],
  ["e", "export data and pictures of the view"],
  ["l", "copy a link to what you see"],
  ["d", "light, dark or automatic colours"],
  ["?", "this help"],
  ["↑ ↓", "in a number: one step; with Shift ten"],
  ["Esc", "in a number: back to the last legal value"],
  ["+ − 0", "in a diagram or basins: nearer, farther, all"],
  ["← → ↑ ↓", "there: move what is seen"],
  ["Shift ← → ↑ ↓", "there: move the cross"],
  ["Enter", "there: choose what is under the cross"],
];

/** Single keys get in the way of dictation and of some screen readers, so they can be switched off. */
export const shortcuts = {
  get on(): boolean {
    return kept.read("keys") !== "off";
  },
};

export function helpDialog(): HTMLDialogElement {
  const box = element("input", { type: "checkbox", id: "keys-on", checked: shortcuts.on });
  box.addEventListener("change", () => kept.write("keys", box.checked ? "on" : "off"));
  const keys = KEYS.map(([key, what]) =>
    element(
      "div",
      {},
      element("dt", {}, ...key.split(" ").map((one) => element("kbd", {}, one))),
      element("dd", {}, what),
    ),
  );
  const paragraph = (text: string): HTMLElement => element("p", {}, text);
  return dialog(
    "Keyboard and about",
    "help",
    element("dl", { class: "keys" }, ...keys),
    element("p", {}, element("label", {}, box, " Keys without Ctrl or Alt work")),
    element("h3", {}, "What this is"),
    paragraph(
      "A disk bounces on a platform that vibrates and twists: a pizza dough on a hand, a steel ball on a chaotic " +
        "table, or the rotor of an ultrasonic motor. Everything is computed in this page by the library of the " +
        "project, with the same bits as on any other machine; nothing is sent anywhere, and nothing is loaded " +
        "from anywhere.",
    ),
    element(
      "p",
      {},
      "The model is that of K.-C. Liu, J. Friend and L. Yeo, ",
      element("cite", {}, "Rotating bouncing disks, tossing pizza dough, and the behavior of ultrasonic motors"),
      ", Phys. Rev. E 80, 046201 (2009), doi:10.1103/PhysRevE.80.046201. Please cite it for the physics.",
    ),
    paragraph("Licence: MIT or Apache-2.0, as you prefer."),
  );
}
