/** The floor of a location. */

import type { Location } from "../world/world";
import { edgeTone, type Patch } from "./floor";
import type { Kind } from "./kinds";
import { mixed, type Skin } from "./palette";

/** The patch of floor that marks a location; null for what stands on the ground with its whole footprint. */
export function floorPatch(place: Location, kind: Kind, skin: Skin): Patch | null {
  const { x, y, width, depth } = place;
  const patch = (
    colour: number,
    edge: number,
    edgeWidth: number,
    radius: number,
  ): Patch => ({ x, y, width, depth, colour, edge, edgeWidth, radius });
  const round = Math.min(1.6, 0.18 * Math.min(width, depth));
  switch (kind) {
    case "room": return patch(skin.floor, edgeTone(skin.floor, skin.ink), 0.1, 0.12);
    case "open hall": return patch(
      mixed(skin.floor, skin.wall, 0.25),
      edgeTone(skin.floor, skin.ink, 0.45),
      0.14,
      0.12,
    );
    case "lawn": return patch(skin.lawn, mixed(skin.lawn, skin.ground, 0.45), 0.25, round);
    case "plaza": return patch(skin.plaza, mixed(skin.plaza, skin.ink, 0.22), 0.1, round * 0.6);
    case "market": return patch(skin.market, mixed(skin.market, skin.wood, 0.5), 0.12, 0.5);
    case "service floor": return patch(mixed(skin.floor, skin.sign, 0.1), mixed(skin.floor, skin.sign, 0.7), 0.16, 0.3);
    case "display floor": return patch(
      mixed(skin.floor, skin.exhibit, 0.12),
      mixed(skin.floor, skin.exhibit, 0.6),
      0.12,
      0.4,
    );
    case "gate": return patch(mixed(skin.ground, skin.gate, 0.2), mixed(skin.ground, skin.gate, 0.55), 0.08, 0.25);
    default: return null;
  }
}
