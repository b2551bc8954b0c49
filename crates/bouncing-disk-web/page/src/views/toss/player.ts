/** The clock of the animation: how far it is, and how fast it goes. */

/** A frame that took longer than this was not seen; the motion does not jump ahead. */
const LONGEST_FRAME = 0.1;

export class Player {
  /** Platform periods since the start of the motion. */
  now = 0;
  /** Platform periods in a second of ours. */
  rate = 0.6;
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
      this.now = Math.min(this.now + passed * this.rate, this.end());
      this.tick();
    };
    this.frame = requestAnimationFrame(step);
  }

  pause(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  seek(periods: number): void {
    this.now = Math.min(Math.max(periods, 0), this.end());
    this.tick();
  }
}
