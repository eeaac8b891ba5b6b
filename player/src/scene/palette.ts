/** Colours: the place by category and theme, people by group. All as sRGB, 0xrrggbb. */

import type { Category } from "../world/world";
import { chance, pick } from "./chance";
import type { Theme } from "./scene";

export interface Skin {
  readonly background: number;
  readonly ground: number;
  /** Marks on the ground: grid, edges of areas. */
  readonly ink: number;
  readonly floor: number;
  readonly lawn: number;
  readonly plaza: number;
  readonly market: number;
  readonly gate: number;
  readonly wall: number;
  readonly roof: number;
  readonly wood: number;
  readonly leg: number;
  readonly counter: number;
  readonly sign: number;
  readonly canopy: number;
  readonly item: number;
  readonly panel: number;
  readonly plinth: number;
  readonly exhibit: number;
  readonly water: number;
  readonly leaf: number;
  readonly trunk: number;
  /** What people who do not matter just now fade into. */
  readonly mist: number;
  readonly select: number;
  readonly partner: number;
  readonly label: { readonly text: string; readonly back: string; readonly edge: string };
}

export const SKINS: Readonly<Record<Theme, Skin>> = {
  light: {
    background: 0xeae5dc, ground: 0xefebe3, ink: 0xada393, floor: 0xfbf9f5, lawn: 0xcfdbb4, plaza: 0xe3dac8,
    market: 0xf0e3cf, gate: 0xdd8f68, wall: 0xeee8de, roof: 0xfaf8f3, wood: 0xcaa377, leg: 0x8d775f,
    counter: 0xe9eceb, sign: 0x4f8f91, canopy: 0xf7f6f2, item: 0x6f7f8f, panel: 0x43505e, plinth: 0xf3efe8,
    exhibit: 0xc19a55, water: 0x9cc7d4, leaf: 0xa3b987, trunk: 0x9a8468, mist: 0xdcd6cb,
    select: 0xe4572e, partner: 0x2f86c9,
    label: { text: "#3a3631", back: "rgba(255,254,251,0.93)", edge: "rgba(90,80,66,0.20)" },
  },
  dark: {
    background: 0x171a1f, ground: 0x22262d, ink: 0x5a6470, floor: 0x343a43, lawn: 0x33453a, plaza: 0x332f2d,
    market: 0x342f2a, gate: 0xd98a63, wall: 0x3f4650, roof: 0x4a525d, wood: 0x9a7751, leg: 0x57483a,
    counter: 0x4a5460, sign: 0x56a0a1, canopy: 0x5a6470, item: 0x66788b, panel: 0x93a5b8, plinth: 0x525a65,
    exhibit: 0xb7924f, water: 0x35697c, leaf: 0x56704e, trunk: 0x5c4d3d, mist: 0x3a4049,
    select: 0xff7a4d, partner: 0x5fb4f2,
    label: { text: "#e9e6e0", back: "rgba(31,35,42,0.92)", edge: "rgba(255,255,255,0.14)" },
  },
};

/** The colour that stands for a category, on labels and in legends. */
export const CATEGORY_COLOURS: Readonly<Record<Category, number>> = {
  "building": 0x8b8578, "room": 0xb08bb0, "entrance": 0xdd8f68, "exhibit": 0xc19a55,
  "furniture": 0xa9743f, "outdoor area": 0x7fa35a, "item": 0x6f7f8f, "service area": 0x4f8f91,
};

/** Shirts that are told apart at a glance. */
const SHIRTS: readonly number[] = [
  0xd9534a, 0x2f78b7, 0xe9b13c, 0x3f9b72, 0x8c5fae, 0xe8824a, 0x49b3bf, 0xd56a94,
  0x7d9a3c, 0x30466f, 0xa8452f, 0x7fb0e0, 0xb49a72, 0x24706c, 0xc9a2d8, 0x6b4a3a,
];
const SHADES: readonly number[] = [1, 0.76, 1.22, 0.6];

/** The colour of a group; the first 16 differ in hue, later ones are lighter and darker shades of them. */
export function groupColour(group: number): number {
  const base = SHIRTS[group % SHIRTS.length]!;
  const shade = SHADES[Math.floor(group / SHIRTS.length) % SHADES.length]!;
  return shade > 1 ? mixed(base, 0xffffff, (shade - 1) * 1.6) : mixed(0x14161c, base, shade);
}

const SKIN_TONES = [0xf1cdb0, 0xe5b48f, 0xd39c74, 0xb57c55, 0x8d5b3c, 0x69412b, 0xf0c3a2];
const HAIR = [0x2a211c, 0x4a3426, 0x6e4b2e, 0x8f6b41, 0xc9a468, 0x1d1b1d, 0x8a8580, 0x7a3b24];
const TROUSERS = [0x2f3a4d, 0x3d4043, 0x6b6459, 0x52627a, 0x8a7b64, 0x2a2c33, 0x5a4b43, 0x9a9d9f, 0x43553f];

/** How somebody looks, apart from the posture. */
export interface Look {
  readonly shirt: number;
  readonly trousers: number;
  readonly skin: number;
  readonly hair: number;
  /** 0 dark to 1 white. */
  readonly shoes: number;
  readonly longSleeves: boolean;
  /** Bits in the order of `PARTS`. */
  readonly parts: number;
  /** As against the figure of 1.75 m. */
  readonly height: number;
  readonly girth: number;
}

/** The look of a person: the shirt from the group, the rest by chance, always the same. */
export function lookOf(person: number, group: number): Look {
  const style = chance(person, 11);
  const hair = style < 0.52 ? 1 : style < 0.86 ? 2 : 5;
  const small = style < 0.52 ? 0 : 0.045;
  const bag = chance(person, 12) < 0.16 && hair !== 2 ? 8 : 0;
  const lift = (chance(person, 13) - 0.5) * 0.14;
  const shirt = groupColour(group);
  return {
    shirt: lift > 0 ? mixed(shirt, 0xffffff, lift) : mixed(shirt, 0x000000, -lift),
    trousers: pick(TROUSERS, chance(person, 14)),
    skin: pick(SKIN_TONES, chance(person, 15)),
    hair: pick(HAIR, chance(person, 16)),
    shoes: pick([0, 0.08, 0.15, 0.9, 0.75], chance(person, 17)),
    longSleeves: chance(person, 18) < 0.6,
    parts: hair | bag,
    height: 0.945 - small + 0.12 * (chance(person, 19) * 0.6 + chance(person, 20) * 0.4),
    girth: 0.92 + 0.2 * chance(person, 21) * chance(person, 22) + 0.06 * chance(person, 23) - small * 0.8,
  };
}

/** A colour between two, in sRGB. */
export function mixed(a: number, b: number, share: number): number {
  const channel = (shift: number): number => {
    const from = (a >> shift) & 255;
    return Math.round(from + (((b >> shift) & 255) - from) * share) << shift;
  };
  return channel(16) | channel(8) | channel(0);
}

export const css = (colour: number): string => `#${colour.toString(16).padStart(6, "0")}`;
