/** Skinned meshes from cross-sections: a tube through a row of ellipses, one after the other. */

import { JOINTS, type Joint } from "./skeleton";
import { cross, sub, unit, add } from "./vector";
import type { Vec3 } from "./vector";

/** How fine a figure is: 0 for one of a few pixels, 2 for a close look. */
export type Detail = 0 | 1 | 2;

/** What is coloured alike; the order is the shader's. */
export const PAINTS = [
  "skin", "shirt", "trousers", "hair", "shoes", "sleeve", "cover", "paper", "screen", "card", "wood", "bag",
] as const;
export type Paint = (typeof PAINTS)[number];

/** Parts that not everybody has; the order is the bits of `Look.parts`. */
export const PARTS = ["short hair", "long hair", "bun", "backpack"] as const;
export type Part = (typeof PARTS)[number];

export interface Ring {
  readonly centre: Vec3;
  /** Half extents: along x and y for an upright tube, along z and y for a lying one. */
  readonly radii: readonly [number, number];
  readonly joint: Joint;
  /** A second joint that it goes along with, and how much. */
  readonly also?: readonly [Joint, number];
  /** Colour from here on to the next ring. */
  readonly paint: Paint;
  /** 1 in the open, less in a nook. */
  readonly shade?: number;
  /** The least detail that it is part of: 0 is in every figure. */
  readonly detail?: Detail;
}

export interface TubeOptions {
  readonly lying?: boolean;
  readonly part?: Part;
  /** Without lids, where the ends are hidden or too small to be seen. */
  readonly open?: boolean;
  /** 2 is an ellipse, more is squarer. */
  readonly square?: number;
}

/** By vertex: place, normal, (joint, other joint, share of the other, paint), (part, shade). */
export interface FigureMesh {
  readonly positions: number[];
  readonly normals: number[];
  readonly skins: number[];
  readonly extras: number[];
  readonly index: number[];
}

export const emptyMesh = (): FigureMesh => ({ positions: [], normals: [], skins: [], extras: [], index: [] });

/** Adds a tube, closed at both ends, to a mesh. Rings go upwards, or forward where it lies. */
export function tube(mesh: FigureMesh, rings: readonly Ring[], segments: number, options: TubeOptions = {}): void {
  const points = rings.map((ring) => ringPoints(ring, segments, options));
  const normals = points.map((_, i) => points[i]!.map((_, k) => normalAt(points, i, k)));
  let lower = -1;
  for (let i = 0; i + 1 < rings.length; i += 1) {
    const { paint } = rings[i]!;
    const put = (at: number): number => addRing(mesh, points[at]!, normals[at]!, { ...rings[at]!, paint }, options);
    // Neighbouring bands share a ring, unless the colour changes there.
    if (i === 0 || paint !== rings[i - 1]!.paint) lower = put(i);
    const upper = put(i + 1);
    addBand(mesh, lower, upper, segments);
    lower = upper;
  }
  if (options.open === true) return;
  addCap(mesh, points[0]!, normals[0]!, rings[0]!, true, options);
  addCap(mesh, points.at(-1)!, normals.at(-1)!, { ...rings.at(-1)!, paint: rings.at(-2)!.paint }, false, options);
}

function ringPoints(ring: Ring, segments: number, options: TubeOptions): Vec3[] {
  const power = 2 / (options.square ?? 2);
  const bow = (c: number): number => Math.sign(c) * Math.abs(c) ** power;
  return Array.from({ length: segments }, (_, k) => {
    const angle = (2 * Math.PI * (k + 0.5)) / segments;
    const a = ring.radii[0] * bow(Math.cos(angle));
    const b = ring.radii[1] * bow(Math.sin(angle));
    return add(ring.centre, options.lying === true ? [0, b, -a] : [a, b, 0]);
  });
}

/** From the neighbours round the ring and along the tube. */
function normalAt(points: readonly Vec3[][], i: number, k: number): Vec3 {
  const ring = points[i]!;
  const n = ring.length;
  const around = sub(ring[(k + 1) % n]!, ring[(k + n - 1) % n]!);
  const along = sub((points[i + 1] ?? ring)[k]!, (points[i - 1] ?? ring)[k]!);
  return unit(cross(around, along), [0, 0, i === 0 ? -1 : 1]);
}

/** Adds the vertices of a ring; says which is the first. */
function addRing(
  mesh: FigureMesh,
  points: readonly Vec3[],
  normals: readonly Vec3[],
  ring: Ring,
  options: TubeOptions,
): number {
  const first = mesh.positions.length / 3;
  points.forEach((point, k) => addVertex(mesh, point, normals[k]!, ring, options));
  return first;
}

function addVertex(mesh: FigureMesh, point: Vec3, normal: Vec3, ring: Ring, options: TubeOptions): void {
  mesh.positions.push(...point);
  mesh.normals.push(...normal);
  const [other, share] = ring.also ?? [ring.joint, 0];
  mesh.skins.push(JOINTS.indexOf(ring.joint), JOINTS.indexOf(other), share, PAINTS.indexOf(ring.paint));
  mesh.extras.push(options.part === undefined ? -1 : PARTS.indexOf(options.part), ring.shade ?? 1);
}

function addBand(mesh: FigureMesh, lower: number, upper: number, n: number): void {
  for (let k = 0; k < n; k += 1) {
    const next = (k + 1) % n;
    mesh.index.push(lower + k, lower + next, upper + next, lower + k, upper + next, upper + k);
  }
}

/** A flat lid; the tube's last ring is small where the end is to be round. */
function addCap(
  mesh: FigureMesh,
  points: readonly Vec3[],
  normals: readonly Vec3[],
  ring: Ring,
  below: boolean,
  options: TubeOptions,
): void {
  const first = mesh.positions.length / 3;
  points.forEach((point, k) => addVertex(mesh, point, normals[k]!, ring, options));
  for (let k = 1; k + 1 < points.length; k += 1) {
    if (below) mesh.index.push(first, first + k + 1, first + k);
    else mesh.index.push(first, first + k, first + k + 1);
  }
}

export interface Box {
  readonly centre: Vec3;
  readonly size: Vec3;
  readonly joint: Joint;
  readonly paint: Paint;
  readonly part?: Part;
}

/** Adds a box with flat faces. */
export function block(mesh: FigureMesh, box: Box): void {
  const [sx, sy, sz] = box.size;
  const ring: Ring = { centre: box.centre, radii: [0, 0], joint: box.joint, paint: box.paint };
  for (const [axis, sign] of [[0, 1], [0, -1], [1, 1], [1, -1], [2, 1], [2, -1]] as const) {
    const first = mesh.positions.length / 3;
    const normal: [number, number, number] = [0, 0, 0];
    normal[axis] = sign;
    for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const) {
      const corner: [number, number, number] = [0, 0, 0];
      corner[axis] = sign;
      corner[(axis + 1) % 3] = u;
      corner[(axis + 2) % 3] = v * sign;
      const point = add(box.centre, [(corner[0] * sx) / 2, (corner[1] * sy) / 2, (corner[2] * sz) / 2]);
      addVertex(mesh, point, normal, ring, box.part === undefined ? {} : { part: box.part });
    }
    mesh.index.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
}
