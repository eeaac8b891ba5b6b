/** The place built up: solids, floors and what throws shadows, from the locations. */

import type { Location, World } from "../world/world";
import type { Patch } from "./floor";
import { furnish } from "./furnish";
import { isSolid, kindOf, type Kind } from "./kinds";
import type { Occupancy } from "./occupancy";
import type { Skin } from "./palette";
import { floorPatch } from "./patches";
import { Site } from "./site";
import type { Point } from "./solid";
import { plantTrees } from "./trees";
import { buildWalls } from "./walls";
import { buildHall, buildGate } from "./halls";

export interface Built {
  readonly site: Site;
  readonly patches: readonly Patch[];
}

/** Everything that stands still, in the colours of a theme. */
export function buildPlace(world: World, occupancy: Occupancy, skin: Skin): Built {
  const site = new Site(skin);
  const places = world.locations;
  const patches: Patch[] = [];
  const middle = middleOf(places);
  for (const place of places) {
    const kind = kindOf(place, isSolid(place, places));
    const patch = floorPatch(place, kind, skin);
    if (patch !== null) patches.push(patch);
    raise(site, place, kind, { places, occupancy, middle });
  }
  plantTrees(site, places, occupancy);
  return { site, patches };
}

interface Surroundings {
  readonly places: readonly Location[];
  readonly occupancy: Occupancy;
  readonly middle: Point;
}

function raise(site: Site, place: Location, kind: Kind, around: Surroundings): void {
  if (kind === "hall") buildHall(site, place, around.places, around.middle);
  else if (kind === "gate") buildGate(site, place, around.places, around.middle);
  else if (kind === "open hall") buildWalls(
    site,
    place,
    { height: 1.25, thickness: 0.22 },
    around.places,
    around.occupancy,
  );
  else if (kind === "room") buildWalls(site, place, { height: 0.9, thickness: 0.12 }, around.places, around.occupancy);
  else furnish(site, place, kind, around.middle);
}

function middleOf(places: readonly Location[]): Point {
  if (places.length === 0) return [0, 0];
  const mean = (values: readonly number[]): number => values.reduce((a, b) => a + b, 0) / values.length;
  return [mean(places.map((p) => p.x)), mean(places.map((p) => p.y))];
}
