/** Ways to hold one's hands; `side` is 1 for the left, -1 for the right. */

import { BIND, FORE_ARM, UPPER_ARM } from "./skeleton";
import type { Hand } from "./skeleton";
import type { Vec3 } from "./vector";

/** An arm that hangs: swung forward, bent at the elbow, held away from the body, radians. */
export function hang(side: number, swing: number, bend: number, out: number): Hand {
  const [x, y, z] = side > 0 ? BIND.upperArmL : BIND.upperArmR;
  const upper: Vec3 = [Math.sin(swing), side * Math.sin(out), -Math.cos(swing) * Math.cos(out)];
  const angle = swing + bend;
  const fore: Vec3 = [Math.sin(angle), side * Math.sin(out * 0.4), -Math.cos(angle)];
  return {
    at: [
      x + UPPER_ARM * upper[0] + FORE_ARM * fore[0],
      y + UPPER_ARM * upper[1] + FORE_ARM * fore[1],
      z + UPPER_ARM * upper[2] + FORE_ARM * fore[2],
    ],
    elbow: [-1, side * 0.35, -0.1],
  };
}

/** A hand at a place: forward, outward from the middle, up. */
export function handAt(
  side: number,
  forward: number,
  outward: number,
  up: number,
  elbow: Vec3 = [-0.5, 0.5, -0.7],
): Hand {
  return { at: [forward, side * outward, up], elbow: [elbow[0], side * elbow[1], elbow[2]] };
}
