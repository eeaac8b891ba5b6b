/**
 * The walk: where feet, hips and arms are over one cycle of two steps.
 *
 * While a foot is on the ground it goes back exactly as fast as the body goes on, so with the phase taken from the
 * distance walked no foot slides.
 */

import { ANKLE_Z, BIND } from "./skeleton";
import type { Foot, Hand, Pose } from "./skeleton";
import { euler } from "./vector";
import type { Vec3 } from "./vector";
import { hang } from "./hands";

/** Share of the cycle that a foot is on the ground. */
const STANCE = 0.62;
const LIFT_M = 0.075;
const LEG_M = 0.822;
const BALL: readonly [number, number] = [0.12, -ANKLE_Z];
const HEEL: readonly [number, number] = [-0.055, -ANKLE_Z];

export interface Gait {
  /** Length of a cycle, metres. */
  readonly cycle: number;
  readonly hands?: readonly [Hand, Hand];
  readonly lean?: number;
}

/** The pose at a phase of the cycle, 0 to 1; at 0 the left heel touches the ground. */
export function walking(gait: Gait, phase: number): Pose {
  const vigour = gait.cycle / 1.45;
  const left = footAt(gait.cycle, phase, 1);
  const right = footAt(gait.cycle, phase + 0.5, -1);
  const swing = Math.cos(2 * Math.PI * phase);
  const sway = Math.sin(2 * Math.PI * phase);
  const hips: Vec3 = [0, 0.018 * sway, hipHeight(gait.cycle, phase) - BIND.hips[2]];
  const yaw = -0.1 * vigour * swing;
  return {
    hips,
    hipsTurn: euler(yaw, 0.03, 0.02 * sway),
    chest: euler(-1.9 * yaw, 0.03 + (gait.lean ?? 0), -0.03 * sway),
    head: euler(0.9 * yaw, -0.05 - 0.5 * (gait.lean ?? 0), 0.01 * sway),
    hands: gait.hands ?? [
      hang(1, -0.02 - 0.42 * vigour * swing, 0.28 - 0.16 * swing, 0.09),
      hang(-1, -0.02 + 0.42 * vigour * swing, 0.28 + 0.16 * swing, 0.09),
    ],
    feet: [left, right],
    knees: [[1, 0.06, 0], [1, -0.06, 0]],
    props: {},
  };
}

/** Where an ankle is at a phase of its own cycle, which begins when the heel touches the ground. */
export function footAt(cycle: number, phase: number, side: number): Foot {
  const own = phase - Math.floor(phase);
  const front = 0.27 * cycle;
  const back = front - STANCE * cycle;
  const pitch = footPitch(own, cycle);
  if (own < STANCE) return planted(front - cycle * own, 0, pitch, side);
  const s = (own - STANCE) / (1 - STANCE);
  const slope = -cycle * (1 - STANCE);
  const flat = hermite(back, front, slope, s);
  return planted(flat, LIFT_M * (cycle / 1.45) * Math.sin(Math.PI * s) ** 1.5, pitch, side);
}

/** The ankle of a foot that would stand flat at x, but is turned about its ball or its heel. */
function planted(x: number, lift: number, pitch: number, side: number): Foot {
  const [px, pz] = pitch > 0 ? BALL : HEEL;
  const cos = Math.cos(pitch);
  const sin = Math.sin(pitch);
  const ax = x + px - (cos * px + sin * pz);
  const az = ANKLE_Z + pz - (-sin * px + cos * pz) + lift;
  return { at: [ax, side * 0.075, az], pitch, out: 0.09 };
}

function footPitch(own: number, cycle: number): number {
  const strong = cycle / 1.45;
  const strike = -0.3 * strong;
  const off = 0.95 * strong;
  if (own < 0.1) return strike * (1 - smooth(own / 0.1));
  if (own < 0.36) return 0;
  if (own < STANCE) return off * smooth((own - 0.36) / (STANCE - 0.36)) ** 1.3;
  const s = (own - STANCE) / (1 - STANCE);
  return s < 0.6 ? off + (-0.1 - off) * smooth(s / 0.6) : -0.1 + (strike + 0.1) * smooth((s - 0.6) / 0.4);
}

/** As high as both legs reach, evened out a little. */
function hipHeight(cycle: number, phase: number): number {
  let least = Infinity;
  let sum = 0;
  for (let k = -2; k <= 2; k += 1) {
    const height = reachable(cycle, phase + k * 0.03);
    if (k === 0) least = height;
    sum += height / 5;
  }
  return Math.min(least, sum) + BIND.hips[2] - BIND.thighL[2];
}

function reachable(cycle: number, phase: number): number {
  let height = BIND.thighL[2] - 0.012;
  for (const shift of [0, 0.5]) {
    const [x, , z] = footAt(cycle, phase + shift, 1).at;
    height = Math.min(height, z + Math.sqrt(Math.max(LEG_M * LEG_M - x * x, 0)));
  }
  return height;
}

function hermite(from: number, to: number, slope: number, s: number): number {
  const s2 = s * s;
  const s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * from + (s3 - 2 * s2 + s) * slope + (3 * s2 - 2 * s3) * to + (s3 - s2) * slope;
}

/** 0 to 1 without a jerk at either end. */
export function smooth(x: number): number {
  const s = Math.min(Math.max(x, 0), 1);
  return s * s * (3 - 2 * s);
}
