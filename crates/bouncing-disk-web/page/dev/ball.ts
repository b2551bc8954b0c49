/**
 * A rough bouncing ball, so that the page can be developed and tested without the module. It steps and bisects; its
 * numbers are good enough for a picture, and nothing of it is shipped.
 */

export interface Bounce {
  /** Radians, not reduced. */
  phase: number;
  /** Relative speed of the impact in units of A omega. */
  speed: number;
}

/** The impact after this one, in units of 1/omega and g/omega²; `null` where the ball comes to rest for good. */
export function next(forcing: number, restitution: number, { phase, speed }: Bounce): Bounce | null {
  const P = Math.PI * forcing;
  let tau = phase;
  let up = restitution * speed * P;
  if (up < 1e-3) {
    // Put on the platform, and launched where that falls away.
    if (P <= 1) return null;
    const launch = Math.asin(1 / P);
    tau += ((((launch - tau) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) + 1e-3;
    up = 1e-6;
  }
  const gap = (h: number) => (up + P * Math.cos(tau)) * h - (h * h) / 2 - P * (Math.sin(tau + h) - Math.sin(tau));
  const longest = 2 * (up + P) + 4;
  const step = Math.min(0.1, Math.max(1e-3, up / 4));
  let h = step;
  while (gap(h) > 0 && h < longest) h += step;
  let [low, high] = [h - step, h];
  for (let round = 0; round < 50; round++) {
    const middle = (low + high) / 2;
    if (gap(middle) > 0) low = middle;
    else high = middle;
  }
  const fall = up + P * Math.cos(tau) - high - P * Math.cos(tau + high);
  return { phase: tau + high, speed: P > 0 ? Math.max(0, -fall) / P : 0 };
}

/** The impacts from a start, the start among them. */
export function orbit(forcing: number, restitution: number, start: Bounce, count: number): Bounce[] {
  const impacts = [start];
  while (impacts.length < count) {
    const last = next(forcing, restitution, impacts[impacts.length - 1] as Bounce);
    if (last === null) break;
    impacts.push(last);
  }
  return impacts;
}
