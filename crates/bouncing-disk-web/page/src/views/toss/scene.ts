/** Disk and platform in perspective, and the path of a point of the platform, drawn on a canvas. */

import { clamp, padded, pixelX, pixelY, prefixed, roundUp, type Axes, type Plot } from "../../drawing/axes";
import type { Pen } from "../../drawing/pen";
import { plain, quantity } from "../../numbers";
import type { Range, SystemParameters } from "../../protocol";
import { say, WORDS } from "../../words";
import type { Moment, Recording } from "./recording";

/** Where both are: heights in m, angles in rad. */
export type Pose = Pick<Moment, "height" | "angle" | "platform_height" | "platform_angle">;

const ELEVATION = 0.42;
const DISTANCE = 7;
const PLATFORM = 1.22;
const THICKNESS = 0.1;
const CORNERS = 72;

/** How lengths and angles are enlarged, and where the picture has its middle. */
export class Stage {
  /** How many pixels the radius of the disk has. */
  readonly pixels: number;
  /** Small motions are enlarged until they can be seen: by 1, 2, 5, 10, ... */
  private readonly heightGain: number;
  private readonly angleGain: number;
  /** The plane of the middle of the platform's motion, in radii below the centre. */
  private readonly ground: number;

  constructor(
    private readonly width: number,
    private readonly height: number,
    /** Of the disk (m). */
    private readonly radius: number,
    heights: Range,
    twist: number,
  ) {
    const span = Math.max(heights[1] - heights[0], 1e-300) / radius;
    this.heightGain = span >= 0.5 && span <= 4 ? 1 : roundDown(1.8 / span);
    this.angleGain = twist >= 0.2 || twist === 0 ? 1 : roundDown(0.5 / twist);
    const shown = span * this.heightGain;
    this.pixels = Math.max(Math.min(width / (2 * PLATFORM + 0.7), height / (shown + 1.9)), 10);
    this.ground = this.radii(heights[0]) + shown / 2 - 0.05;
  }

  paint(pen: Pen, pose: Pose): void {
    const platform = this.radii(pose.platform_height);
    const disk = this.radii(pose.height);
    const turn = pose.platform_angle * this.angleGain;
    this.cylinder(pen, PLATFORM, platform - THICKNESS, "--platform");
    this.spokes(pen, platform, turn, PLATFORM, "--platform-side", 6);
    this.wedge(pen, platform, turn, [0.98, PLATFORM, 0.09], "--platform-mark");
    pen.path(this.ring(1, platform), { fill: "--platform-side", opacity: 0.45, close: true });
    this.cylinder(pen, 1, disk, "--disk");
    const top = disk + THICKNESS;
    const spin = pose.angle * this.angleGain;
    this.spokes(pen, top, spin, 1, "--disk-side", 4);
    this.wedge(pen, top, spin, [0.25, 0.96, 0.07], "--disk-mark");
    this.paintScale(pen);
  }

  /** A bar whose length is true on the scale of the heights. */
  private paintScale(pen: Pen): void {
    const perMetre = 1 / this.metresOf(1);
    const length = roundDown((this.height * 0.3) / perMetre);
    const bottom = this.height - 14;
    const top = bottom - length * perMetre;
    pen.path([14, bottom, 22, bottom, NaN, NaN, 14, top, 22, top, NaN, NaN, 18, bottom, 18, top], { stroke: "--picture-text", width: 1.2 });
    const text = { colour: "--picture-text", size: 12, baseline: "middle" } as const;
    pen.text(quantity(length, "m", 1), 27, (top + bottom) / 2, text);
  }

  describe(): string {
    const { heightGain, angleGain } = this;
    if (heightGain === 1 && angleGain === 1) return WORDS.toss.true_size;
    const times = (gain: number) => (gain === 1 ? WORDS.toss.as_it_is : say(WORDS.toss.times, { gain: plain(gain, 1) }));
    return say(WORDS.toss.enlarged, { heights: times(heightGain), angles: times(angleGain) });
  }

  /** Where the middle of the disk's upper side is on the canvas. */
  placeOfDisk(pose: Pose): [number, number] {
    return this.project(0, 0, this.radii(pose.height) + THICKNESS);
  }

  metresOf(pixels: number): number {
    return (pixels * this.radius) / (this.pixels * this.heightGain * Math.cos(ELEVATION));
  }

  /** Radians of the disk when its rim moves by so many pixels. */
  radiansOf(pixels: number): number {
    return pixels / (this.pixels * this.angleGain);
  }

  private radii(height: number): number {
    return (height * this.heightGain) / this.radius;
  }

  /** Lengths in radii; x to the right, y away from us, z up. */
  private project(x: number, y: number, z: number): [number, number] {
    const height = z - this.ground;
    const up = height * Math.cos(ELEVATION) + y * Math.sin(ELEVATION);
    const depth = y * Math.cos(ELEVATION) - height * Math.sin(ELEVATION);
    const scale = (this.pixels * DISTANCE) / (DISTANCE + depth);
    return [this.width / 2 + x * scale, this.height / 2 - up * scale];
  }

  private onRing(radius: number, angle: number, z: number): [number, number] {
    return this.project(radius * Math.cos(angle), radius * Math.sin(angle), z);
  }

  private ring(radius: number, z: number, from = 0, to = 2 * Math.PI): number[] {
    const angle = (corner: number) => from + ((to - from) * corner) / CORNERS;
    return Array.from({ length: CORNERS + 1 }, (_, corner) => this.onRing(radius, angle(corner), z)).flat();
  }

  private cylinder(pen: Pen, radius: number, bottom: number, face: string): void {
    const top = bottom + THICKNESS;
    const edge = { stroke: "--picture-frame", width: 0.8, close: true };
    // The half of the rim that faces us.
    const rim = [...this.ring(radius, bottom, Math.PI, 2 * Math.PI), ...this.ring(radius, top, 2 * Math.PI, Math.PI)];
    pen.path(rim, { fill: `${face}-side`, ...edge });
    pen.path(this.ring(radius, top), { fill: face, ...edge });
  }

  private spokes(pen: Pen, z: number, turn: number, radius: number, stroke: string, count: number): void {
    const angle = (spoke: number) => turn + (2 * Math.PI * spoke) / count;
    const ends = Array.from({ length: count }, (_, spoke) => this.onRing(radius, angle(spoke), z));
    const middle = this.project(0, 0, z);
    pen.path(ends.flatMap((end) => [...middle, ...end, NaN, NaN]), { stroke, width: 1 }); // prettier-ignore
  }

  /** The mark by which a rotation is seen, between two radii and half an angle to either side. */
  private wedge(pen: Pen, z: number, turn: number, [inner, outer, half]: [number, number, number], fill: string): void {
    const at = (radius: number, by: number) => this.onRing(radius, turn - Math.PI / 2 + by, z);
    pen.path([...at(inner, 0), ...at(outer, -half), ...at(outer, half)], { fill, close: true });
  }
}

/** The largest of 1, 2 and 5 times a power of ten that is not above such a number. */
const roundDown = (value: number): number => 1 / roundUp(1 / value);

type Platform = Pick<SystemParameters, "amplitude" | "twist_amplitude">;

/** How wide and high the inset with the path is, if the scene has room for it. */
const SIDE = 100;
/** Perspective enlarges a disk that flies high by as much. */
const NEAREST = 1.13;

/** Angles from this on are told in radians and not in thousandths of them (rad). */
const LARGE = 0.05;

export function pathAxes({ amplitude, twist_amplitude }: Platform): Axes {
  const [angles, heights] = [twist_amplitude, amplitude].map((size) => padded([-size, size])) as [Range, Range];
  const { angle, height } = WORDS.axes;
  const x = twist_amplitude >= LARGE ? { label: say(angle, { prefix: "" }), range: angles } : prefixed(angle, angles);
  return { x, y: prefixed(height, heights) };
}

/** In the upper right corner of the scene, beside the disk, with a dot where the point is now. */
export function paintPathInset(pen: Pen, recording: Recording, now: Moment, right: number, disk: number): void {
  const side = clamp(right / 2 - NEAREST * disk - 10, 40, SIDE);
  const box = { left: right - side - 6, top: 6, width: side, height: side };
  const plot = { ...box, ...pathAxes(recording.system), xTicks: [], yTicks: [], size: 0 };
  const frame = { fill: "--picture-paper", stroke: "--picture-frame", width: 1 };
  pen.rect(box.left, box.top, box.width, box.height, frame);
  paintPath(pen, plot, recording);
  const mark = { fill: "--platform-mark", stroke: "--picture-paper", width: 1 };
  pen.circle(pixelX(plot, now.platform_angle), pixelY(plot, now.platform_height), 4, mark);
}

export function paintPath(pen: Pen, plot: Plot, recording: Recording): void {
  const angles = recording.span("platform_angle", 0, recording.period);
  const heights = recording.span("platform_height", 0, recording.period);
  const points = [...angles].flatMap((angle, index) => [pixelX(plot, angle), pixelY(plot, heights[index] ?? NaN)]);
  pen.path(points, { stroke: "--platform-line", width: 1.6, close: true });
}

export function describePath({ amplitude, twist_amplitude }: Platform): string {
  const angle = twist_amplitude >= LARGE ? `${plain(twist_amplitude, 3)} rad` : quantity(twist_amplitude, "rad");
  return say(WORDS.toss.path, { angle, height: quantity(amplitude, "m") });
}
