/** The clock of the animation, and its controls: play and pause, slow motion and scrubbing, also by keyboard. */

import { button, element, setText } from "../../elements";
import { plain } from "../../numbers";
import { say, WORDS } from "../../words";

const TEXT = WORDS.player;

/** A frame that took longer than this was not seen; the motion does not jump ahead. */
const LONGEST_FRAME = 0.1;

export class Player {
  /** Platform periods since the start of the motion. */
  now = 0;
  /** Platform periods in a second of ours. */
  rate = 0.6;
  /** Called for what goes by while it plays, and not where somebody jumps (periods). */
  played: (from: number, to: number) => void = () => {};
  private frame = 0;
  private last = 0;

  /** `tick` is called after each step; `end` says how far there is something to show. */
  constructor(
    private readonly end: () => number,
    private readonly tick: () => void,
  ) {}

  get playing(): boolean {
    return this.frame !== 0;
  }

  play(): void {
    if (this.playing) return;
    this.last = performance.now();
    const step = (time: number) => {
      const passed = Math.min(Math.max((time - this.last) / 1000, 0), LONGEST_FRAME);
      this.last = time;
      this.frame = requestAnimationFrame(step);
      const from = this.now;
      this.seek(from + passed * this.rate);
      if (this.now > from) this.played(from, this.now);
    };
    this.frame = requestAnimationFrame(step);
  }

  pause(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.tick();
  }

  seek(periods: number): void {
    this.now = Math.min(Math.max(periods, 0), this.end());
    this.tick();
  }
}

/** Platform periods in a second of ours, at both ends of the slider. */
const SLOWEST = 0.02;
const FASTEST = 20;
const STEPS = 200;

export class Controls {
  readonly root: HTMLElement;
  private readonly playButton = button(TEXT.play, () => this.toggle(), { class: "play" });
  private readonly place = element("input", {
    type: "range", min: 0, step: "any", "aria-label": TEXT.time_periods, oninput: () => this.scrub(),
  }); // prettier-ignore
  private readonly told = element("output", { class: "speed" });
  private readonly sound = element("input", { type: "checkbox", onchange: () => this.host.heard(this.sound.checked) });

  constructor(
    surface: HTMLElement,
    private readonly player: Player,
    /** The period of the platform (s), and what switches the sound. */
    private readonly host: { period(): number; heard(on: boolean): void },
  ) {
    const speed = element("input", { type: "range", min: 0, max: STEPS, step: 1, "aria-label": TEXT.speed_of });
    speed.value = String(Math.round((STEPS * Math.log(player.rate / SLOWEST)) / Math.log(FASTEST / SLOWEST)));
    speed.addEventListener("input", () => {
      player.rate = SLOWEST * (FASTEST / SLOWEST) ** (Number(speed.value) / STEPS);
      this.show(Number(this.place.max));
    });
    this.root = element(
      "div",
      { class: "bar controls", role: "group", "aria-label": TEXT.animation },
      this.playButton,
      button("|◀", () => player.seek(0), { "aria-label": TEXT.start, title: TEXT.start_title }),
      element("label", { class: "grow" }, TEXT.time, this.place),
      element("label", {}, TEXT.speed, speed),
      element("label", { title: WORDS.toss.sound_hint }, this.sound, WORDS.toss.sound),
      this.told,
    );
    surface.addEventListener("keydown", (event) => this.key(event));
  }

  /** Follows the player; `end` is how far one can scrub, in periods. */
  show(end: number): void {
    const { player } = this;
    setText(this.playButton, player.playing ? TEXT.pause : TEXT.play);
    if (this.place.max !== String(end)) this.place.max = String(end);
    if (document.activeElement !== this.place || player.playing) this.place.value = String(player.now);
    this.place.setAttribute("aria-valuetext", say(TEXT.aria_time, { periods: player.now.toFixed(2) }));
    const real = player.rate * this.host.period();
    setText(this.told, say(real < 1 ? TEXT.slowed : TEXT.quickened, { times: plain(real < 1 ? 1 / real : real, 2) }));
  }

  private toggle(): void {
    if (this.player.playing) this.player.pause();
    else this.player.play();
    this.show(Number(this.place.max));
  }

  private scrub(): void {
    this.player.pause();
    this.player.seek(Number(this.place.value));
    this.show(Number(this.place.max));
  }

  /** For as long as the picture has the focus. */
  private key(event: KeyboardEvent): void {
    const { player } = this;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.key === " ") this.toggle();
    else if (step !== undefined || event.key === "Home") {
      if (step !== undefined) player.pause();
      player.seek(step === undefined ? 0 : player.now + step * (event.shiftKey ? 1 : 1 / 16));
    } else return;
    event.preventDefault();
  }
}
