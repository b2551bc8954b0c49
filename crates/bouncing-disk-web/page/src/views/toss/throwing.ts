/** Throwing the disk by dragging it; a link may have a throw with any numbers. */

import { clamp } from "../../drawing/axes";
import { placeOn } from "../../elements";
import { plain, quantity } from "../../numbers";
import type { FlightStart, SystemParameters } from "../../protocol";
import { say, WORDS } from "../../words";
import type { Pose, Stage } from "./scene";

/** The longest flight that a throw may make, in periods. */
const LONGEST_FLIGHT = 12;
const LONGEST_PAUSE = 150;

interface ThrowHost {
  playing(): boolean;
  stage(): Stage | null;
  pose(): Pose | null;
  system(): Readonly<SystemParameters>;
  /** Phase of the platform (rad), and seconds of the motion in one of ours. */
  phase(): number;
  slowness(): number;
  /** The disk is held at this height (m) and angle while it is dragged; null: let go. */
  hold(at: { height: number; angle: number } | null): void;
  start(thrown: FlightStart): void;
}

type Place = ReturnType<typeof placeOn> & { readonly time: number };

export function attachThrowing(surface: HTMLElement, host: ThrowHost): void {
  let held: { stage: Stage; from: Place; pose: Pose; trail: Place[] } | null = null;
  const place = (event: PointerEvent) => ({ ...placeOn(surface, event), time: event.timeStamp });
  const recent = ({ trail }: NonNullable<typeof held>, at: Place) =>
    trail.filter(({ time }) => at.time - time < LONGEST_PAUSE);
  const heldAt = ({ stage, from, pose }: NonNullable<typeof held>, at: Place) => ({
    height: Math.max(pose.height + stage.metresOf(from.y - at.y), pose.platform_height),
    angle: pose.angle + stage.radiansOf(at.x - from.x),
  });
  surface.addEventListener("pointerdown", (event) => {
    const stage = host.stage();
    const pose = host.pose();
    const swiped = event.pointerType === "touch" && host.playing();
    if (stage === null || pose === null || event.button > 0 || swiped) return;
    const from = place(event);
    const [x, y] = stage.placeOfDisk(pose);
    if (Math.abs(from.x - x) > stage.pixels || Math.abs(from.y - y) > Math.max(0.6 * stage.pixels, 24)) return;
    held = { stage, from, pose, trail: [from] };
    surface.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  // A finger drags a disk that is paused; elsewhere, and while it moves, the same movement scrolls the page.
  const keep = (event: TouchEvent) => {
    if (held !== null) event.preventDefault();
  };
  surface.addEventListener("touchstart", keep, { passive: false });
  surface.addEventListener("pointermove", (event) => {
    if (held === null) return;
    const at = place(event);
    held.trail = [...recent(held, at), at];
    host.hold(heldAt(held, at));
  });
  surface.addEventListener("pointerup", (event) => {
    if (held === null) return;
    const at = place(event);
    const { stage, from, pose } = held;
    const { height } = heldAt(held, at);
    const [first = at] = recent(held, at);
    held = null;
    host.hold(null);
    if (Math.hypot(at.x - from.x, at.y - from.y) < 4) return;
    const seconds = Math.max((at.time - first.time) / 1000, 1e-3) * host.slowness();
    const thrown = {
      phase: host.phase(),
      gap: height - pose.platform_height,
      relative_velocity: stage.metresOf(first.y - at.y) / seconds,
      angular_speed: stage.radiansOf(at.x - first.x) / seconds,
    };
    host.start(bounded(host.system(), thrown));
  });
  surface.addEventListener("pointercancel", () => {
    held = null;
    host.hold(null);
  });
}

/** A throw that comes down again within some periods. */
function bounded({ angular_frequency, preload_acceleration: g }: SystemParameters, thrown: FlightStart): FlightStart {
  const time = (LONGEST_FLIGHT * 2 * Math.PI) / angular_frequency;
  const gap = clamp(thrown.gap, 0, (g * time ** 2) / 8);
  const fastest = (g * time) / 4;
  const relative_velocity = clamp(thrown.relative_velocity, gap > 0 ? -fastest : fastest * 1e-9, fastest);
  return { ...thrown, gap, relative_velocity };
}

export function describeThrow({ gap, relative_velocity, angular_speed }: FlightStart): string {
  const [height, velocity] = [quantity(gap, "m"), quantity(Math.abs(relative_velocity), "m/s")];
  const text = relative_velocity < 0 ? WORDS.toss.thrown_down : WORDS.toss.thrown_up;
  return say(text, { gap: height, velocity, speed: plain(angular_speed, 3) });
}
