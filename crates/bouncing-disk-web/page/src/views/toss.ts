/** Toss and bounce: the motion itself, from the engine's own trajectory. */

import "./views.css";

import type { Context, Offer, State, Throw, View } from "../contract";
import { ScreenChart } from "../drawing/chart_screen";
import { button, element, oncePerFrame, prefersLessMotion, setText } from "../drawing/elements";
import { Layers } from "../drawing/layers";
import { plain } from "../drawing/numbers";
import type { MotionStart } from "../protocol";
import { tellFailure } from "./failures";
import { RoundingCaution } from "./rounding";
import { Controls } from "./toss/controls";
import { describeMoment } from "./toss/description";
import { attachKeys } from "./toss/keys";
import { tossLayout } from "./toss/layout";
import { tossOffers } from "./toss/offers";
import { describePath, paintPathInset } from "./toss/path";
import { Player } from "./toss/player";
import { Portrait } from "./toss/portrait";
import { Readings } from "./toss/readings";
import { Recording } from "./toss/recording";
import type { Moment } from "./toss/recording";
import { describeGains, paintScale, paintScene, stageOf } from "./toss/scene";
import type { Stage } from "./toss/scene";
import { ThrowForm } from "./toss/throw_form";
import { attachThrowing, describeThrow } from "./toss/throwing";
import { traces } from "./toss/traces";

/** The slowest rotor of Fig. 9 takes 40 periods to stop. */
const FIRST_PERIODS = 48;
const MOST_PERIODS = 1280;
const SAMPLES_PER_PERIOD = 64;
/** More of the motion is asked for when less than this share of it is still to be shown. */
const AHEAD = 0.35;

class TossView implements View {
  readonly name = "toss";
  readonly title = "Toss and bounce";
  readonly description = "Disk and platform in perspective, with time traces and the phase portrait of the impacts.";
  private context!: Context;
  private readonly scene = new Layers(
    "picture-scene",
    "Disk and platform in perspective. Space plays or pauses, left and right move in time, Home goes to the start.",
  );
  private readonly readings = new Readings();
  private readonly gains = element("p", { class: "remark" });
  private readonly thrown = element("p", { class: "remark", hidden: true });
  private readonly rounding = new RoundingCaution(
    "toss-rest",
    "once this disk has come to rest, rounding decides after how many impacts it rests again.",
  );
  private readonly alternative = element("p", { class: "alternative", "aria-live": "polite" });
  private readonly heights = new ScreenChart(() => this.chartHeight());
  private readonly spins = new ScreenChart(() => this.chartHeight());
  private portrait!: Portrait;
  private controls!: Controls;
  private readonly player = new Player(
    () => this.recording?.periods ?? 0,
    () => this.draw(),
  );
  private recording: Recording | null = null;
  private stage: Stage | null = null;
  private held: { height: number; angle: number } | null = null;
  private asked = "";
  private throwTold: Throw | null = null;
  /** Whether the motion was under way when the view was left. */
  private resumes = false;
  private mounted = false;
  private tracesDrawn = -1;
  private anew = true;
  private readonly draw = oncePerFrame(() => this.paint());

  mount(host: HTMLElement, context: Context): void {
    this.context = context;
    this.portrait = new Portrait(context, (phase, speed) => this.choose(phase, speed));
    this.controls = new Controls(
      this.player,
      () => this.period(),
      () => this.describe(),
    );
    attachKeys(
      this.scene.surface,
      this.player,
      () => this.controls.toggle(),
      () => this.describe(),
    );
    attachThrowing(this.scene.surface, {
      stage: () => this.stage,
      pose: () => this.moment(),
      system: () => context.state().system,
      phase: () => this.phase(),
      slowness: () => this.player.rate * this.period(),
      hold: (at) => {
        this.held = at;
        if (at !== null) this.player.pause();
        this.draw();
      },
      start: (thrown) => this.throwDisk(thrown),
    });
    const form = new ThrowForm(
      () => context.state().system,
      () => this.phase(),
      (thrown) => this.throwDisk(thrown),
    );
    host.append(
      this.controls.root,
      tossLayout({
        scene: [this.scene.root, this.gains, this.thrown, this.rounding.root, this.alternative],
        traces: [this.heights.root, this.spins.root],
        readings: [...this.readings.elements, form.root],
        portrait: this.portrait.layers.root,
      }),
    );
    this.mounted = true;
  }

  show(state: State): void {
    void this.rounding.show(this.context, state);
    this.tellThrow(state.thrown);
    // The same motion goes on where it was left, unless somebody had stopped it; another one begins anew.
    if (this.resumes && this.asked.startsWith(this.motion())) this.player.play();
    this.resumes = false;
    void this.fetch(FIRST_PERIODS);
    this.draw();
  }

  hide(): void {
    this.resumes = this.player.playing;
    this.player.pause();
    this.context.client.cancel("toss-motion");
    if (this.recording === null) this.asked = "";
  }

  redraw(): void {
    if (!this.mounted) return;
    this.tracesDrawn = -1;
    this.anew = true;
    this.draw();
  }

  offers(): Offer[] {
    if (this.recording === null) return [];
    return tossOffers(
      this.recording,
      this.player.now,
      { system: this.context.state().system, start: this.start() },
      () => this.portrait.axes(),
    );
  }

  private start(): MotionStart {
    const { start, thrown } = this.context.state();
    return thrown === null ? { kind: "impact", ...start } : { kind: "flight", ...thrown };
  }

  /** What tells motions apart. */
  private motion(): string {
    return JSON.stringify([this.context.state().system, this.start()]);
  }

  private period(): number {
    return (2 * Math.PI) / this.context.state().system.angular_frequency;
  }

  /** The platform's phase now (rad). */
  private phase(): number {
    const start = this.start();
    const first = start.kind === "impact" ? start.impact_phase : start.phase;
    const phase = first + this.player.now * 2 * Math.PI;
    return phase - 2 * Math.PI * Math.floor(phase / (2 * Math.PI));
  }

  /** Asks for a motion of so many periods. Another motion begins anew; more of the same goes on. */
  private async fetch(periods: number): Promise<void> {
    const { system } = this.context.state();
    const start = this.start();
    const motion = this.motion();
    const same = this.asked.startsWith(motion);
    const key = `${motion} ${periods}`;
    if (same && periods <= Number(this.asked.slice(motion.length))) return;
    this.asked = key;
    try {
      const response = await this.context.client.ask("toss-motion", {
        call: "motion",
        system: { ...system },
        start,
        periods,
        samples_per_period: SAMPLES_PER_PERIOD,
      });
      if (this.asked !== key) return;
      this.take(new Recording(response, (2 * Math.PI) / system.angular_frequency, periods, system), same);
    } catch (error) {
      if (this.asked === key) this.asked = "";
      tellFailure(this.context, error);
    }
  }

  private take(recording: Recording, same: boolean): void {
    this.recording = recording;
    this.tracesDrawn = -1;
    this.anew = true;
    if (!same) {
      this.player.now = 0;
      this.stage = null;
      const { thrown } = this.context.state();
      this.context.status(thrown === null ? "The motion begins with the shared impact." : describeThrow(thrown));
      // A motion is seen to move, unless that is unwelcome; then its first periods stand there at once.
      if (!prefersLessMotion()) this.player.play();
      else if (!this.player.playing) this.player.now = Math.min(7, recording.periods);
    }
    this.readings.balance(recording);
    this.describe();
    this.draw();
  }

  private moment(): Moment | null {
    const { recording } = this;
    if (recording === null) return null;
    const moment = recording.at(this.player.now * recording.period);
    return this.held === null ? moment : { ...moment, ...this.held, mode: "held" };
  }

  private paint(): void {
    const { recording, context, player } = this;
    if (!this.mounted) return;
    const resized = this.scene.fit();
    const moment = this.moment();
    if (recording === null || moment === null || this.scene.width < 60) return;
    if (resized || this.stage === null) this.setStage(recording);
    const { stage } = this;
    if (stage === null) return;
    const pen = this.scene.data(context.colour);
    paintScene(pen, stage, moment, context.colour);
    paintScale(pen, stage, this.scene.height, context.colour);
    paintPathInset(pen, recording, moment, context.colour, this.scene.width);
    this.controls.show(recording.periods);
    const impacts = recording.impactsUntil(player.now * recording.period);
    this.readings.show(moment, player.now, impacts, recording);
    this.showTraces(recording);
    this.portrait.show(recording, context.state().start, impacts, this.anew);
    this.anew = false;
    if (player.playing && player.now > recording.periods * (1 - AHEAD)) {
      if (recording.periods < MOST_PERIODS) void this.fetch(recording.periods * 2);
      else if (player.now >= recording.periods) this.stopAtEnd(recording);
    }
  }

  private stopAtEnd(recording: Recording): void {
    this.player.pause();
    this.controls.show(recording.periods);
    this.context.status(`The end of ${recording.periods} periods. Back to the start to see them again.`);
    this.describe();
  }

  private setStage(recording: Recording): void {
    const { gyration_radius, contact_radius, twist_amplitude } = this.context.state().system;
    // A homogeneous disk of that radius of gyration; friction acts inside of its rim.
    const radius = Math.max(Math.SQRT2 * gyration_radius, contact_radius);
    const heights = recording.extent("height", "platform_height");
    this.stage = stageOf(this.scene.width, this.scene.height, radius, heights, twist_amplitude);
    setText(
      this.gains,
      `${describeGains(this.stage)} ${describePath(recording.system)} Drag the disk upwards or sideways to throw it.`,
    );
  }

  /** Where the charts stand beside the scene, both are as high as it is. */
  private chartHeight(): number {
    const { width, height } = this.scene;
    const beside = this.heights.root.offsetTop < this.scene.root.offsetTop + height;
    if (beside && height > 480) return height / 2 - 30;
    return width < 480 ? 190 : 230;
  }

  private showTraces(recording: Recording): void {
    const { now } = this.player;
    if (now === this.tracesDrawn) return;
    this.tracesDrawn = now;
    const [heights, spins] = traces(recording, now);
    this.heights.show(heights, this.context.colour);
    this.spins.show(spins, this.context.colour);
  }

  private throwDisk(thrown: Throw): void {
    this.context.announce(describeThrow(thrown));
    this.context.change({ thrown });
  }

  /** That the disk was thrown stays to be read, with the way back to the shared impact. */
  private tellThrow(thrown: Throw | null): void {
    this.thrown.hidden = thrown === null;
    if (thrown === null || thrown === this.throwTold) return;
    this.throwTold = thrown;
    const back = button("Start with the shared impact", () => this.context.change({ thrown: null }), { class: "quiet" });
    this.thrown.replaceChildren(describeThrow(thrown), " ", back);
  }

  private choose(phasePeriods: number, speed: number): void {
    const start = { impact_phase: phasePeriods * 2 * Math.PI, normalised_speed: Math.max(speed, 1e-9) };
    this.context.change({ start });
    const at = `${plain(phasePeriods, 3)} periods and a normalised speed of ${plain(speed, 3)}`;
    this.context.status(`The motion starts with an impact at ${at}.`);
  }

  /** Not while it moves: a screen reader would never come to an end. */
  private describe(): void {
    const moment = this.moment();
    const { recording, player } = this;
    if (moment === null || recording === null) return;
    const impacts = recording.impactsUntil(player.now * recording.period);
    const text = describeMoment(moment, player.now, impacts, recording);
    setText(this.alternative, player.playing ? "" : text);
  }
}

export const view: View = new TossView();
