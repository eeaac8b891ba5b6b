/** What a ray from the eye meets: people first, then places. */

import type { Location } from "../world/world";
import { AT, STRIDE } from "./cast";

export interface Ray {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Of unit length. */
  readonly dx: number;
  readonly dy: number;
  readonly dz: number;
}

const RADIUS_M = 0.24;
const FEET_M = 0.15;
const HEAD_M = 1.6;

/**
 * The person whose upright capsule the ray meets first, or null. `slack` widens the capsules by so much for every
 * metre of distance, so that a few pixels beside somebody far away will do.
 */
export function pickPerson(ray: Ray, values: Float32Array, count: number, slack: number): number | null {
  let best: number | null = null;
  let nearest = Infinity;
  for (let agent = 0; agent < count; agent += 1) {
    const base = STRIDE * agent;
    if (values[base + AT.presence]! <= 0.3) continue;
    const size = values[base + AT.height]!;
    const [gap, along] = gapToPost(ray, values[base]!, values[base + 1]!, FEET_M, HEAD_M * size);
    if (along <= 0) continue;
    const over = gap - RADIUS_M;
    if (over > slack * along) continue;
    // Who is met squarely goes before who is only near.
    const rank = along + 4 * Math.max(over, 0);
    if (rank < nearest) [best, nearest] = [agent, rank];
  }
  return best;
}

/** How near the ray comes to an upright line, and how far along the ray. */
export function gapToPost(ray: Ray, x: number, y: number, from: number, to: number): [number, number] {
  const [ox, oy, oz] = [ray.x - x, ray.y - y, ray.z];
  const flat = ray.dx * ray.dx + ray.dy * ray.dy;
  let along = flat < 1e-9 ? 0 : -(ox * ray.dx + oy * ray.dy) / flat;
  const height = Math.min(Math.max(oz + along * ray.dz, from), to);
  along = -(ox * ray.dx + oy * ray.dy + (oz - height) * ray.dz);
  const gap = Math.hypot(ox + along * ray.dx, oy + along * ray.dy, oz + along * ray.dz - height);
  return [gap, along];
}

/** The place that the ray meets first; on the floor the smallest of those that lie over each other. */
export function pickLocation(ray: Ray, places: readonly Location[], heights: readonly number[]): number | null {
  let best: number | null = null;
  let nearest = Infinity;
  places.forEach((place, i) => {
    const along = entryOf(ray, place, heights[i]!);
    if (along === null) return;
    const same = Math.abs(along - nearest) < 0.2 && best !== null;
    const smaller = same && place.width * place.depth < places[best!]!.width * places[best!]!.depth;
    if (smaller || (!same && along < nearest)) [best, nearest] = [i, along];
  });
  return best;
}

/** How far along a ray enters a box on the ground; null where it misses. */
export function entryOf(ray: Ray, place: Location, height: number): number | null {
  let [from, to] = [0, Infinity];
  const slabs = [
    [ray.x, ray.dx, place.x - place.width / 2, place.x + place.width / 2],
    [ray.y, ray.dy, place.y - place.depth / 2, place.y + place.depth / 2],
    [ray.z, ray.dz, -0.01, height],
  ] as const;
  for (const [origin, way, low, high] of slabs) {
    if (Math.abs(way) < 1e-9) {
      if (origin < low || origin > high) return null;
      continue;
    }
    const [a, b] = [(low - origin) / way, (high - origin) / way];
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
  }
  return from <= to ? from : null;
}
