/** The figure: body, hair, things in its hands and the stool under it, in the bind pose (skeleton.ts). */

import { block, emptyMesh, tube, type Detail, type FigureMesh, type Paint, type Ring, type TubeOptions } from "./loft";
import { BIND, type Joint } from "./skeleton";
import type { Vec3 } from "./vector";

type Side = "L" | "R";

/** How many corners round things have, by detail. */
const AROUND = { body: [5, 6, 12], limb: [3, 5, 8] } as const;

/** A whole figure. */
export function buildFigure(detail: Detail): FigureMesh {
  const mesh = emptyMesh();
  const [around, limbs] = [AROUND.body[detail], AROUND.limb[detail]];
  const put = (rings: readonly Ring[], corners: number, options: TubeOptions = {}): void => {
    const kept = rings.filter((ring) => (ring.detail ?? 0) <= detail);
    tube(mesh, kept, corners, { open: detail === 0, ...options });
  };
  put(HIPS, around, { square: 2.3 });
  put(TRUNK, around, { square: 2.3 });
  put(HEAD, around);
  put(SHORT_HAIR, around, { part: "short hair" });
  put(LONG_HAIR, around, { part: "long hair" });
  if (detail > 0) put(BUN, limbs, { part: "bun" });
  if (detail > 1) put(NOSE, 4);
  put(BACKPACK, Math.max(limbs, 4), { part: "backpack", square: 3 });
  for (const side of ["L", "R"] as const) {
    put(arm(side), limbs);
    put(leg(side), limbs);
    put(shoe(side), limbs, { lying: true });
  }
  addProps(mesh, detail);
  return mesh;
}

const ring = (
  joint: Joint,
  paint: Paint,
  z: number,
  depth: number,
  width: number,
  more: Partial<Ring> & { x?: number; y?: number } = {},
): Ring => {
  const { x = 0, y = 0, ...rest } = more;
  return { centre: [x, y, z], radii: [depth, width], joint, paint, ...rest };
};

const HIPS: readonly Ring[] = [
  ring("hips", "trousers", 0.8, 0.045, 0.06, { shade: 0.7, detail: 1 }),
  ring("hips", "trousers", 0.83, 0.095, 0.13, { shade: 0.8, x: -0.004 }),
  ring("hips", "trousers", 0.89, 0.113, 0.162, { x: -0.008, detail: 1 }),
  ring("hips", "trousers", 0.97, 0.107, 0.153),
  ring("hips", "trousers", 1.03, 0.095, 0.14, { detail: 2 }),
];

const TRUNK: readonly Ring[] = [
  ring("hips", "shirt", 0.9, 0.1, 0.145, { shade: 0.75, detail: 2 }),
  ring("hips", "shirt", 0.9, 0.127, 0.176, { shade: 0.9, x: -0.003 }),
  ring("hips", "shirt", 1.0, 0.116, 0.162, { also: ["chest", 0.3], detail: 1 }),
  ring("chest", "shirt", 1.1, 0.103, 0.145, { also: ["hips", 0.35] }),
  ring("chest", "shirt", 1.2, 0.11, 0.155, { also: ["hips", 0.08], detail: 1 }),
  ring("chest", "shirt", 1.31, 0.119, 0.176, { detail: 2 }),
  ring("chest", "shirt", 1.385, 0.112, 0.194, { x: -0.004 }),
  ring("chest", "shirt", 1.43, 0.09, 0.172, { x: -0.008, detail: 1 }),
  ring("chest", "shirt", 1.462, 0.068, 0.105, { x: -0.008, detail: 2 }),
  ring("chest", "shirt", 1.483, 0.055, 0.066, { x: -0.008 }),
  ring("chest", "shirt", 1.488, 0.045, 0.05, { x: -0.008, detail: 2 }),
];

const HEAD: readonly Ring[] = [
  ring("chest", "skin", 1.44, 0.05, 0.052, { x: -0.008, shade: 0.8, detail: 1 }),
  ring("head", "skin", 1.5, 0.047, 0.048, { x: -0.004, shade: 0.78, also: ["chest", 0.4] }),
  ring("head", "skin", 1.538, 0.05, 0.048, { x: 0.004, shade: 0.85, detail: 2 }),
  ring("head", "skin", 1.545, 0.074, 0.055, { x: 0.024, shade: 0.9, detail: 1 }),
  ring("head", "skin", 1.575, 0.094, 0.07, { x: 0.016 }),
  ring("head", "skin", 1.63, 0.104, 0.08, { x: 0.008, detail: 1 }),
  ring("head", "skin", 1.69, 0.102, 0.08, { x: 0.004, detail: 2 }),
  ring("head", "skin", 1.73, 0.085, 0.068, { x: 0.0 }),
  ring("head", "skin", 1.755, 0.05, 0.042, { x: -0.004, detail: 2 }),
  ring("head", "skin", 1.765, 0.01, 0.01, { x: -0.004 }),
];

const NOSE: readonly Ring[] = [
  ring("head", "skin", 1.598, 0.006, 0.01, { x: 0.106, shade: 0.85 }),
  ring("head", "skin", 1.606, 0.018, 0.016, { x: 0.108 }),
  ring("head", "skin", 1.652, 0.005, 0.009, { x: 0.106 }),
];

const hair = (z: number, depth: number, width: number, x: number, more: Partial<Ring> = {}): Ring =>
  ring("head", "hair", z, depth, width, { x, ...more });

const CROWN: readonly Ring[] = [
  hair(1.675, 0.101, 0.0865, -0.014, { detail: 1 }),
  hair(1.7, 0.109, 0.0875, -0.002, { detail: 2 }),
  hair(1.735, 0.098, 0.079, -0.003),
  hair(1.765, 0.066, 0.055, -0.006, { detail: 1 }),
  hair(1.782, 0.014, 0.012, -0.008),
];
const SHORT_HAIR: readonly Ring[] = [
  hair(1.565, 0.03, 0.05, -0.05, { shade: 0.8, detail: 1 }),
  hair(1.59, 0.056, 0.078, -0.046, { shade: 0.9 }),
  hair(1.64, 0.077, 0.0855, -0.038),
  ...CROWN,
];
const LONG_HAIR: readonly Ring[] = [
  hair(1.43, 0.024, 0.06, -0.066, { shade: 0.85 }),
  hair(1.46, 0.046, 0.088, -0.06, { shade: 0.9, detail: 1 }),
  hair(1.54, 0.056, 0.094, -0.053, { detail: 1 }),
  hair(1.62, 0.075, 0.092, -0.04),
  ...CROWN,
];
const BUN: readonly Ring[] = [
  hair(1.69, 0.012, 0.012, -0.125, { shade: 0.8 }),
  hair(1.702, 0.038, 0.038, -0.125),
  hair(1.73, 0.05, 0.05, -0.122),
  hair(1.758, 0.038, 0.038, -0.118),
  hair(1.772, 0.01, 0.01, -0.115),
];

const bag = (z: number, depth: number, width: number, detail: Detail = 0): Ring =>
  ring("chest", "bag", z, depth, width, { x: -0.165, detail });
const BACKPACK: readonly Ring[] = [
  bag(1.06, 0.04, 0.09, 1),
  bag(1.08, 0.082, 0.135),
  bag(1.2, 0.088, 0.142, 1),
  bag(1.34, 0.076, 0.132),
  bag(1.42, 0.05, 0.1, 1),
  bag(1.435, 0.02, 0.05),
];

/** From the fingertips up to the shoulder. */
function arm(side: Side): Ring[] {
  const [, y, shoulder] = BIND[`upperArm${side}`];
  const elbow = BIND[`foreArm${side}`][2];
  const upper: Joint = `upperArm${side}`;
  const fore: Joint = `foreArm${side}`;
  const wrist = elbow - 0.25;
  return [
    ring(fore, "skin", wrist - 0.165, 0.012, 0.008, { y }),
    ring(fore, "skin", wrist - 0.145, 0.03, 0.016, { y, detail: 2 }),
    ring(fore, "skin", wrist - 0.09, 0.042, 0.021, { y, detail: 1 }),
    ring(fore, "skin", wrist - 0.03, 0.033, 0.024, { y, detail: 2 }),
    ring(fore, "sleeve", wrist, 0.031, 0.029, { y, shade: 0.92 }),
    ring(fore, "sleeve", elbow - 0.09, 0.041, 0.039, { y, detail: 1 }),
    ring(fore, "shirt", elbow - 0.03, 0.043, 0.041, { y, also: [upper, 0.3], detail: 2 }),
    ring(upper, "shirt", elbow + 0.015, 0.044, 0.043, { y, also: [fore, 0.35] }),
    ring(upper, "shirt", elbow + 0.1, 0.05, 0.047, { y, detail: 1 }),
    ring(upper, "shirt", shoulder - 0.06, 0.056, 0.052, { y, detail: 2 }),
    ring(upper, "shirt", shoulder, 0.059, 0.054, { y, also: ["chest", 0.2], detail: 1 }),
    ring(upper, "shirt", shoulder + 0.032, 0.047, 0.044, { y: y * 0.98, also: ["chest", 0.45], detail: 1 }),
    ring(upper, "shirt", shoulder + 0.05, 0.016, 0.016, { y: y * 0.95, also: ["chest", 0.6] }),
  ];
}

/** From the ankle up into the hip. */
function leg(side: Side): Ring[] {
  const [, y, hip] = BIND[`thigh${side}`];
  const knee = BIND[`shin${side}`][2];
  const thigh: Joint = `thigh${side}`;
  const shin: Joint = `shin${side}`;
  return [
    ring(shin, "trousers", 0.055, 0.052, 0.046, { y, x: -0.008, shade: 0.8 }),
    ring(shin, "trousers", 0.075, 0.058, 0.05, { y, x: -0.006, detail: 2 }),
    ring(shin, "trousers", 0.26, 0.064, 0.054, { y, x: -0.01, detail: 1 }),
    ring(shin, "trousers", knee - 0.06, 0.063, 0.058, { y, x: 0, also: [thigh, 0.15], detail: 2 }),
    ring(shin, "trousers", knee, 0.066, 0.06, { y, x: 0.003, also: [thigh, 0.5] }),
    ring(thigh, "trousers", knee + 0.06, 0.07, 0.064, { y, also: [shin, 0.15], detail: 2 }),
    ring(thigh, "trousers", knee + 0.2, 0.083, 0.076, { y, detail: 1 }),
    ring(thigh, "trousers", hip - 0.09, 0.097, 0.085, { y, also: ["hips", 0.1] }),
    ring(thigh, "trousers", hip - 0.01, 0.095, 0.082, { y, shade: 0.92, also: ["hips", 0.45], detail: 1 }),
    ring(thigh, "trousers", hip + 0.05, 0.06, 0.055, { y, shade: 0.92, also: ["hips", 0.8], detail: 1 }),
  ];
}

/** From the heel to the toes. */
function shoe(side: Side): Ring[] {
  const y = BIND[`foot${side}`][1];
  const joint: Joint = `foot${side}`;
  const part = (x: number, z: number, height: number, width: number, more: Partial<Ring> = {}): Ring => ({
    centre: [x, y, z] as Vec3, radii: [height, width], joint, paint: "shoes", ...more,
  });
  return [
    part(-0.072, 0.04, 0.02, 0.02),
    part(-0.06, 0.046, 0.044, 0.04, { detail: 1 }),
    part(-0.015, 0.052, 0.05, 0.045, { detail: 1 }),
    part(0.06, 0.041, 0.04, 0.047),
    part(0.12, 0.03, 0.029, 0.05, { detail: 2 }),
    part(0.165, 0.023, 0.022, 0.04, { detail: 1 }),
    part(0.185, 0.019, 0.01, 0.02),
  ];
}

function addProps(mesh: FigureMesh, detail: Detail): void {
  block(mesh, { centre: [0, 0, 0.006], size: [0.175, 0.25, 0.016], joint: "book", paint: "paper" });
  block(mesh, { centre: [0, 0, 0], size: [0.25, 0.33, 0.24], joint: "box", paint: "card" });
  const seat = (z: number, radius: number, shade = 1): Ring =>
    ring("stool", "wood", z, radius, radius, { shade, x: -0.01 });
  if (detail === 0) return tube(mesh, [seat(0, 0.03, 0.7), seat(0.41, 0.172, 0.9), seat(0.447, 0.16)], 5, {});
  block(mesh, { centre: [0, 0, -0.008], size: [0.19, 0.27, 0.012], joint: "book", paint: "cover" });
  block(mesh, { centre: [0, 0, 0], size: [0.075, 0.012, 0.15], joint: "phone", paint: "screen" });
  block(mesh, { centre: [0, 0, 0.1225], size: [0.252, 0.06, 0.004], joint: "box", paint: "paper" });
  const round = detail === 2 ? 14 : 6;
  tube(mesh, [seat(0.395, 0.15, 0.7), seat(0.405, 0.172), seat(0.44, 0.172), seat(0.447, 0.16)], round);
  tube(mesh, [seat(0.02, 0.03, 0.8), seat(0.4, 0.026, 0.7)], detail === 2 ? 8 : 4);
  tube(mesh, [seat(0, 0.14, 0.8), seat(0.015, 0.14, 0.9), seat(0.024, 0.1)], round);
}
