/** Soft shadows of everything that stands still, worked out once: sunlight and openness of the ground. */

import type { Bounds } from "./occupancy";

/** Something that throws a shadow: over a rectangle, or a disc in it, from one height to another. */
export interface Caster {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly depth: number;
  readonly from: number;
  readonly to: number;
}

export interface ShadeMap {
  readonly bounds: Bounds;
  readonly nx: number;
  readonly ny: number;
  /** Sunlight, then openness to the sky, 0 to 255, by cell. */
  readonly texels: Uint8Array<ArrayBuffer>;
}

const CELL_M = 0.1;
const MOST_CELLS = 1400;
const SOFT_M = 0.14;
const NOOK_M = 0.5;

/** `sun` points to the sun. */
export function buildShadeMap(
  bounds: Bounds,
  casters: readonly Caster[],
  sun: { x: number; y: number; z: number },
): ShadeMap {
  const cell = Math.max(CELL_M, (bounds.x1 - bounds.x0) / MOST_CELLS, (bounds.y1 - bounds.y0) / MOST_CELLS);
  const nx = Math.ceil((bounds.x1 - bounds.x0) / cell);
  const ny = Math.ceil((bounds.y1 - bounds.y0) / cell);
  const shadow = new Float32Array(nx * ny);
  const nook = new Float32Array(nx * ny);
  const grid = { bounds, cell, nx, ny };
  for (const caster of casters) {
    cast(shadow, grid, caster, [-sun.x / sun.z, -sun.y / sun.z]);
    if (caster.from < 0.3) cast(nook, grid, { ...caster, to: 0, from: 0 }, [0, 0]);
  }
  soften(shadow, nx, ny, Math.max(1, Math.round(SOFT_M / cell)));
  soften(nook, nx, ny, Math.max(1, Math.round(NOOK_M / cell)));
  const texels = new Uint8Array(2 * nx * ny);
  for (let i = 0; i < nx * ny; i += 1) {
    texels[2 * i] = Math.round(255 * (1 - Math.min(Math.max(shadow[i]!, 0), 1)));
    texels[2 * i + 1] = Math.round(255 * (1 - 0.5 * Math.min(Math.max(nook[i]!, 0), 1)));
  }
  return { bounds: { ...bounds, x1: bounds.x0 + nx * cell, y1: bounds.y0 + ny * cell }, nx, ny, texels };
}

interface Grid {
  readonly bounds: Bounds;
  readonly cell: number;
  readonly nx: number;
  readonly ny: number;
}

/** Marks the cells that lie in a caster's shadow; `drift` is how far a shadow goes by metre of height. */
function cast(into: Float32Array, grid: Grid, caster: Caster, drift: readonly [number, number]): void {
  const [x0, x1] = [caster.x - caster.width / 2, caster.x + caster.width / 2];
  const [y0, y1] = [caster.y - caster.depth / 2, caster.y + caster.depth / 2];
  const dx = [caster.from * drift[0], caster.to * drift[0]];
  const dy = [caster.from * drift[1], caster.to * drift[1]];
  const index = (v: number, origin: number, n: number): number => Math.min(
    Math.max(Math.floor((v - origin) / grid.cell), 0),
    n - 1,
  );
  const iTo = index(x1 + Math.max(...dx), grid.bounds.x0, grid.nx);
  const jTo = index(y1 + Math.max(...dy), grid.bounds.y0, grid.ny);
  for (let j = index(y0 + Math.min(...dy), grid.bounds.y0, grid.ny); j <= jTo; j += 1) {
    const y = grid.bounds.y0 + (j + 0.5) * grid.cell;
    const [ya, yb] = heights(y - y1, y - y0, drift[1], caster);
    for (let i = index(x0 + Math.min(...dx), grid.bounds.x0, grid.nx); i <= iTo; i += 1) {
      const x = grid.bounds.x0 + (i + 0.5) * grid.cell;
      const [xa, xb] = heights(x - x1, x - x0, drift[0], caster);
      if (Math.max(xa, ya) <= Math.min(xb, yb)) into[j * grid.nx + i] = 1;
    }
  }
}

/** Between which heights a point lies in the shadow of a strip. */
function heights(low: number, high: number, drift: number, { from, to }: Caster): readonly [number, number] {
  if (Math.abs(drift) < 1e-9) return low <= 0 && high >= 0 ? [from, to] : [1, 0];
  const [a, b] = drift > 0 ? [low / drift, high / drift] : [high / drift, low / drift];
  return [Math.max(a, from), Math.min(b, to)];
}

/** Three running means along each axis, in place. */
function soften(values: Float32Array, nx: number, ny: number, radius: number): void {
  const other = new Float32Array(values.length);
  for (let pass = 0; pass < 3; pass += 1) {
    meanAlong(values, other, nx, ny, radius);
    meanAcross(other, values, nx, ny, radius);
  }
}

function meanAlong(from: Float32Array, to: Float32Array, nx: number, ny: number, radius: number): void {
  for (let j = 0; j < ny; j += 1) {
    const first = j * nx;
    const at = (i: number): number => from[first + (i < 0 ? 0 : i >= nx ? nx - 1 : i)]!;
    let sum = 0;
    for (let i = -radius; i <= radius; i += 1) sum += at(i);
    for (let i = 0; i < nx; i += 1) {
      to[first + i] = sum / (2 * radius + 1);
      sum += at(i + radius + 1) - at(i - radius);
    }
  }
}

/** Whole rows at a time, which is as fast as along them. */
function meanAcross(from: Float32Array, to: Float32Array, nx: number, ny: number, radius: number): void {
  const sums = new Float32Array(nx);
  const change = (j: number, by: number): void => {
    const first = Math.min(Math.max(j, 0), ny - 1) * nx;
    for (let i = 0; i < nx; i += 1) sums[i]! += by * from[first + i]!;
  };
  for (let j = -radius; j < radius; j += 1) change(j, 1);
  for (let j = 0; j < ny; j += 1) {
    change(j + radius, 1);
    for (let i = 0; i < nx; i += 1) to[j * nx + i] = sums[i]! / (2 * radius + 1);
    change(j - radius, -1);
  }
}
