/** Where the camera stands for the standard views. */

import { Vector3 } from "three";
import type { Location, World } from "../world/world";
import type { CameraRig, Shot } from "./camera";
import { kindsOf } from "./kinds";
import { boundsOf, useOf, type Occupancy } from "./occupancy";
import type { View } from "./scene";

const OVERVIEW = new Vector3(0.2, -0.8, 0.72);
const EYE_M = 2.3;
const STREET_M = 13;

export function shotFor(view: View, world: World, occupancy: Occupancy, rig: CameraRig): Shot {
  const areas = world.locations.length > 0 ? world.locations.map((place) => boundsOf([place], 1.5)) : [boundsOf([])];
  if (view === "overview") return rig.framing(areas, OVERVIEW, 3.5);
  // A hair off the vertical, so that north stays up.
  if (view === "top") return rig.framing(areas, new Vector3(0, -0.002, 1), 0);
  return streetShot(world, occupancy);
}

/** A shot that shows a location and a little around it. */
export function shotOfLocation(place: Location, rig: CameraRig): Shot {
  const margin = Math.max(1.5, 4 - Math.min(place.width, place.depth) / 2);
  return rig.framing([boundsOf([place], margin)], OVERVIEW, 2);
}

/** At eye level before the busiest place, from the most open side. */
function streetShot(world: World, occupancy: Occupancy): Shot {
  const busiest = busiestSpot(world, occupancy);
  const target = new Vector3(busiest[0], busiest[1], 1.05);
  const kinds = kindsOf(world);
  const high = world.locations.filter(
    (_, i) => ["hall", "kiosk", "machines", "board", "vehicle", "pillar"].includes(kinds[i]!)
  );
  let best = new Vector3();
  let least = Infinity;
  for (let k = 0; k < 24; k += 1) {
    const angle = -Math.PI / 2 + 0.35 + (k * 2 * Math.PI) / 24;
    const eye = new Vector3(target.x + STREET_M * Math.cos(angle), target.y + STREET_M * Math.sin(angle), EYE_M);
    const cost = high.reduce(
      (sum, place) => sum + blocking(place, eye, target),
      0,
    ) + 0.02 * Math.min(k, 24 - k) - 0.15 * Math.sin(-angle);
    if (cost < least) [best, least] = [eye, cost];
  }
  return { eye: best, target };
}

/** How much of the way between two points a place is in the way of. */
function blocking(place: Location, a: Vector3, b: Vector3): number {
  let hits = 0;
  for (let k = 0; k <= 20; k += 1) {
    const x = a.x + ((b.x - a.x) * k) / 20;
    const y = a.y + ((b.y - a.y) * k) / 20;
    const near = Math.abs(x - place.x) < place.width / 2 + 0.8 && Math.abs(y - place.y) < place.depth / 2 + 0.8;
    if (near) hits += k < 14 ? 2 : 0.3;
  }
  return hits;
}

function busiestSpot(world: World, occupancy: Occupancy): [number, number] {
  let best: readonly [number, number] = [0, 0];
  let most = -1;
  for (const place of world.locations) {
    const use = useOf(occupancy, place, 1.5) / Math.sqrt((place.width + 3) * (place.depth + 3));
    if (use > most) [best, most] = [[place.x, place.y], use];
  }
  return [best[0], best[1]];
}
