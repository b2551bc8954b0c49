/** Play and pause, slow motion and scrubbing. */

import { button, element, setText } from "../../drawing/elements";
import { plain } from "../../drawing/numbers";
import type { Player } from "./player";

/** Platform periods in a second of ours, at both ends of the slider. */
const SLOWEST = 0.02;
const FASTEST = 20;
const STEPS = 200;

export class Controls {
  readonly root: HTMLElement;
  private readonly playButton = button("Play", () => this.toggle(), { class: "play" });
  private readonly place = element("input", { type: "range", min: 0, step: "any", "aria-label": "Time in periods" });
  private readonly speed = element("input", {
    type: "range",
    min: 0,
    max: STEPS,
    step: 1,
    "aria-label": "Speed of the animation",
  });
  private readonly told = element("output", { class: "speed" });

  /** `period` is that of the platform in seconds. */
  constructor(
    private readonly player: Player,
    private readonly period: () => number,
    private readonly paused: () => void,
  ) {
    this.speed.value = String(Math.round((STEPS * Math.log(player.rate / SLOWEST)) / Math.log(FASTEST / SLOWEST)));
    this.speed.addEventListener("input", () => {
      player.rate = SLOWEST * (FASTEST / SLOWEST) ** (Number(this.speed.value) / STEPS);
      this.show(Number(this.place.max));
    });
    this.place.addEventListener("input", () => {
      player.pause();
      player.seek(Number(this.place.value));
      this.show(Number(this.place.max));
      this.paused();
    });
    this.root = element(
      "div",
      { class: "bar controls", role: "group", "aria-label": "Animation" },
      this.playButton,
      button("|◀", () => player.seek(0), { "aria-label": "Back to the start", title: "Back to the start (Home)" }),
      element("label", { class: "grow" }, "Time", this.place),
      element("label", {}, "Speed", this.speed),
      this.told,
    );
  }

  toggle(): void {
    if (this.player.playing) this.player.pause();
    else this.player.play();
    this.show(Number(this.place.max));
    if (!this.player.playing) this.paused();
  }

  /** Follows the player; `end` is how far one can scrub, in periods. */
  show(end: number): void {
    const { player } = this;
    setText(this.playButton, player.playing ? "Pause" : "Play");
    if (this.place.max !== String(end)) this.place.max = String(end);
    if (document.activeElement !== this.place || player.playing) this.place.value = String(player.now);
    this.place.setAttribute("aria-valuetext", `${player.now.toFixed(2)} periods`);
    const real = player.rate * this.period();
    const ratio = real < 1 ? `slowed ${plain(1 / real, 2)} times` : `quickened ${plain(real, 2)} times`;
    setText(this.told, `${plain(player.rate, 2)} periods/s, ${Math.abs(real - 1) < 0.05 ? "as it is" : ratio}`);
  }
}
