/** A mesh of coloured prisms: what everything of the place is built from. */

import { BufferAttribute, BufferGeometry, Color } from "three";

export type Point = readonly [number, number];

/** A rectangle on the ground: its middle, and its extent along x and y. */
export interface Area {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly depth: number;
}

export const area = (x: number, y: number, width: number, depth: number): Area => ({ x, y, width, depth });

/** The corners of a rectangle, counter-clockwise, each cut off a little. */
export function rectangle(x: number, y: number, width: number, depth: number, cut = 0.03): Point[] {
  return rounded(x, y, width, depth, cut, 1);
}

/** A rectangle with round corners, of so many steps each. */
export function rounded(x: number, y: number, width: number, depth: number, radius: number, steps: number): Point[] {
  const r = Math.min(radius, width / 2, depth / 2);
  const points: Point[] = [];
  for (const [quarter, [sx, sy]] of ([[1, 1], [-1, 1], [-1, -1], [1, -1]] as const).entries()) {
    for (let k = 0; k <= steps; k += 1) {
      const angle = ((quarter + k / steps) * Math.PI) / 2;
      points.push([x + sx * (width / 2 - r) + r * Math.cos(angle), y + sy * (depth / 2 - r) + r * Math.sin(angle)]);
    }
  }
  return points;
}

export function disc(x: number, y: number, rx: number, ry = rx, steps = 28): Point[] {
  return Array.from({ length: steps }, (_, k): Point => {
    const angle = (2 * Math.PI * k) / steps;
    return [x + rx * Math.cos(angle), y + ry * Math.sin(angle)];
  });
}

/** A convex outline drawn in by so much; corners rounder than that become sharp. */
export function inset(outline: readonly Point[], by: number): Point[] {
  const n = outline.length;
  const [clampX, clampY] = [within(outline.map((p) => p[0]), by), within(outline.map((p) => p[1]), by)];
  return outline.map((point, i) => {
    const [ax, ay] = outward(outline[(i + n - 1) % n]!, point);
    const [bx, cy] = outward(point, outline[(i + 1) % n]!);
    const k = by / Math.max(0.25, 1 + ax * bx + ay * cy);
    return [clampX(point[0] - (ax + bx) * k), clampY(point[1] - (ay + cy) * k)];
  });
}

/** Keeps values as far as that inside the range of some. */
function within(values: readonly number[], by: number): (value: number) => number {
  const [low, high] = [Math.min(...values) + by, Math.max(...values) - by];
  return (value) => Math.min(Math.max(value, low), high);
}

function outward(a: Point, b: Point): Point {
  const size = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  return [(b[1] - a[1]) / size, -(b[0] - a[0]) / size];
}

export interface PrismOptions {
  /** Width of the chamfer round the top. */
  readonly bevel?: number;
  /** Colour of the top, where it is another. */
  readonly top?: number;
  /** How much narrower the top is than the bottom. */
  readonly taper?: number;
}

export class SolidMesh {
  private readonly positions: number[] = [];
  private readonly normals: number[] = [];
  private readonly colours: number[] = [];
  private readonly index: number[] = [];
  private readonly colour = new Color();

  /** An upright prism over a convex outline. */
  prism(outline: readonly Point[], from: number, to: number, colour: number, options: PrismOptions = {}): void {
    const bevel = Math.min(options.bevel ?? 0.02, (to - from) / 3);
    const shoulder = options.taper === undefined ? outline : inset(outline, options.taper);
    const lid = inset(shoulder, bevel);
    this.band(outline, from, shoulder, to - bevel, colour);
    this.band(shoulder, to - bevel, lid, to, options.top ?? colour);
    this.lid(lid, to, options.top ?? colour);
  }

  box({ x, y, width, depth }: Area, from: number, to: number, colour: number, options: PrismOptions = {}): void {
    const cut = Math.min(0.02, width / 4, depth / 4);
    this.prism(rectangle(x, y, width, depth, cut), from, to, colour, options);
  }

  /** A ball, or part of one: squeezed by `squash`. */
  ball(x: number, y: number, z: number, radius: number, colour: number, squash = 1): void {
    const rings = 9;
    const around = 18;
    const first = this.positions.length / 3;
    for (let i = 0; i <= rings; i += 1) {
      const tilt = (Math.PI * i) / rings - Math.PI / 2;
      for (let k = 0; k < around; k += 1) {
        const angle = (2 * Math.PI * (k + 0.5 * (i % 2))) / around;
        const n = [Math.cos(tilt) * Math.cos(angle), Math.cos(tilt) * Math.sin(angle), Math.sin(tilt)] as const;
        const up = n[2] / squash;
        const size = Math.hypot(n[0], n[1], up);
        this.vertex(
          x + radius * n[0],
          y + radius * n[1],
          z + radius * squash * n[2],
          [n[0] / size, n[1] / size, up / size],
          colour,
        );
      }
    }
    for (let i = 0; i < rings; i += 1) {
      for (let k = 0; k < around; k += 1) {
        const a = first + i * around + k;
        const b = first + i * around + ((k + 1) % around);
        this.index.push(a, b, b + around, a, b + around, a + around);
      }
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(this.positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(Float32Array.from(this.normals), 3));
    geometry.setAttribute("color", new BufferAttribute(Float32Array.from(this.colours), 3));
    geometry.setIndex(this.index);
    return geometry;
  }

  private band(lower: readonly Point[], from: number, upper: readonly Point[], to: number, colour: number): void {
    const n = lower.length;
    for (let i = 0; i < n; i += 1) {
      const j = (i + 1) % n;
      const [a, b, c, d] = [lower[i]!, lower[j]!, upper[j]!, upper[i]!];
      const [nx, ny] = outward(a, b);
      const slope = (a[0] - d[0]) * nx + (a[1] - d[1]) * ny;
      const size = Math.hypot(to - from, slope) || 1;
      const normal = [(nx * (to - from)) / size, (ny * (to - from)) / size, slope / size] as const;
      const first = this.positions.length / 3;
      this.vertex(a[0], a[1], from, normal, colour);
      this.vertex(b[0], b[1], from, normal, colour);
      this.vertex(c[0], c[1], to, normal, colour);
      this.vertex(d[0], d[1], to, normal, colour);
      this.index.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  }

  private lid(outline: readonly Point[], z: number, colour: number): void {
    const first = this.positions.length / 3;
    for (const [x, y] of outline) this.vertex(x, y, z, [0, 0, 1], colour);
    for (let k = 1; k + 1 < outline.length; k += 1) this.index.push(first, first + k, first + k + 1);
  }

  private vertex(x: number, y: number, z: number, normal: readonly [number, number, number], colour: number): void {
    this.positions.push(x, y, z);
    this.normals.push(...normal);
    this.colour.setHex(colour);
    this.colours.push(this.colour.r, this.colour.g, this.colour.b);
  }
}
