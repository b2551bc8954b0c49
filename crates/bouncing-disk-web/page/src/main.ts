/** Puts the page together: state, address, form, views and tools. */

// Where two of these say something of the same, the later one counts.
import "./styles/theme.css";
import "./styles/page.css";
import "./styles/screens.css";
import "./styles/views.css";
import "./styles/elsewhere.css";
import { Address, embedded, isEmbedded, isLocal, link } from "./address";
import { makeClient } from "./client";
import { messageOf, type Context, type Offer, type State, type ViewClass, type ViewName } from "./contract";
import { COURSES, CoursePanel, type Course } from "./courses";
import { fileName, save } from "./drawing/files";
import { byId, copy } from "./elements";
import { Parameters } from "./form";
import { Notes, Problems, showOpening } from "./notes";
import { openingPanel, PRESETS, stateOf, STEPS, type Panel, type Preset } from "./presets";
import { printSheet } from "./sheet";
import { choices, helpDialog, Stage } from "./shell";
import { toHash, type fromHash } from "./state";
import { Store } from "./store";
import { BasinsView } from "./views/basins";
import { CompareView } from "./views/compare";
import { DiagramView } from "./views/diagram";
import { MotorView } from "./views/motor";
import { ScanView } from "./views/scan";
import { TossView } from "./views/toss";
import { say, WORDS } from "./words";

const VIEWS: Readonly<Record<ViewName, ViewClass>> = {
  ...{ toss: TossView, diagram: DiagramView, basins: BasinsView },
  ...{ motor: MotorView, compare: CompareView, scan: ScanView },
};

/** No ultrasonic motor has a drive as slow as this (rad/s). */
const SLOWEST_MOTOR = 2e3 * Math.PI;
const MOTOR_STATE = stateOf({ change: STEPS.motor.sheet });

function begin(): void {
  const client = makeClient(byId("worker-script").textContent ?? "", byId("module-base64").textContent ?? "");
  const problems = new Problems(byId("problems"));
  const statusLine = byId("status");
  // Another state comes from the form, a drag or a view; a fresh one from a preset, the tour or the address.
  let fresh = true;

  const store = new Store(client, {
    changed: (state, { settled, fromAddress }) => {
      if (fromAddress) address.tidy(state);
      else address.write(state, settled);
      parameters.show(state, fresh || fromAddress);
      notes.show(state, course.running);
      stage.show(state, fresh);
      showInFull(state);
      fresh = false;
    },
    refused: (message) => problems.add(message),
  });
  const open = (state: State): void => {
    fresh = true;
    store.change(state);
  };
  const arrived = ({ state, problems: messages }: ReturnType<typeof fromHash>): void => {
    problems.replace(messages);
    void store.open(state);
  };
  const address = new Address(arrived);

  let clock: number | undefined;
  const context: Context = {
    client,
    state: () => store.state(),
    // A frame has no way back from another view.
    change: (change, options) => store.change(isEmbedded() ? { ...change, view: undefined } : change, options),
    status: (text, kind = "done") => {
      clearInterval(clock);
      // What is under way changes too often to be read out.
      statusLine.setAttribute("aria-live", kind === "busy" ? "off" : "polite");
      statusLine.textContent = text;
      statusLine.dataset["kind"] = kind;
      const began = performance.now();
      const tell = (): void => {
        const seconds = Math.round((performance.now() - began) / 1000);
        statusLine.textContent = say(WORDS.status.elapsed, { text, seconds });
      };
      if (kind === "busy") clock = window.setInterval(tell, 1000);
    },
  };
  const showInFull = embedded(byId("main"));
  /** What the motor's view has put aside: a hand is no motor. */
  let aside: State | null = null;
  const visit = (view: ViewName): void => {
    const { system, motor, compare, scan } = store.state();
    const guest = toHash({ ...store.state(), view: "motor" }) === toHash({ ...MOTOR_STATE, compare, scan });
    if (view === "motor" && system.angular_frequency < SLOWEST_MOTOR && motor.stator === null) {
      aside = store.state();
      open({ ...MOTOR_STATE, compare, scan });
      // A scan may be that of the motor.
    } else if (guest && aside !== null && view !== "motor" && view !== "scan") {
      open({ ...aside, view, compare, scan });
      aside = null;
    } else store.change({ view });
  };
  const stage = new Stage(byId("tabs"), byId("views"), VIEWS, context, visit);
  const parameters = new Parameters(byId("parameters"), (change, options) => store.change(change, options));
  const choose = (preset: Preset, panel: Panel): void => {
    course.stay();
    notes.choose(preset, panel);
    open(stateOf(panel));
  };
  const notes = new Notes(byId("note"), choose);
  const presets = choices(WORDS.page.figures_choose, "presets", WORDS.page.figures_what, () =>
    PRESETS.map((preset) => ({
      label: preset.place,
      note: preset.title,
      attributes: { "data-preset": preset.id },
      act: () => choose(preset, openingPanel(preset)),
    })),
  );
  const help = helpDialog();
  const course = new CoursePanel(() => store.state(), open);
  byId("main").prepend(course.element);
  const courses = choices(WORDS.course.choose, "courses", WORDS.course.what, () =>
    COURSES.map((one) => ({
      label: one.title,
      note: one.note,
      attributes: { "data-course": one.id },
      act: () => course.begin(one),
    })),
  );

  const { local, not_copied_told: failed, copied_told: taken } = WORDS.page;
  const copyLink = () => void copy(link(store.state()), context.status, isLocal() ? local : taken, failed);
  const offers = (): Offer[] => stage.view?.offers() ?? [];
  const saved = async (offer: Offer): Promise<void> => {
    const name = fileName(offer);
    try {
      save(await offer.make(), name);
      context.status(say(WORDS.page.saved, { name }));
    } catch (error) {
      problems.add(say(WORDS.page.not_saved, { name, why: String(error) }));
    }
  };
  const print = () => void printSheet(store.state(), offers()).catch((error) => problems.add(messageOf(error)));
  const exports = choices(WORDS.page.export, "export", WORDS.page.export_what, () => [
    ...offers().map((offer) => ({ label: offer.name, note: offer.kind.toUpperCase(), act: () => void saved(offer) })),
    { label: WORDS.page.link_offer, note: WORDS.page.copy, act: copyLink },
    { label: WORDS.sheet.label, note: WORDS.page.print, act: print },
  ]);
  const tools = { presets, courses, export: exports, link: copyLink, help: () => help.showModal() };
  for (const [name, act] of Object.entries(tools)) byId(`${name}-button`).addEventListener("click", act);
  byId("skip").addEventListener("click", (event) => {
    event.preventDefault();
    stage.focus();
  });

  // Only where nothing else is asked for: a link and a preset speak for themselves.
  const tour = () => course.begin(COURSES[0] as Course);
  const ways = [[WORDS.opening.tour, tour], [WORDS.opening.lessons, courses]] as const; // prettier-ignore
  if (location.hash === "") showOpening(byId("opening"), ways);
  arrived(address.opened());
}

begin();
