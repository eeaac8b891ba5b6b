/** Where people were over the whole time: seconds by square, and colours for them. */

import type { Frames, Location } from "../world/world";
import type { HeatStop } from "./scene";
import { STILL_M } from "./track";

export const CELL_M = 0.25;
/** Ground round everything (docs/conventions.md), and a little more. */
const MARGIN_M = 6.5;

export interface Bounds {
  readonly x0: number;
  readonly y0: number;
  readonly x1: number;
  readonly y1: number;
}

export interface Occupancy {
  readonly bounds: Bounds;
  readonly nx: number;
  readonly ny: number;
  /** Person-seconds by cell, rows along x. */
  readonly seconds: Float32Array;
  /** 1 where anybody ever was, on the way included. */
  readonly touched: Uint8Array;
}

/** The rectangle round all locations. */
export function boundsOf(locations: readonly Location[], margin = 0): Bounds {
  if (locations.length === 0) return { x0: -10, y0: -10, x1: 10, y1: 10 };
  return {
    x0: Math.min(...locations.map((l) => l.x - l.width / 2)) - margin,
    y0: Math.min(...locations.map((l) => l.y - l.depth / 2)) - margin,
    x1: Math.max(...locations.map((l) => l.x + l.width / 2)) + margin,
    y1: Math.max(...locations.map((l) => l.y + l.depth / 2)) + margin,
  };
}

export function buildOccupancy(frames: Frames, locations: readonly Location[]): Occupancy {
  const bounds = boundsOf(locations, MARGIN_M);
  const nx = Math.ceil((bounds.x1 - bounds.x0) / CELL_M);
  const ny = Math.ceil((bounds.y1 - bounds.y0) / CELL_M);
  const seconds = new Float32Array(nx * ny);
  const touched = new Uint8Array(nx * ny);
  const cell = (x: number, y: number): number => {
    const i = Math.floor((x - bounds.x0) / CELL_M);
    const j = Math.floor((y - bounds.y0) / CELL_M);
    return i < 0 || j < 0 || i >= nx || j >= ny ? -1 : j * nx + i;
  };
  const { positions, present, nAgents, dt } = frames;
  for (let entry = 0; entry < present.length; entry += 1) {
    if (present[entry] !== 1) continue;
    const [x, y] = [positions[2 * entry]!, positions[2 * entry + 1]!];
    const here = cell(x, y);
    if (here < 0) continue;
    seconds[here]! += dt;
    touched[here] = 1;
    const before = entry - nAgents;
    if (before < 0 || present[before] !== 1) continue;
    const [px, py] = [positions[2 * before]!, positions[2 * before + 1]!];
    if (Math.abs(px - x) + Math.abs(py - y) < STILL_M) continue;
    const between = cell((x + px) / 2, (y + py) / 2);
    if (between >= 0) touched[between] = 1;
  }
  return { bounds, nx, ny, seconds, touched };
}

/** Whether anybody ever came within a radius of a point. */
export function wasNear(occupancy: Occupancy, x: number, y: number, radius: number): boolean {
  const { bounds, nx, ny, touched } = occupancy;
  const reach = Math.ceil(radius / CELL_M);
  const ci = Math.floor((x - bounds.x0) / CELL_M);
  const cj = Math.floor((y - bounds.y0) / CELL_M);
  for (let j = Math.max(cj - reach, 0); j <= Math.min(cj + reach, ny - 1); j += 1) {
    for (let i = Math.max(ci - reach, 0); i <= Math.min(ci + reach, nx - 1); i += 1) {
      const far = Math.hypot(bounds.x0 + (i + 0.5) * CELL_M - x, bounds.y0 + (j + 0.5) * CELL_M - y);
      if (touched[j * nx + i] === 1 && far <= radius) return true;
    }
  }
  return false;
}

/** Person-seconds within a location and a margin round it. */
export function useOf(occupancy: Occupancy, place: Location, margin: number): number {
  const { bounds, nx, ny, seconds } = occupancy;
  const index = (v: number, from: number, n: number): number => Math.min(
    Math.max(Math.floor((v - from) / CELL_M), 0),
    n - 1,
  );
  let sum = 0;
  const j1 = index(place.y + place.depth / 2 + margin, bounds.y0, ny);
  const i1 = index(place.x + place.width / 2 + margin, bounds.x0, nx);
  for (let j = index(place.y - place.depth / 2 - margin, bounds.y0, ny); j <= j1; j += 1) {
    for (let i = index(place.x - place.width / 2 - margin, bounds.x0, nx); i <= i1; i += 1) sum += seconds[j * nx + i]!;
  }
  return sum;
}

export interface HeatMap {
  readonly nx: number;
  readonly ny: number;
  /** sRGB and alpha by cell. */
  readonly pixels: Uint8Array<ArrayBuffer>;
  /** From little used to much used, on a logarithmic scale. */
  readonly legend: readonly HeatStop[];
}

/** Least use that is shown, in person-seconds by square metre. */
const LEAST = 1;

export function buildHeatMap(occupancy: Occupancy): HeatMap {
  const { nx, ny } = occupancy;
  const use = blurred(occupancy.seconds, nx, ny).map((s) => s / (CELL_M * CELL_M));
  const used = use.filter((s) => s > LEAST).sort();
  const most = Math.max(used[Math.floor(used.length * 0.998)] ?? 0, 10 * LEAST);
  const pixels = new Uint8Array(4 * nx * ny);
  const shareOf = (value: number): number => Math.min(Math.max(Math.log(value / LEAST) / Math.log(most / LEAST), 0), 1);
  use.forEach((value, i) => {
    const share = value > 0 ? shareOf(value) : 0;
    pixels.set(
      [
        ...inferno(0.12 + 0.86 * share),
        Math.round(255 * Math.min(1, value / LEAST) * (0.35 + 0.6 * Math.min(1, 3 * share))),
      ],
      4 * i,
    );
  });
  const legend = Array.from({ length: 7 }, (_, k): HeatStop => {
    const [r, g, b] = inferno(0.12 + (0.86 * k) / 6);
    return { value: LEAST * (most / LEAST) ** (k / 6), colour: `rgb(${r}, ${g}, ${b})` };
  });
  return { nx, ny, pixels, legend };
}

/** Four times the mean with the neighbours: about a Gaussian of 0.35 m. */
function blurred(values: Float32Array, nx: number, ny: number): Float32Array {
  let from = values;
  const axes = [[1, nx], [nx, ny]] as const;
  for (const [step, n] of [...axes, ...axes, ...axes, ...axes]) {
    const to = new Float32Array(from.length);
    for (let i = 0; i < from.length; i += 1) {
      const at = step === 1 ? i % nx : Math.floor(i / nx);
      const before = at > 0 ? from[i - step]! : from[i]!;
      const after = at + 1 < n ? from[i + step]! : from[i]!;
      to[i] = 0.25 * before + 0.5 * from[i]! + 0.25 * after;
    }
    from = to;
  }
  return from;
}

/** matplotlib's inferno, sampled. */
const INFERNO: readonly number[] = [
  0x000004, 0x160b39, 0x420a68, 0x6a176e, 0x932667, 0xbc3754, 0xdd513a, 0xf37819, 0xfca50a, 0xf6d746, 0xfcffa4,
];

/** A colour of the scale, 0 to 1. */
export function inferno(share: number): [number, number, number] {
  const at = Math.min(Math.max(share, 0), 1) * (INFERNO.length - 1);
  const i = Math.min(Math.floor(at), INFERNO.length - 2);
  const channel = (shift: number): number => {
    const a = (INFERNO[i]! >> shift) & 255;
    return Math.round(a + (((INFERNO[i + 1]! >> shift) & 255) - a) * (at - i));
  };
  return [channel(16), channel(8), channel(0)];
}
