/** The sound of the impacts: each is a short tone, higher and louder the faster it is, so that a doubled period is heard. */

import type { Impact } from "./recording";

/** Hertz of an impact whose normalised speed is 1. */
const PITCH = 320;
const HIGHEST = 3000;
/** The normalised speed from which on a tone is as loud as it can be, and the share of the full scale that it has then. */
const LOUD = 2;
const LOUDEST = 0.2;
/** How long a tone sounds (s): those of four frames, sixty of which are in a second, sound together. */
const LENGTH = 0.06;

export class Sound {
  private context: AudioContext | null = null;

  /** On from a click on, as browsers ask for. */
  switch(on: boolean): void {
    if (on) this.context ??= new AudioContext();
    void (on ? this.context?.resume() : this.context?.suspend());
  }

  /** The impact at this normalised speed, the fastest one of a frame. */
  play({ normalised_speed: speed }: Impact): void {
    const { context } = this;
    if (context?.state !== "running" || speed <= 0) return;
    const tone = new OscillatorNode(context, { frequency: Math.min(PITCH * speed, HIGHEST) });
    const gain = new GainNode(context);
    gain.gain.setValueAtTime(LOUDEST * Math.min(speed / LOUD, 1) ** 2, context.currentTime);
    gain.gain.linearRampToValueAtTime(0, context.currentTime + LENGTH);
    tone.connect(gain).connect(context.destination);
    tone.start();
    tone.stop(context.currentTime + LENGTH);
  }
}
