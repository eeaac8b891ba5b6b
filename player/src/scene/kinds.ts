/** What a location is built as: its category, size, what lies in it, and what its name says. */

import type { Location, World } from "../world/world";

export type Kind =
  | "hall" | "open hall" | "room" | "gate" | "lawn" | "plaza"
  | "bench" | "table" | "market" | "kiosk" | "service floor"
  | "board" | "machines" | "flag" | "cart" | "bin" | "thing"
  | "fountain" | "pillar" | "vehicle" | "sculpture" | "display floor";

/** Larger things are areas that people walk in (docs/conventions.md). */
const LARGE_M2 = 40;
const BENCH_WIDTH_M = 1.3;

const GREEN = /lawn|garden|park|quad|meadow|grass|green\b|grove|field|orchard|lake|pond|bank|hill/;
const BENCH = /bench|seat(?!ing)|sofa|couch|pew|ledge|wall\b|steps|stands?\b|bleacher|lounger/;

/** Whether another location, not an entrance, lies inside. */
export function holdsAnother(place: Location, places: readonly Location[]): boolean {
  return places.some((other) => other !== place && other.category !== "entrance" && holds(place, other));
}

function holds(place: Location, other: Location): boolean {
  const within = (a: number, b: number, size: number): boolean => Math.abs(b - a) < size / 2 - Math.min(0.5, size / 4);
  return within(place.x, other.x, place.width) && within(place.y, other.y, place.depth);
}

/** Whether people keep out of its footprint. */
export function isSolid(place: Location, places: readonly Location[]): boolean {
  if (place.category === "building") return !holdsAnother(place, places);
  if (place.category === "room" || place.category === "outdoor area" || place.category === "entrance") return false;
  return place.width * place.depth <= LARGE_M2 && !holdsAnother(place, places);
}

export function kindsOf(world: World): Kind[] {
  return world.locations.map((place) => kindOf(place, isSolid(place, world.locations)));
}

export function kindOf(place: Location, solid: boolean): Kind {
  const name = place.name.toLowerCase();
  switch (place.category) {
    case "building": return solid ? "hall" : "open hall";
    case "room": return "room";
    case "entrance": return "gate";
    case "outdoor area": return GREEN.test(name) ? "lawn" : "plaza";
    case "service area": return solid ? "kiosk" : "service floor";
    case "furniture": return solid ? furnitureKind(place, name) : "market";
    case "item": return solid ? itemKind(place, name) : "display floor";
    case "exhibit": return solid ? exhibitKind(place, name) : "display floor";
  }
}

function furnitureKind(place: Location, name: string): Kind {
  if (/table|desk|counter|stall|stool/.test(name)) return "table";
  const narrow = Math.min(
    place.width,
    place.depth,
  ) <= BENCH_WIDTH_M && Math.max(place.width, place.depth) >= 2 * Math.min(place.width, place.depth);
  return narrow || BENCH.test(name) ? "bench" : "table";
}

function itemKind(place: Location, name: string): Kind {
  if (/board|map|sign|screen|poster|timetable|notice|display/.test(name)) return "board";
  if (/flag|banner|beacon|lamp|pole/.test(name)) return "flag";
  if (/machine|atm|locker|kiosk|terminal|vending|rack|shelf|cabinet/.test(name)) return "machines";
  if (/cart|trolley|barrow|wagon|stroller/.test(name)) return "cart";
  if (/\bbin\b|trash|basket|bucket/.test(name)) return "bin";
  return place.width * place.depth > 6 ? "machines" : "thing";
}

function exhibitKind(place: Location, name: string): Kind {
  if (/fountain|pool|basin|aquarium|well\b/.test(name)) return "fountain";
  if (/pillar|clock|column|tower|obelisk|totem|tree|mast/.test(name)) return "pillar";
  if (/\bcar\b|bus|tram|engine|locomotive|vehicle|boat|plane|carriage|train/.test(name)) return "vehicle";
  return place.width * place.depth > 24 ? "vehicle" : "sculpture";
}

/** How high a location reaches, for pointing at it. */
export function heightOf(place: Location, kind: Kind): number {
  switch (kind) {
    case "hall": return hallHeight(place);
    case "kiosk": return 2.6;
    case "board": case "flag": case "pillar": return 2.4;
    case "machines": case "vehicle": case "sculpture": return 1.7;
    case "bench": return 0.45;
    case "table": return 0.74;
    case "cart": case "bin": case "thing": case "fountain": return 0.9;
    default: return 0.01;
  }
}

/** Low enough to look over, higher for larger ones. */
export const hallHeight = (place: Location): number => Math.min(
  Math.max(0.24 * Math.min(place.width, place.depth), 3),
  5.2,
);
