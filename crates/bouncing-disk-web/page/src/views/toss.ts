/** Toss and bounce: the motion itself, from the engine's own trajectory. */

import { Cancelled, type Context, type Offer, type State, type View } from "../contract";
import { clamp } from "../drawing/axes";
import { chartOffers, ScreenChart, type Chart } from "../drawing/chart";
import { ONE_COLUMN, PARTS, plotOffers, tableOffers, type Basis } from "../drawing/files";
import { Layers, type Point } from "../drawing/window";
import { button, div, element, oncePerFrame, section, setText } from "../elements";
import { say, WORDS } from "../words";
import type { FlightStart, MotionJson, MotionStart } from "../protocol";
import { motionStartOf, roundingCaution, tellFailure } from "./asking";
import { Controls, Player } from "./toss/player";
import { paintImpacts, Portrait } from "./toss/portrait";
import { Readings } from "./toss/readings";
import { Recording, traces, type Moment } from "./toss/recording";
import { describePath, paintPath, paintPathInset, pathAxes, Stage } from "./toss/scene";
import { Sound } from "./toss/sound";
import { attachThrowing, describeThrow } from "./toss/throwing";

const TEXTS = WORDS.toss;

/** The slowest rotor of Fig. 9 takes 40 periods to stop. */
const FIRST_PERIODS = 48;
const MOST_PERIODS = 1280;
const SAMPLES_PER_PERIOD = 64;
/** Periods of a chart. */
const SHOWN = 8;
/** More of the motion is asked for when less than this share of it is still to be shown. */
const AHEAD = 0.35;

const COLUMNS = [
  "time_s", "height_m", "angle_rad", "axial_velocity_m_per_s", "angular_speed_rad_per_s", "platform_height_m",
  "platform_angle_rad", "platform_velocity_m_per_s", "platform_angular_speed_rad_per_s", "mode",
]; // prettier-ignore

/** Both charts together are as high as the scene, beside it or below it. */
const chartHeight = (): number => clamp(window.innerHeight * 0.235, 150, 480);

export class TossView implements View {
  private readonly scene = new Layers("picture-scene", TEXTS.scene);
  private readonly readings = new Readings();
  private readonly gains = element("p", { class: "remark" });
  private readonly throwWords = element("span");
  private readonly thrown = element("p", { class: "remark", hidden: true }, this.throwWords, " ");
  private readonly rounding = roundingCaution("toss-rest", WORDS.asking.rounding_toss);
  private readonly alternative = element("p", { class: "hidden", "aria-live": "polite" });
  private readonly heights = new ScreenChart(chartHeight);
  private readonly spins = new ScreenChart(chartHeight);
  private readonly portrait = new Portrait((at) => this.choose(at));
  private readonly player = new Player(() => this.recording?.periods ?? 0, () => this.draw()); // prettier-ignore
  private readonly controls = new Controls(this.scene.surface, this.player, {
    period: () => this.period(),
    heard: (on) => this.sound.switch(on),
  });
  private readonly sound = new Sound();
  private recording: Recording | null = null;
  private stage: Stage | null = null;
  private held: { height: number; angle: number } | null = null;
  private asked = "";
  /** The motion that is recorded. */
  private recorded = "";
  private tracesDrawn = -1;
  private anew = true;
  private readonly draw = oncePerFrame(() => this.paint());

  constructor(
    host: HTMLElement,
    private readonly context: Context,
  ) {
    const throwing = {
      playing: () => this.player.playing,
      stage: () => this.stage,
      pose: () => this.moment(),
      system: () => context.state().system,
      phase: () => this.phase(),
      slowness: () => this.player.rate * this.period(),
      hold: (at: typeof this.held) => {
        this.held = at;
        if (at !== null) this.player.pause();
        this.draw();
      },
      start: (thrown: FlightStart) => context.change({ thrown }),
    };
    attachThrowing(this.scene.surface, throwing);
    this.thrown.append(button(TEXTS.back_to_impact, () => context.change({ thrown: null })));
    this.player.played = (...periods) => {
      const { recording } = this;
      const [from, to] = periods.map((time) => recording?.impactsUntil(time * recording.period));
      const passed = recording?.impacts.slice(from, to) ?? [];
      const [fastest] = passed.sort((one, other) => other.normalised_speed - one.normalised_speed);
      if (fastest !== undefined) this.sound.play(fastest);
    };
    const controls = element("div", {}, this.controls.root, this.thrown, this.rounding.root, this.alternative);
    const charts = section(TEXTS.traces, null, this.heights.root, this.spins.root);
    const readings = section(TEXTS.readings, "panel", ...this.readings.elements, this.gains);
    const key = element("p", { class: "remark" }, TEXTS.impacts_key);
    const parts = [element("h3", {}, TEXTS.impacts), this.portrait.picture.layers.root, this.portrait.reading, key];
    host.append(div("toss", this.scene.root, controls, charts, section(TEXTS.portrait, null, ...parts), readings));
  }

  show(state: State, fresh: boolean): void {
    if (fresh) this.asked = ""; // A motion that was seen before begins anew, too.
    this.rounding.show(this.context, state);
    this.tellThrow(state.thrown);
    void this.fetch(FIRST_PERIODS);
    this.draw();
  }

  hide(): void {
    this.player.pause();
    this.context.client.cancel("toss-motion");
    if (this.recording === null) this.asked = "";
  }

  redraw(): void {
    Object.assign(this, { tracesDrawn: -1, anew: true });
    this.draw();
  }

  offers(): Offer[] {
    const { recording } = this;
    // That of another state is never given under this one.
    if (recording === null || this.recorded !== this.motion()) return [];
    const charts = this.charts(recording, Math.max(this.player.now, Math.min(recording.periods, SHOWN)));
    const state = this.context.state();
    const { thrown, system } = state;
    const own: Basis = { state, names: PARTS.motion };
    const basis = thrown === null ? own : { ...own, names: PARTS.system, more: [describeThrow(thrown)] };
    const parameters = { system, start: this.start(), periods: recording.periods };
    const size = { width: ONE_COLUMN, height: ONE_COLUMN * 0.8 };
    return [
      ...tableOffers({ name: TEXTS.files.motion, parameters, columns: COLUMNS, rows: () => recording.table() }),
      ...tableOffers({
        name: TEXTS.files.impacts,
        parameters,
        columns: ["time_s", "impact_phase_rad", "normalised_speed"],
        rows: () => recording.impacts.map(({ time, phase, normalised_speed }) => [time, phase, normalised_speed]),
      }),
      ...chartOffers(TEXTS.files.traces, TEXTS.titles.traces, charts, ONE_COLUMN * 0.6, basis),
      ...plotOffers({
        name: TEXTS.files.path,
        title: TEXTS.titles.path,
        basis: { state, names: PARTS.platform },
        ...size,
        axes: pathAxes(recording.system),
        paint: (pen, plot) => paintPath(pen, plot, recording),
      }),
      ...plotOffers({
        name: TEXTS.files.portrait,
        title: TEXTS.titles.portrait,
        basis,
        ...size,
        axes: this.portrait.axes(),
        paint: (pen, plot) => paintImpacts(pen, plot, recording.impacts, 1.4),
      }),
    ];
  }

  private start(): MotionStart {
    return motionStartOf(this.context.state());
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
    const phase = (start.kind === "impact" ? start.impact_phase : start.phase) + this.player.now * 2 * Math.PI;
    return phase - 2 * Math.PI * Math.floor(phase / (2 * Math.PI));
  }

  /** Asks for a motion of so many periods. Another motion begins anew; more of the same goes on. */
  private async fetch(periods: number): Promise<void> {
    const { system } = this.context.state();
    const motion = this.motion();
    const same = this.asked.startsWith(motion);
    const key = `${motion} ${periods}`;
    if (same && periods <= Number(this.asked.slice(motion.length))) return;
    this.asked = key;
    try {
      const request = { system, start: this.start(), periods, samples_per_period: SAMPLES_PER_PERIOD };
      const response = await this.context.client.ask<MotionJson>("toss-motion", { call: "motion", ...request });
      this.take(new Recording(response, periods, system), same);
    } catch (error) {
      if (this.asked === key) this.asked = "";
      if (!(error instanceof Cancelled)) {
        Object.assign(this, { recording: null, stage: null });
        this.player.pause();
        this.scene.data();
      }
      tellFailure(this.context, error);
    }
  }

  private take(recording: Recording, same: boolean): void {
    Object.assign(this, { recording, recorded: this.motion(), tracesDrawn: -1, anew: true });
    if (!same) {
      this.player.now = 0;
      this.stage = null;
      const { thrown } = this.context.state();
      this.context.status(thrown === null ? TEXTS.begins : describeThrow(thrown));
      // A motion is seen to move, unless that is unwelcome; then its first periods stand there at once.
      if (!window.matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.play();
      else if (!this.player.playing) this.player.now = Math.min(7, recording.periods);
    }
    this.readings.balance(recording);
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
    const resized = this.scene.fit();
    const moment = this.moment();
    if (recording === null || moment === null || this.scene.width < 60) return;
    if (resized || this.stage === null) this.stage = this.stageOf(recording);
    const pen = this.scene.data();
    this.stage.paint(pen, moment);
    paintPathInset(pen, recording, moment, this.scene.width, this.stage.pixels);
    this.controls.show(recording.periods);
    const impacts = recording.impactsUntil(player.now * recording.period);
    this.readings.show(moment, player.now, impacts, recording);
    // Not while it moves: a screen reader would never come to an end.
    setText(this.alternative, player.playing || this.held !== null ? "" : this.readings.facts.text());
    this.showTraces(recording);
    this.portrait.show(recording, context.state().start, impacts, this.anew);
    this.anew = false;
    const { periods } = recording;
    if (!player.playing || player.now <= periods * (1 - AHEAD)) return;
    if (periods < MOST_PERIODS) void this.fetch(periods * 2);
    else if (player.now >= periods) {
      player.pause();
      this.controls.show(periods);
      context.status(say(TEXTS.ends, { periods }));
    }
  }

  private stageOf(recording: Recording): Stage {
    const { gyration_radius, contact_radius, twist_amplitude } = this.context.state().system;
    // A homogeneous disk of that radius of gyration; friction acts inside of its rim.
    const radius = Math.max(Math.SQRT2 * gyration_radius, contact_radius);
    const heights = recording.extent("height", "platform_height");
    const stage = new Stage(this.scene.width, this.scene.height, radius, heights, twist_amplitude);
    const words = [stage.describe(), describePath(recording.system), TEXTS.drag];
    if (recording.system.contact_time > 0) words.push(TEXTS.contact);
    setText(this.gains, words.join(" "));
    return stage;
  }

  private showTraces(recording: Recording): void {
    const { now } = this.player;
    if (now === this.tracesDrawn) return;
    this.tracesDrawn = now;
    const [heights, spins] = this.charts(recording, now);
    this.heights.show(heights);
    this.spins.show(spins);
  }

  /** The last few periods up to a time. */
  private charts(motion: Recording, now: number): [Chart, Chart] {
    const from = Math.max(0, now - SHOWN + 1);
    return traces([{ motion, disk: TEXTS.disk, platform: TEXTS.platform }], [from, from + SHOWN], now);
  }

  /** That the disk was thrown stays to be read, with the way back to the shared impact. */
  private tellThrow(thrown: FlightStart | null): void {
    this.thrown.hidden = thrown === null;
    setText(this.throwWords, thrown === null ? "" : describeThrow(thrown));
  }

  private choose([phase, speed]: Point): void {
    this.context.change({ start: { impact_phase: phase * 2 * Math.PI, normalised_speed: Math.max(speed, 1e-9) } });
  }
}
