/** Puts the page together: state, address, form, views and tools. */

import "./style.css";
import { Address, link } from "./address";
import { makeClient, type Source } from "./client";
import type { Change, Context, State } from "./contract";
import { helpDialog, presetDialog, shortcuts } from "./dialogs";
import { byId, element } from "./elements";
import { fileName, save } from "./exports";
import { Menu } from "./menu";
import { Notes } from "./notes";
import { Parameters } from "./parameters";
import { openingPanel, stateOf, type Panel, type Preset } from "./presets";
import { Problems } from "./problems";
import { Readout } from "./readout";
import { Stage } from "./stage";
import { VIEW_NAMES } from "./state";
import { Store } from "./store";
import { Tabs } from "./tabs";
import { Themes } from "./theme";
import { TourPanel } from "./tour_panel";
import { VIEWS } from "./views";

/** The worker's script and the module: in this page, or beside it. */
function source(): Source {
  const script = document.getElementById("worker-script")?.textContent;
  const base64 = document.getElementById("module-base64")?.textContent;
  if (script && base64) return { script, base64 };
  const { worker = "worker.js", module = "module.wasm" } = byId("page-script").dataset;
  return { worker, module };
}

function begin(): void {
  const client = makeClient(source());
  const problems = new Problems(byId("problems"));
  const statusLine = byId("status");
  const announcer = byId("announcer");
  // Another state comes from the form, a drag or a view; a fresh one from a preset, the tour or the address.
  let fresh = true;

  const store = new Store(client, {
    changed: (state, { settled, fromAddress }) => {
      if (fromAddress) address.tidy(state);
      else address.write(state, settled);
      tabs.show(state.view);
      parameters.show(state, fresh || fromAddress);
      notes.show(state, tour.running);
      stage.show(state);
      fresh = false;
    },
    summary: (summary) => {
      parameters.follow(summary);
      readout.show(summary);
    },
    refused: (message) => problems.add(message),
  });
  const open = (state: State): void => {
    fresh = true;
    store.change(state);
  };
  const address = new Address((state, messages) => {
    problems.replace(messages);
    void store.open(state, true);
  });

  const context: Context = {
    client,
    state: () => store.state(),
    change: (change: Change, options) => store.change(change, options),
    announce: (text) => {
      announcer.textContent = text;
    },
    status: (text, kind = "done") => {
      // What is under way changes too often to be read out.
      statusLine.setAttribute("aria-live", kind === "busy" ? "off" : "polite");
      statusLine.textContent = text;
      statusLine.dataset["kind"] = kind;
    },
    colour: (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim(),
  };
  const stage = new Stage(byId("views"), VIEWS, context);
  const tabs = new Tabs(byId("tabs"), VIEWS, (view) => store.change({ view }));
  const side = byId("parameters");
  const parameters = new Parameters(side, (change, options) => store.change(change, options));
  const derived = element("details", { class: "group", open: true }, element("summary", {}, "What follows"));
  side.append(derived);
  const readout = new Readout(derived);
  const choose = (preset: Preset, panel: Panel): void => {
    notes.choose(preset, panel);
    open(stateOf(panel));
  };
  const notes = new Notes(byId("note"), choose);
  const presets = presetDialog((preset) => choose(preset, openingPanel(preset)));
  const help = helpDialog();
  const tour = new TourPanel(open);
  byId("main").prepend(tour.element);

  const themeButton = byId<HTMLButtonElement>("theme-button");
  const themes = new Themes(() => stage.redraw());
  const nameTheme = (): void => {
    themeButton.dataset["theme"] = themes.present;
    themeButton.setAttribute("aria-label", `Colours: ${themes.present}`);
  };
  nameTheme();

  const actions = {
    presets: () => presets.showModal(),
    tour: () => tour.begin(),
    help: () => help.showModal(),
    theme: () => {
      themes.next();
      nameTheme();
      context.announce(`Colours: ${themes.present}`);
    },
    copy: () => void copyLink(context, byId<HTMLButtonElement>("link-button")),
  };
  byId("presets-button").addEventListener("click", actions.presets);
  byId("tour-button").addEventListener("click", actions.tour);
  byId("help-button").addEventListener("click", actions.help);
  themeButton.addEventListener("click", actions.theme);
  byId("link-button").addEventListener("click", actions.copy);
  byId("skip").addEventListener("click", (event) => {
    event.preventDefault();
    stage.host?.focus();
  });
  const exportButton = byId<HTMLButtonElement>("export-button");
  const place = exportButton.nextSibling;
  const menu = new Menu(exportButton, () => [
    ...(stage.view?.offers() ?? []).map((offer) => ({
      label: offer.name,
      note: offer.kind.toUpperCase(),
      act: () => {
        save(offer).then(
          () => context.announce(`${fileName(offer)} is saved`),
          (error: unknown) => problems.add(`${fileName(offer)} cannot be made: ${String(error)}`),
        );
      },
    })),
    { label: "link to this state", note: "COPY", act: actions.copy },
  ]);
  byId("tools").insertBefore(menu.element, place);

  document.addEventListener("keydown", (event) => {
    const busy = document.querySelector("dialog[open]") !== null || event.ctrlKey || event.altKey || event.metaKey;
    const target = event.target as HTMLElement;
    if (busy || event.defaultPrevented || !shortcuts.on || target.closest("input, select, textarea, [contenteditable]"))
      return;
    const view = VIEW_NAMES[Number(event.key) - 1];
    const keys: Readonly<Record<string, () => void>> = {
      p: actions.presets, t: actions.tour, e: () => exportButton.click(), l: actions.copy, d: actions.theme,
      "?": actions.help,
    }; // prettier-ignore
    const act = view === undefined ? keys[event.key] : () => store.change({ view });
    if (act === undefined) return;
    event.preventDefault();
    act();
  });

  // On a narrow screen the picture comes first and the form is closed until somebody wants it.
  const narrow = window.matchMedia("(max-width: 860px)");
  const fold = (): void => {
    for (const group of side.querySelectorAll("details")) group.open = !narrow.matches;
  };
  narrow.addEventListener("change", fold);
  fold();

  const first = address.opened();
  problems.replace(first.problems);
  void store.open(first.state, true);
}

async function copyLink(context: Context, button: HTMLButtonElement): Promise<void> {
  const text = link(context.state());
  const words = button.textContent;
  let copied = true;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Pages on the disk may not use the clipboard; an old way still works in most browsers.
    const area = element("textarea", { class: "hidden" });
    area.value = text;
    document.body.append(area);
    area.select();
    copied = document.execCommand("copy");
    area.remove();
    button.focus();
  }
  button.textContent = copied ? "Copied" : "See the address";
  context.announce(copied ? "The link is in the clipboard" : "Copy the address of the page: it is the link");
  setTimeout(() => {
    button.textContent = words;
  }, 1500);
}

begin();
