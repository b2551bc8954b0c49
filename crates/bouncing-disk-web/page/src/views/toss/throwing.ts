/** Throwing the disk by dragging it. */

import type { Throw } from "../../contract";
import { quantity, plain } from "../../drawing/numbers";
import { clamp } from "../../drawing/scale";
import type { SystemParameters } from "../../protocol";
import { diskPlace, metresOf, radiansOf } from "./scene";
import type { Pose, Stage } from "./scene";

/** The longest flight that a throw may make, in periods. */
const LONGEST_FLIGHT = 12;
const LONGEST_PAUSE = 150;

export interface ThrowHost {
  stage(): Stage | null;
  pose(): Pose | null;
  system(): Readonly<SystemParameters>;
  /** Phase of the platform (rad), and seconds of the motion in one of ours. */
  phase(): number;
  slowness(): number;
  /** The disk is held at this height (m) and angle while it is dragged; null: let go. */
  hold(at: { height: number; angle: number } | null): void;
  start(thrown: Throw): void;
}

interface Held {
  readonly x: number;
  readonly y: number;
  readonly pose: Pose;
  trail: { x: number; y: number; time: number }[];
}

/** Makes the disk on a canvas something that can be dragged. */
export function attachThrowing(surface: HTMLElement, host: ThrowHost): void {
  let held: Held | null = null;
  const place = (event: PointerEvent) => {
    const box = surface.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top, time: event.timeStamp };
  };
  surface.addEventListener("pointerdown", (event) => {
    const stage = host.stage();
    const pose = host.pose();
    if (stage === null || pose === null || event.button > 0) return;
    const at = place(event);
    const [x, y] = diskPlace(stage, pose);
    if (Math.abs(at.x - x) > stage.pixels || Math.abs(at.y - y) > Math.max(0.6 * stage.pixels, 24)) return;
    held = { x: at.x, y: at.y, pose, trail: [at] };
    surface.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  // A finger on the disk drags it; beside it, the same movement scrolls the page.
  const keep = (event: TouchEvent) => {
    if (held !== null) event.preventDefault();
  };
  surface.addEventListener("touchstart", keep, { passive: false });
  surface.addEventListener("pointermove", (event) => {
    const stage = host.stage();
    if (held === null || stage === null) return;
    const at = place(event);
    held.trail = [...held.trail.filter(({ time }) => at.time - time < LONGEST_PAUSE), at];
    host.hold(heldAt(held, stage, at));
  });
  surface.addEventListener("pointerup", (event) => {
    const stage = host.stage();
    if (held === null || stage === null) return;
    const at = place(event);
    const known = held;
    held = null;
    host.hold(null);
    if (Math.hypot(at.x - known.x, at.y - known.y) < 4) return;
    const [first = at] = known.trail.filter(({ time }) => at.time - time < LONGEST_PAUSE);
    const seconds = Math.max((at.time - first.time) / 1000, 1e-3) * host.slowness();
    const moving = at.time > first.time;
    const { height } = heldAt(known, stage, at);
    host.start(
      bounded(host.system(), {
        phase: host.phase(),
        gap: height - known.pose.platform_height,
        relative_velocity: moving ? metresOf(stage, first.y - at.y) / seconds : 0,
        angular_speed: moving ? radiansOf(stage, at.x - first.x) / seconds : 0,
      }),
    );
  });
  surface.addEventListener("pointercancel", () => {
    held = null;
    host.hold(null);
  });
}

function heldAt({ x, y, pose }: Held, stage: Stage, at: { x: number; y: number }): { height: number; angle: number } {
  return {
    height: Math.max(pose.height + metresOf(stage, y - at.y), pose.platform_height),
    angle: pose.angle + radiansOf(stage, at.x - x),
  };
}

/** A throw that comes down again within some periods. */
export function bounded(system: Readonly<SystemParameters>, thrown: Throw): Throw {
  const { angular_frequency, preload_acceleration: g } = system;
  const time = (LONGEST_FLIGHT * 2 * Math.PI) / angular_frequency;
  const gap = clamp(thrown.gap, 0, (g * time ** 2) / 8);
  const fastest = (g * time) / 4;
  const relative_velocity = clamp(thrown.relative_velocity, gap > 0 ? -fastest : fastest * 1e-9, fastest);
  return { ...thrown, gap, relative_velocity };
}

export function describeThrow({ gap, relative_velocity, angular_speed }: Throw): string {
  const way = relative_velocity < 0 ? "downwards" : "upwards";
  return (
    `Thrown ${quantity(gap, "m")} above the platform, ${quantity(Math.abs(relative_velocity), "m/s")} ${way} ` +
    `relative to it, turning at ${plain(angular_speed, 3)} rad/s.`
  );
}
