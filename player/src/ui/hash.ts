/** The part of the address after `#`: what a still picture, a link or a test asks the page to show. */

import type { Theme, View } from "../scene/scene";

export interface HashWishes {
  readonly t?: number;
  readonly play?: boolean;
  readonly speed?: number;
  readonly agent?: number;
  readonly group?: number;
  readonly follow?: boolean;
  readonly view?: View;
  readonly heat?: boolean;
  readonly names?: boolean;
  readonly theme?: Theme;
  readonly graph?: boolean;
  /** False leaves the scene alone on the page. */
  readonly ui?: boolean;
}

type Reader = (text: string) => unknown;

const SLOWEST = 0.1;
const FASTEST = 64;

const READERS: Record<keyof HashWishes, Reader> = {
  t: (text) => atLeast(0, text),
  play: flag,
  speed: (text) => bounded(atLeast(0, text)),
  agent: whole,
  group: whole,
  follow: flag,
  view: (text) => oneOf(["overview", "top", "street"], text),
  heat: flag,
  names: flag,
  theme: (text) => oneOf(["light", "dark"], text),
  graph: flag,
  ui: flag,
};

/** The wishes that can be understood; what cannot is as if it were not there. */
export function parseHash(hash: string): HashWishes {
  const wishes: Record<string, unknown> = {};
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    const value = Object.hasOwn(READERS, key) ? READERS[key as keyof HashWishes](text) : undefined;
    if (value !== undefined) wishes[key] = value;
  }
  return wishes as HashWishes;
}

function flag(text: string): boolean | undefined {
  return text === "1" ? true : text === "0" ? false : undefined;
}

function atLeast(least: number, text: string): number | undefined {
  const value = text.trim() === "" ? Number.NaN : Number(text);
  return Number.isFinite(value) && value >= least ? value : undefined;
}

function bounded(speed: number | undefined): number | undefined {
  return speed === undefined ? undefined : Math.min(Math.max(speed, SLOWEST), FASTEST);
}

function whole(text: string): number | undefined {
  return /^\d{1,9}$/.test(text) ? Number(text) : undefined;
}

function oneOf(known: readonly string[], text: string): string | undefined {
  return known.includes(text) ? text : undefined;
}
