/** Disk and platform in perspective, drawn on a canvas. */

import type { Colours } from "../../drawing/colours";
import { plain, quantity } from "../../drawing/numbers";
import type { Pen } from "../../drawing/pen";
import { roundUp } from "../../drawing/scale";

/** Where both are: heights in m, angles in rad. */
export interface Pose {
  readonly height: number;
  readonly angle: number;
  readonly platform_height: number;
  readonly platform_angle: number;
}

/** How lengths and angles are enlarged, and where the picture has its middle. */
export interface Stage {
  /** Radius of the disk (m) and how many pixels it has. */
  readonly radius: number;
  readonly pixels: number;
  readonly heightGain: number;
  readonly angleGain: number;
  readonly centre: readonly [number, number];
  /** The plane of the middle of the platform's motion, in radii below the centre. */
  readonly ground: number;
}

const ELEVATION = 0.42;
const DISTANCE = 7;
const PLATFORM = 1.22;
const THICKNESS = 0.1;
const CORNERS = 72;

/** Enlarges small motions until they can be seen: by 1, 2, 5, 10, ... */
export function stageOf(
  width: number,
  height: number,
  radius: number,
  heights: readonly [number, number],
  twist: number,
): Stage {
  const span = Math.max(heights[1] - heights[0], 1e-300) / radius;
  const heightGain = span >= 0.5 && span <= 4 ? 1 : gainOf(1.8 / span);
  const angleGain = twist >= 0.2 || twist === 0 ? 1 : gainOf(0.5 / twist);
  const shown = span * heightGain;
  const pixels = Math.max(Math.min(width / (2 * PLATFORM + 0.7), height / (shown + 1.9)), 10);
  const middle = (heights[0] * heightGain) / radius + shown / 2;
  return { radius, pixels, heightGain, angleGain, centre: [width / 2, height / 2], ground: middle - 0.05 };
}

function gainOf(wanted: number): number {
  if (wanted < 1) return 1 / roundUp(1 / wanted);
  const up = roundUp(wanted);
  return up > wanted * 1.01 ? lower(up) : up;
}

/** The number of 1, 2, 5 times a power of ten below such a number. */
function lower(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const lead = Math.round(value / power);
  return lead === 1 ? power / 2 : lead === 2 ? power : 2 * power;
}

export function paintScene(pen: Pen, stage: Stage, pose: Pose, colour: Colours): void {
  const platform = (pose.platform_height * stage.heightGain) / stage.radius;
  const disk = (pose.height * stage.heightGain) / stage.radius;
  const turn = pose.platform_angle * stage.angleGain;
  column(pen, stage, platform - THICKNESS, colour);
  cylinder(
    pen,
    stage,
    PLATFORM,
    platform - THICKNESS,
    platform,
    colour("--platform"),
    colour("--platform-side"),
    colour,
  );
  spokes(pen, stage, platform, turn, PLATFORM, colour("--platform-side"), 6);
  wedge(pen, stage, platform, turn, 0.98, PLATFORM, 0.09, colour("--platform-mark"));
  pen.path(ring(stage, 1, platform), { fill: colour("--platform-side"), opacity: 0.45, close: true });
  cylinder(pen, stage, 1, disk, disk + THICKNESS, colour("--disk"), colour("--disk-side"), colour);
  const top = disk + THICKNESS;
  const spin = pose.angle * stage.angleGain;
  spokes(pen, stage, top, spin, 1, colour("--disk-side"), 4);
  wedge(pen, stage, top, spin, 0.25, 0.96, 0.07, colour("--disk-mark"));
}

/** A bar whose length is true on the scale of the heights, and how both scales are enlarged. */
export function paintScale(pen: Pen, stage: Stage, height: number, colour: Colours): void {
  const perMetre = (stage.pixels * stage.heightGain * Math.cos(ELEVATION)) / stage.radius;
  const length = lower(roundUp((height * 0.3) / perMetre));
  const bottom = height - 14;
  const top = bottom - length * perMetre;
  const ink = { stroke: colour("--picture-text"), width: 1.2 };
  pen.path([14, bottom, 22, bottom, NaN, NaN, 14, top, 22, top, NaN, NaN, 18, bottom, 18, top], ink);
  const text = {
    colour: colour("--picture-text"),
    size: 12,
    baseline: "middle",
    halo: colour("--picture-paper"),
  } as const;
  pen.text(quantity(length, "m", 1), 27, (top + bottom) / 2, text);
}

export function describeGains({ heightGain, angleGain }: Stage): string {
  if (heightGain === 1 && angleGain === 1) return "Heights and angles are drawn as they are.";
  const times = (gain: number) => (gain === 1 ? "as they are" : `${plain(gain, 1)} times as large`);
  return `Heights are drawn ${times(heightGain)}, angles ${times(angleGain)}.`;
}

/** Where the middle of the disk's upper side is on the canvas. */
export function diskPlace(stage: Stage, pose: Pose): [number, number] {
  return project(stage, 0, 0, (pose.height * stage.heightGain) / stage.radius + THICKNESS);
}

/** Metres of height of so many pixels. */
export function metresOf(stage: Stage, pixels: number): number {
  return (pixels * stage.radius) / (stage.pixels * stage.heightGain * Math.cos(ELEVATION));
}

/** Radians of the disk when its rim moves by so many pixels. */
export function radiansOf(stage: Stage, pixels: number): number {
  return pixels / (stage.pixels * stage.angleGain);
}

/** Lengths in radii; x to the right, y away from us, z up. */
function project(stage: Stage, x: number, y: number, z: number): [number, number] {
  const height = z - stage.ground;
  const up = height * Math.cos(ELEVATION) + y * Math.sin(ELEVATION);
  const depth = y * Math.cos(ELEVATION) - height * Math.sin(ELEVATION);
  const scale = (stage.pixels * DISTANCE) / (DISTANCE + depth);
  return [stage.centre[0] + x * scale, stage.centre[1] - up * scale];
}

function ring(stage: Stage, radius: number, z: number, from = 0, to = 2 * Math.PI): number[] {
  const points: number[] = [];
  for (let corner = 0; corner <= CORNERS; corner += 1) {
    const angle = from + ((to - from) * corner) / CORNERS;
    points.push(...project(stage, radius * Math.cos(angle), radius * Math.sin(angle), z));
  }
  return points;
}

function cylinder(
  pen: Pen,
  stage: Stage,
  radius: number,
  bottom: number,
  top: number,
  face: string,
  side: string,
  colour: Colours,
): void {
  const edge = { stroke: colour("--picture-frame"), width: 0.8 };
  // The half of the rim that faces us.
  const lower = ring(stage, radius, bottom, Math.PI, 2 * Math.PI);
  const upper = ring(stage, radius, top, 2 * Math.PI, Math.PI);
  pen.path([...lower, ...upper], { fill: side, ...edge, close: true });
  pen.path(ring(stage, radius, top), { fill: face, ...edge, close: true });
}

/** The column that carries the platform. */
function column(pen: Pen, stage: Stage, top: number, colour: Colours): void {
  const half = 0.16;
  const low = stage.ground - 6;
  const points = [
    ...project(stage, -half, 0, top), ...project(stage, half, 0, top),
    ...project(stage, half, 0, low), ...project(stage, -half, 0, low),
  ]; // prettier-ignore
  pen.path(points, { fill: colour("--platform-side"), opacity: 0.5, close: true });
}

function spokes(pen: Pen, stage: Stage, z: number, turn: number, radius: number, stroke: string, count: number): void {
  const points: number[] = [];
  for (let spoke = 0; spoke < count; spoke += 1) {
    const angle = turn + (2 * Math.PI * spoke) / count;
    points.push(...project(stage, 0, 0, z));
    points.push(...project(stage, radius * Math.cos(angle), radius * Math.sin(angle), z), NaN, NaN);
  }
  pen.path(points, { stroke, width: 1 });
}

/** The mark by which a rotation is seen. */
function wedge(
  pen: Pen,
  stage: Stage,
  z: number,
  turn: number,
  inner: number,
  outer: number,
  half: number,
  fill: string,
): void {
  const angle = turn - Math.PI / 2;
  const at = (radius: number, by: number) =>
    project(stage, radius * Math.cos(angle + by), radius * Math.sin(angle + by), z);
  pen.path([...at(inner, 0), ...at(outer, -half), ...at(outer, half)], { fill, close: true });
}
