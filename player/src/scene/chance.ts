/** Chance that is the same every time: numbers from whole numbers. */

/** A number in [0, 1) that depends on its seeds only. */
export function chance(a: number, b = 0): number {
  let h = Math.imul(a ^ 0x9e3779b9, 0x85ebca6b) ^ Math.imul(b + 0x7f4a7c15, 0xc2b2ae35);
  h = Math.imul(h ^ (h >>> 15), 0x2c1b3c6d);
  h = Math.imul(h ^ (h >>> 12), 0x297a2d39);
  return ((h ^ (h >>> 15)) >>> 0) / 4294967296;
}

/** One of several, by a number in [0, 1). */
export function pick<T>(from: readonly T[], share: number): T {
  return from[Math.min(Math.floor(share * from.length), from.length - 1)]!;
}
