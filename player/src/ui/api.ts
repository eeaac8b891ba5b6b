/** `window.genc`: what scripts and tests may ask of the page. Stable; docs/player.md describes it. */

import type { Pick } from "../scene/scene";

export interface PlayerStats {
  readonly drawCalls: number;
  /** Median script time of the last 121 frames, in milliseconds: scene and panels. */
  readonly scriptMs: number;
  /** Frames drawn so far; it stands still while nothing moves. */
  readonly nFrames: number;
}

export interface PlayerApi {
  /** Kept once the world has been drawn for the first time. */
  readonly ready: Promise<void>;
  /** Seconds from the beginning of the world. */
  readonly time: number;
  readonly duration: number;
  readonly playing: boolean;
  /** The person in focus. */
  readonly selected: number | null;
  seek(time: number): void;
  play(): void;
  pause(): void;
  select(agent: number | null): void;
  pick(clientX: number, clientY: number): Pick;
  stats(): PlayerStats;
}

declare global {
  interface Window {
    genc?: PlayerApi;
  }
}
