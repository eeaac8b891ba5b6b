/** Low walls round rooms and open buildings, only where nobody ever walks through: the doors are where people go. */

import type { Location } from "../world/world";
import { wasNear, type Occupancy } from "./occupancy";
import type { Site } from "./site";
import { area } from "./solid";

const STEP_M = 0.25;
const CLEAR_M = 0.5;
const SHORTEST_M = 1;

export interface WallSize {
  readonly height: number;
  readonly thickness: number;
}

/** One side of a rectangle: where it begins, which way it goes, how long it is. */
interface Side {
  readonly x: number;
  readonly y: number;
  readonly along: "x" | "y";
  readonly length: number;
}

export function buildWalls(
  site: Site,
  place: Location,
  size: WallSize,
  places: readonly Location[],
  occupancy: Occupancy,
): void {
  const obstacles = places.filter(
    (other) => other !== place && other.category !== "room" && other.category !== "outdoor area"
  );
  for (const side of sidesOf(place, size.thickness / 2)) {
    for (const [from, to] of runs(side, obstacles, occupancy)) {
      const [long, middle] = [to - from, (from + to) / 2];
      const [x, y] = side.along === "x" ? [side.x + middle, side.y] : [side.x, side.y + middle];
      const [width, depth] = side.along === "x" ? [long, size.thickness] : [size.thickness, long];
      site.box(area(x, y, width, depth), 0, size.height, site.skin.wall, { bevel: 0.025, top: site.skin.roof });
    }
  }
}

function sidesOf({ x, y, width, depth }: Location, inset: number): Side[] {
  const [x0, x1, y0, y1] = [x - width / 2 + inset, x + width / 2 - inset, y - depth / 2 + inset, y + depth / 2 - inset];
  const over = inset;
  return [
    { x: x0 - over, y: y0, along: "x", length: width },
    { x: x0 - over, y: y1, along: "x", length: width },
    { x: x0, y: y0 + over, along: "y", length: depth - 4 * over },
    { x: x1, y: y0 + over, along: "y", length: depth - 4 * over },
  ];
}

/** The parts of a side, in metres from its beginning, that are free of people and of other things. */
export function runs(side: Side, obstacles: readonly Location[], occupancy: Occupancy): [number, number][] {
  const found: [number, number][] = [];
  let from: number | null = 0;
  for (let at = 0; at <= side.length + 1e-6; at += STEP_M) {
    const [x, y] = side.along === "x" ? [side.x + at, side.y] : [side.x, side.y + at];
    const free = !wasNear(occupancy, x, y, CLEAR_M) && !obstacles.some((other) => touches(other, x, y));
    if (free) from ??= at;
    else if (from !== null) {
      if (at - STEP_M - from >= SHORTEST_M) found.push([from, at - STEP_M]);
      from = null;
    }
  }
  if (from !== null && side.length - from >= SHORTEST_M) found.push([from, side.length]);
  return found;
}

const touches = (other: Location, x: number, y: number): boolean =>
  Math.abs(x - other.x) < other.width / 2 + 0.15 && Math.abs(y - other.y) < other.depth / 2 + 0.15;
