/** Trees on green areas, where nobody ever walks. */

import type { Location } from "../world/world";
import { chance } from "./chance";
import { kindOf, isSolid } from "./kinds";
import { wasNear, type Occupancy } from "./occupancy";
import { mixed } from "./palette";
import { disc } from "./solid";
import type { Site } from "./site";

const SPACING_M = 4.2;
const MOST = 14;
const CLEAR_M = 0.9;

export function plantTrees(site: Site, places: readonly Location[], occupancy: Occupancy): void {
  for (const [i, place] of places.entries()) {
    if (kindOf(place, isSolid(place, places)) !== "lawn") continue;
    const others = places.filter((other) => other !== place);
    const free = candidates(place, i).filter(
      ([x, y]) => !wasNear(occupancy, x, y, CLEAR_M) && !others.some((o) => covers(o, x, y))
    );
    for (const [k, [x, y]] of free.slice(0, MOST).entries()) plantTree(site, x, y, chance(i, 50 + k));
  }
}

function candidates({ x, y, width, depth }: Location, seed: number): [number, number][] {
  const points: [number, number][] = [];
  const [nx, ny] = [Math.floor((width - 2) / SPACING_M), Math.floor((depth - 2) / SPACING_M)];
  for (let i = 0; i <= nx; i += 1) {
    for (let j = 0; j <= ny; j += 1) {
      const lot = i * 97 + j;
      const px = x + (i - nx / 2) * SPACING_M + (chance(seed, lot) - 0.5) * 2;
      const py = y + (j - ny / 2) * SPACING_M + (chance(seed + 7, lot) - 0.5) * 2;
      points.push([px, py]);
    }
  }
  return points.sort(
    (a, b) => chance(
      Math.round(a[0] * 10),
      Math.round(a[1] * 10),
    ) - chance(Math.round(b[0] * 10), Math.round(b[1] * 10))
  );
}

const covers = (place: Location, x: number, y: number): boolean =>
  Math.abs(x - place.x) < place.width / 2 + 1.2 && Math.abs(y - place.y) < place.depth / 2 + 1.2;

export function plantTree(site: Site, x: number, y: number, lot: number): void {
  const { leaf, trunk, roof } = site.skin;
  const size = 0.75 + 0.5 * lot;
  const crown = 1.15 * size;
  const height = 1.7 + 0.7 * lot;
  site.mesh.prism(disc(x, y, 0.07, 0.07, 8), 0, height, trunk, { bevel: 0, taper: 0.02 });
  site.mesh.ball(x, y, height + crown * 0.75, crown, leaf, 1.05);
  site.mesh.ball(x + 0.5 * crown, y - 0.3 * crown, height + crown * 0.4, crown * 0.62, mixed(leaf, roof, 0.16), 1);
  site.mesh.ball(x - 0.5 * crown, y + 0.25 * crown, height + crown * 0.5, crown * 0.66, mixed(leaf, 0, 0.06), 1);
  for (const [from, to, wide] of [[0, 0.5, 1.2], [0.3, 1.1, 1.75], [0.9, 1.6, 1.35]] as const) {
    site.casters.push(
      { x, y, width: crown * wide, depth: crown * wide, from: height + from * crown * 0.8, to: height + to * crown }
    );
  }
}
