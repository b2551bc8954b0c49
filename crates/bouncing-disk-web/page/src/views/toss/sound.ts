/** The sound of the impacts: each is a short tone, higher and louder the faster it is, so that a doubled period is heard. */

import type { Impact } from "./recording";

/** Hertz of an impact whose normalised speed is 1. */
const PITCH = 320;
const HIGHEST = 3000;
/** The normalised speed from which on a tone is as loud as it can be. */
const LOUD = 2;
/** The share of the full scale that a frame's tones may have together: those of the frame before still sound. */
const LOUDEST = 0.25;
/** How long a tone sounds (s). */
const LENGTH = 0.06;
/** Tones of a frame: of a chatter the loudest ones are heard. */
const MOST = 4;
/** Softer ones, which end a chatter, are not heard anyhow. */
const SOFTEST = 1e-3;

const loudness = ({ normalised_speed }: Impact): number => Math.min(normalised_speed / LOUD, 1) ** 2;

export class Sound {
  private context: AudioContext | null = null;

  /** On from a click on, as browsers ask for. */
  switch(on: boolean): void {
    if (on) this.context ??= new AudioContext();
    void (on ? this.context?.resume() : this.context?.suspend());
  }

  /** The impacts of a frame of so many seconds, in which the time of the motion went from `from` to `to`. */
  play(impacts: readonly Impact[], from: number, to: number, seconds: number): void {
    const { context } = this;
    if (context?.state !== "running") return;
    const heard = impacts.filter((impact) => loudness(impact) > SOFTEST);
    heard.sort((one, other) => other.normalised_speed - one.normalised_speed).splice(MOST);
    for (const impact of heard) {
      const at = context.currentTime + ((impact.time - from) / (to - from)) * seconds;
      const tone = new OscillatorNode(context, { frequency: Math.min(PITCH * impact.normalised_speed, HIGHEST) });
      const gain = new GainNode(context, { gain: 0 });
      gain.gain.setValueAtTime((LOUDEST * loudness(impact)) / heard.length, at);
      gain.gain.exponentialRampToValueAtTime(SOFTEST * SOFTEST, at + LENGTH);
      tone.connect(gain).connect(context.destination);
      tone.start(at);
      tone.stop(at + LENGTH);
    }
  }
}
