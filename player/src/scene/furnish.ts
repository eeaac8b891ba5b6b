/** Furniture, counters, things and exhibits on their footprints. */

import type { Location } from "../world/world";
import { chance } from "./chance";
import type { Kind } from "./kinds";
import { mixed } from "./palette";
import { SEAT_Z } from "./skeleton";
import { area, disc, inset, rectangle, rounded, type Point } from "./solid";
import type { Site } from "./site";

const TABLE_Z = 0.74;
const COUNTER_Z = 1.04;
const SEAT_DEPTH_M = 0.62;

/** Builds what stands at a location; areas stay empty. */
export function furnish(site: Site, place: Location, kind: Kind, middle: Point): void {
  BUILDERS[kind]?.(site, place, middle);
}

type Builder = (site: Site, place: Location, middle: Point) => void;

/** A seat all along; a wide one has a planted middle to lean on. */
const bench: Builder = (site, { x, y, width, depth }) => {
  const { wood, leg, leaf, plinth } = site.skin;
  const narrow = Math.min(width, depth);
  slats(site, { x, y, width, depth }, SEAT_Z, wood);
  const feet = Math.max(2, Math.round(Math.max(width, depth) / 1.6));
  for (let k = 0; k < feet; k += 1) {
    const at = ((k + 0.5) / feet - 0.5) * Math.max(width, depth);
    if (width >= depth) site.mesh.box(area(x + at, y, 0.12, depth - 0.24), 0, SEAT_Z - 0.07, leg);
    else site.mesh.box(area(x, y + at, width - 0.24, 0.12), 0, SEAT_Z - 0.07, leg);
  }
  if (narrow < 1.9) return;
  const [w, d] = [width - 2 * SEAT_DEPTH_M, depth - 2 * SEAT_DEPTH_M];
  site.prism(rounded(x, y, w, d, 0.3, 5), 0, SEAT_Z + 0.28, plinth, { bevel: 0.04, top: mixed(leaf, 0x3a3020, 0.35) });
  plants(site, x, y, w - 0.3, d - 0.3);
};

function slats(
  site: Site,
  { x, y, width, depth }: { x: number; y: number; width: number; depth: number },
  top: number,
  colour: number,
): void {
  const across = Math.min(width, depth);
  if (across >= 1.9) return site.box(area(x, y, width, depth), top - 0.075, top, colour, { bevel: 0.02 });
  const n = Math.max(2, Math.round(across / 0.24));
  for (let k = 0; k < n; k += 1) {
    const at = ((k + 0.5) / n - 0.5) * across;
    const wide = across / n - 0.03;
    if (width >= depth) site.mesh.box(area(x, y + at, width, wide), top - 0.065, top, colour, { bevel: 0.012 });
    else site.mesh.box(area(x + at, y, wide, depth), top - 0.065, top, colour, { bevel: 0.012 });
  }
  site.casters.push({ x, y, width, depth, from: top - 0.06, to: top });
}

/** Bushes in a bed. */
function plants(site: Site, x: number, y: number, width: number, depth: number): void {
  const { leaf, roof } = site.skin;
  const step = 0.75;
  const [nx, ny] = [Math.max(1, Math.floor(width / step)), Math.max(1, Math.floor(depth / step))];
  for (let i = 0; i < nx; i += 1) {
    for (let j = 0; j < ny; j += 1) {
      const lot = chance(Math.round(x * 10) + i, Math.round(y * 10) + j);
      const [px, py] = [x + ((i + 0.5) / nx - 0.5) * width, y + ((j + 0.5) / ny - 0.5) * depth];
      site.mesh.ball(
        px + (lot - 0.5) * 0.2,
        py,
        SEAT_Z + 0.32,
        0.34 + 0.14 * lot,
        mixed(leaf, lot < 0.5 ? roof : 0, 0.12 * lot),
        0.9,
      );
    }
  }
}

/** A top on a pedestal set back far enough for knees. */
const table: Builder = (site, { x, y, width, depth }) => {
  const { wood, leg } = site.skin;
  const round = Math.min(width, depth) / Math.max(width, depth) > 0.85 && width < 2.2;
  const top = round ? disc(x, y, width / 2, depth / 2) : rounded(x, y, width, depth, 0.1, 3);
  site.prism(top, TABLE_Z - 0.05, TABLE_Z, wood, { bevel: 0.015 });
  const back = Math.min(0.5, width * 0.32, depth * 0.32);
  site.mesh.prism(rectangle(x, y, width - 2 * back, depth - 2 * back, 0.04), 0, TABLE_Z - 0.05, leg, { bevel: 0 });
};

/** A counter all round, a core behind it, and a flat canopy with a coloured fascia. */
const kiosk: Builder = (site, { x, y, width, depth }) => {
  const { counter, sign, canopy, wood, leg } = site.skin;
  site.box(area(x, y, width - 0.16, depth - 0.16), 0, COUNTER_Z - 0.05, counter, { bevel: 0 });
  site.mesh.box(area(x, y, width - 0.12, depth - 0.12), 0.0, 0.1, mixed(counter, leg, 0.5), { bevel: 0.01 });
  site.mesh.box(area(x, y, width, depth), COUNTER_Z - 0.05, COUNTER_Z, wood, { bevel: 0.015 });
  const [w, d] = [width - Math.min(1.3, width * 0.5), depth - Math.min(1.3, depth * 0.5)];
  site.box(area(x, y, w, d), COUNTER_Z, 2.3, mixed(counter, sign, 0.22), { bevel: 0.02 });
  const [ox, oy] = [width / 2 - 0.2, depth / 2 - 0.2];
  for (const [sx, sy] of [[1, 1], [-1, 1], [-1, -1], [1, -1]] as const) {
    site.mesh.box(area(x + sx * ox, y + sy * oy, 0.07, 0.07), COUNTER_Z, 2.36, leg, { bevel: 0 });
  }
  site.box(area(x, y, width - 0.1, depth - 0.1), 2.34, 2.56, sign, { bevel: 0.02, top: canopy });
  site.mesh.box(area(x, y, width - 0.34, depth - 0.34), 2.56, 2.6, canopy, { bevel: 0.02 });
};

/** A place too large to be one counter: an open frame that shows it without hiding who is in it. */
const frame: Builder = (site, { x, y, width, depth }) => {
  const { leg, sign } = site.skin;
  const [ox, oy] = [width / 2 - 0.06, depth / 2 - 0.06];
  for (const [sx, sy] of [[1, 1], [-1, 1], [-1, -1], [1, -1]] as const) {
    site.box(area(x + sx * ox, y + sy * oy, 0.1, 0.1), 0, 2.5, leg, { bevel: 0 });
  }
  for (const s of [-1, 1]) {
    site.box(area(x, y + s * oy, width, 0.1), 2.36, 2.56, sign, { bevel: 0.015 });
    site.box(area(x + s * ox, y, 0.1, depth - 0.2), 2.36, 2.56, sign, { bevel: 0.015 });
  }
};

/** A panel between posts, along the longer side. */
const board: Builder = (site, { x, y, width, depth }) => {
  const { panel, item, sign, plinth } = site.skin;
  const lies = width >= depth;
  const long = Math.max(width, depth);
  const tall = long > 5 ? 3.1 : 2.05;
  const face = (wide: number, thick: number, from: number, to: number, colour: number): void =>
    site.box(area(x, y, lies ? wide : thick, lies ? thick : wide), from, to, colour, { bevel: 0.015 });
  site.mesh.box(area(x, y, width, depth), 0, 0.05, plinth, { bevel: 0.02 });
  const posts = Math.max(2, Math.ceil(long / 4) + 1);
  for (let k = 0; k < posts; k += 1) {
    const at = (k / (posts - 1) - 0.5) * (long - 0.3);
    site.box(area(lies ? x + at : x, lies ? y : y + at, 0.1, 0.1), 0.04, tall - 0.1, item);
  }
  const bottom = long > 5 ? 2.05 : 0.95;
  face(long - 0.06, 0.16, bottom, tall, panel);
  face(long - 0.06, 0.18, tall - 0.14, tall, sign);
  const rows = Math.floor((tall - 0.24 - bottom) / 0.24);
  for (let k = 0; k < rows; k += 1) {
    const z = bottom + 0.1 + k * 0.24;
    site.mesh.box(
      area(x, y, lies ? long - 0.5 : 0.172, lies ? 0.172 : long - 0.5),
      z,
      z + 0.1,
      mixed(panel, plinth, 0.22),
      { bevel: 0 },
    );
  }
};

/** A row of cabinets with screens. */
const machines: Builder = (site, { x, y, width, depth }) => {
  const { item, panel, sign, plinth } = site.skin;
  const lies = width >= depth;
  const long = Math.max(width, depth);
  const deep = Math.min(width, depth);
  const n = Math.max(1, Math.round(long / 1.1));
  site.mesh.box(area(x, y, width, depth), 0, 0.06, plinth, { bevel: 0.02 });
  for (let k = 0; k < n; k += 1) {
    const at = ((k + 0.5) / n - 0.5) * long;
    const wide = (long / n) * 0.84;
    const [cx, cy] = lies ? [x + at, y] : [x, y + at];
    const size = (w: number, d: number): [number, number] => (lies ? [w, d] : [d, w]);
    site.box(area(cx, cy, ...size(wide, deep * 0.8)), 0.06, 1.62, item, { bevel: 0.04 });
    site.mesh.box(area(cx, cy, ...size(wide * 0.66, deep * 0.8 + 0.03)), 1.0, 1.42, panel, { bevel: 0 });
    site.mesh.box(area(cx, cy, ...size(wide, deep * 0.8 + 0.02)), 1.5, 1.58, sign, { bevel: 0 });
  }
};

const flag: Builder = (site, { x, y, width, depth }) => {
  const { gate, item, plinth } = site.skin;
  const foot = Math.min(width, depth) / 2;
  site.prism(disc(x, y, foot), 0, 0.12, plinth, { bevel: 0.03 });
  site.prism(disc(x, y, 0.045, 0.045, 8), 0.12, 3.2, item, { bevel: 0 });
  site.box(area(x + 0.52, y, 0.98, 0.03), 2.45, 3.12, gate, { bevel: 0 });
};

const cart: Builder = (site, { x, y, width, depth }) => {
  const { item, leg, sign, plinth } = site.skin;
  const [w, d] = [width * 0.86, depth * 0.8];
  for (const [sx, sy] of [[1, 1], [-1, 1], [-1, -1], [1, -1]] as const) {
    site.mesh.box(area(x + sx * w * 0.38, y + sy * d * 0.42, 0.16, 0.07), 0, 0.18, leg, { bevel: 0.02 });
  }
  site.box(area(x, y, w, d), 0.16, 0.86, mixed(item, plinth, 0.25), { bevel: 0.03 });
  site.mesh.box(area(x + w * 0.18, y, w * 0.5, d * 0.86), 0.86, 1.06, sign, { bevel: 0.04 });
  site.mesh.box(area(x - w * 0.46, y, 0.04, d), 0.86, 1.05, leg, { bevel: 0 });
};

const bin: Builder = (site, { x, y, width, depth }) => {
  const r = Math.min(width, depth, 1) / 2;
  site.prism(disc(x, y, r * 0.9), 0, 0.85, site.skin.item, { bevel: 0.02, taper: -0.05 });
  site.mesh.prism(disc(x, y, r * 0.75), 0.85, 0.9, site.skin.panel, { bevel: 0.02 });
};

const thing: Builder = (site, { x, y, width, depth }) => {
  const { item, plinth } = site.skin;
  site.box(area(x, y, width, depth), 0, 0.08, plinth, { bevel: 0.03 });
  site.prism(
    rounded(x, y, width * 0.82, depth * 0.82, 0.12, 4),
    0.08,
    0.95,
    item,
    { bevel: 0.05, top: mixed(item, plinth, 0.5) },
  );
};

const fountain: Builder = (site, { x, y, width, depth }) => {
  const { plinth, water } = site.skin;
  const rim = disc(x, y, width / 2, depth / 2, 40);
  site.prism(rim, 0, 0.42, plinth, { bevel: 0.04 });
  site.mesh.prism(inset(rim, 0.32), 0.42, 0.425, water, { bevel: 0 });
  const small = Math.min(width, depth);
  site.prism(disc(x, y, small * 0.07), 0.42, 1.05, plinth, { bevel: 0.03, taper: 0.02 });
  site.prism(disc(x, y, small * 0.1), 1.05, 1.2, plinth, { bevel: 0.02, taper: -small * 0.1 });
  site.mesh.prism(disc(x, y, small * 0.16), 1.2, 1.205, water, { bevel: 0 });
};

const pillar: Builder = (site, { x, y, width, depth }) => {
  const { plinth, exhibit, roof, panel } = site.skin;
  const r = Math.min(width, depth) / 2;
  site.prism(rounded(x, y, width, depth, r * 0.35, 5), 0, 0.3, plinth, { bevel: 0.04 });
  site.prism(disc(x, y, r * 0.42), 0.3, 2.7, plinth, { bevel: 0.02, taper: r * 0.06 });
  site.prism(
    rectangle(x, y, r * 1.15, r * 1.15, 0.08),
    2.7,
    2.7 + r * 1.05,
    exhibit,
    { bevel: 0.06, top: mixed(exhibit, roof, 0.4) },
  );
  for (const [w, d] of [[r * 0.8, r * 1.17], [r * 1.17, r * 0.8]] as const) {
    site.mesh.box(area(x, y, w, d), 2.7 + r * 0.14, 2.7 + r * 0.92, roof, { bevel: 0 });
    site.mesh.box(
      area(x, y, w * (w > d ? 1.005 : 0.08), d * (d > w ? 1.005 : 0.08)),
      2.7 + r * 0.5,
      2.7 + r * 0.84,
      panel,
      { bevel: 0 },
    );
  }
};

const vehicle: Builder = (site, { x, y, width, depth }) => {
  const { plinth, exhibit, panel, leg } = site.skin;
  site.box(area(x, y, width, depth), 0, 0.22, plinth, { bevel: 0.05 });
  const lies = width >= depth;
  const [w, d] = [width * 0.8, depth * 0.62];
  const body = rounded(x, y, lies ? w : width * 0.62, lies ? d : depth * 0.8, 0.45, 6);
  site.prism(inset(body, 0.1), 0.22, 0.5, leg, { bevel: 0 });
  site.prism(body, 0.42, 0.86, exhibit, { bevel: 0.12 });
  site.prism(
    inset(body, Math.min(w, d) * 0.1),
    0.86,
    1.28,
    mixed(panel, exhibit, 0.2),
    { bevel: 0.05, taper: Math.min(w, d) * 0.1, top: mixed(exhibit, plinth, 0.25) },
  );
};

const sculpture: Builder = (site, { x, y, width, depth }) => {
  const { plinth, exhibit } = site.skin;
  const r = Math.min(width, depth) / 2;
  site.box(area(x, y, width, depth), 0, 0.14, plinth, { bevel: 0.04 });
  site.box(area(x, y, width * 0.56, depth * 0.56), 0.14, 0.95, plinth, { bevel: 0.03 });
  const size = Math.min(r * 0.5, 0.55);
  site.mesh.ball(x, y, 0.93 + 1.7 * size, size * 0.82, exhibit, 2.05);
  site.casters.push({ x, y, width: size * 1.2, depth: size * 1.2, from: 0.95, to: 0.95 + 3 * size });
};

const BUILDERS: Readonly<Partial<Record<Kind, Builder>>> = {
  "service floor": frame,
  bench, table, kiosk, board, machines, flag, cart, bin, thing, fountain, pillar, vehicle, sculpture,
};
