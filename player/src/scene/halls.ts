/** Closed buildings, and the gates by which people come and go. */

import type { Location } from "../world/world";
import { hallHeight } from "./kinds";
import { mixed } from "./palette";
import { area, type Point } from "./solid";
import type { Site } from "./site";

const MODULE_M = 2.4;
const RELIEF_M = 0.03;

/** The sides of a footprint: which way each looks, its middle and its length. */
export interface Face {
  readonly nx: number;
  readonly ny: number;
  readonly x: number;
  readonly y: number;
  readonly length: number;
}

export function facesOf({ x, y, width, depth }: Location): [Face, Face, Face, Face] {
  return [
    { nx: 1, ny: 0, x: x + width / 2, y, length: depth },
    { nx: 0, ny: 1, x, y: y + depth / 2, length: width },
    { nx: -1, ny: 0, x: x - width / 2, y, length: depth },
    { nx: 0, ny: -1, x, y: y - depth / 2, length: width },
  ];
}

/** A white block with rows of windows and a slab for a roof, low enough to look over. */
export function buildHall(site: Site, place: Location, places: readonly Location[], middle: Point): void {
  const { x, y, width, depth } = place;
  const { wall, roof, panel, gate } = site.skin;
  const height = hallHeight(place);
  site.box(area(x, y, width, depth), 0, height, wall, { bevel: 0.06, top: roof });
  const eaves = Math.min(0.5, width / 6, depth / 6);
  site.mesh.box(area(x, y, width - 2 * eaves, depth - 2 * eaves), height, height + 0.16, roof, { bevel: 0.05 });
  const glass = mixed(wall, panel, 0.16);
  skylights(site, place, height + 0.16, mixed(roof, panel, 0.14));
  const door = places.some(
    (other) => other.category === "entrance" && touching(other, place)
  ) ? null : doorFace(place, middle);
  for (const face of facesOf(place)) {
    const n = Math.max(1, Math.floor((face.length - 0.8) / MODULE_M));
    for (let k = 0; k < n; k += 1) {
      const at = (k - (n - 1) / 2) * MODULE_M;
      if (isDoor(face, door) && Math.abs(at) < 1.6) continue;
      relief(site, face, { at, wide: 1.35, from: 0.9, to: height - 0.75, colour: glass });
    }
    if (isDoor(face, door)) {
      relief(site, face, { at: 0, wide: 2, from: 0, to: 2.25, colour: mixed(wall, gate, 0.85) });
      relief(site, face, { at: 0, wide: 1.72, from: 0, to: 2.1, colour: mixed(wall, panel, 0.55) }, 1.5);
    }
  }
}

/** Rows of low lanterns on a large roof. */
function skylights(site: Site, { x, y, width, depth }: Location, z: number, colour: number): void {
  const lies = width >= depth;
  const n = Math.floor(Math.max(width, depth) / 5);
  const span = 0.56 * Math.min(width, depth);
  for (let k = 0; k < n; k += 1) {
    const at = ((k + 0.5) / n - 0.5) * (Math.max(width, depth) - 3);
    site.mesh.box(
      area(lies ? x + at : x, lies ? y : y + at, lies ? 1.1 : span, lies ? span : 1.1),
      z,
      z + 0.2,
      colour,
      { bevel: 0.08, top: site.skin.roof },
    );
  }
}

const isDoor = (face: Face, door: Face | null): boolean => door !== null && face.nx === door.nx && face.ny === door.ny;

function touching(a: Location, b: Location): boolean {
  return Math.abs(a.x - b.x) <= (a.width + b.width) / 2 + 0.5 && Math.abs(a.y - b.y) <= (a.depth + b.depth) / 2 + 0.5;
}

/** Where people go in: the middle of the side nearest to the rest (docs/conventions.md). */
function doorFace(place: Location, middle: Point): Face {
  const far = (face: Face): number => Math.hypot(face.x - middle[0], face.y - middle[1]);
  return facesOf(place).reduce((best, face) => (far(face) < far(best) ? face : best));
}

interface Panel {
  /** Along the wall, from its middle. */
  readonly at: number;
  readonly wide: number;
  readonly from: number;
  readonly to: number;
  readonly colour: number;
}

/** A panel on a wall; `proud` is how many times as far as usual it stands out. */
function relief(site: Site, face: Face, { at, wide, from, to, colour }: Panel, proud = 1): void {
  const thick = 2 * RELIEF_M * proud;
  const [x, y] = [face.x - face.ny * at, face.y + face.nx * at];
  const over = face.nx === 0 ? area(x, y, wide, thick) : area(x, y, thick, wide);
  site.mesh.box(over, from, to, colour, { bevel: 0.01 });
}

const POST_M = 0.16;
const HEAD_M = 2.55;
const BEAM_M = 0.22;

/** A portal at the outer edge, or against the building that it leads into. */
export function buildGate(site: Site, place: Location, places: readonly Location[], middle: Point): void {
  const face = gateFace(place, places, middle);
  const { gate } = site.skin;
  const half = face.length / 2 - POST_M / 2;
  const [x, y] = [face.x - face.nx * POST_M, face.y - face.ny * POST_M];
  for (const at of [-half, half]) site.box(area(x - face.ny * at, y + face.nx * at, POST_M, POST_M), 0, HEAD_M, gate);
  const lies = face.nx === 0;
  site.box(area(x, y, lies ? face.length : POST_M, lies ? POST_M : face.length), HEAD_M - BEAM_M, HEAD_M, gate);
}

function gateFace(place: Location, places: readonly Location[], middle: Point): Face {
  const faces = facesOf(place);
  const house = places.find((other) => other.category === "building" && touching(place, other));
  const [tx, ty] = house === undefined ? [2 * place.x - middle[0], 2 * place.y - middle[1]] : [house.x, house.y];
  const dx = (tx - place.x) / (place.width + (house?.width ?? 0));
  const dy = (ty - place.y) / (place.depth + (house?.depth ?? 0));
  // A long gate is gone through across its length.
  const [kx, ky] = house === undefined ? [place.depth / place.width, place.width / place.depth] : [1, 1];
  if (Math.abs(dx) * kx > Math.abs(dy) * ky) return faces[dx > 0 ? 0 : 2];
  return faces[dy > 0 ? 1 : 3];
}
