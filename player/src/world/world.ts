/** A world as the player sees it: the content of one world file (docs/formats.md). Metres, seconds, radians; z up. */

export const CATEGORIES = [
  "building",
  "room",
  "entrance",
  "exhibit",
  "furniture",
  "outdoor area",
  "item",
  "service area",
] as const;
export type Category = (typeof CATEGORIES)[number];

export const ACTIONS = [
  "carry",
  "discuss",
  "enter/exit",
  "look at",
  "meet",
  "object interact",
  "queue",
  "read",
  "sit",
  "talk on phone",
  "wait",
  "wander",
  "wave at",
] as const;
export type Action = (typeof ACTIONS)[number];

/** An axis-aligned footprint. */
export interface Location {
  readonly name: string;
  readonly category: Category;
  /** Centre. */
  readonly x: number;
  readonly y: number;
  /** Extent along x and y. */
  readonly width: number;
  readonly depth: number;
}

/** How an activity ended; null for one that was never set off for. */
export type Status = "done" | "timeout" | "cut" | null;

/** One row of the activity table. Times that did not come are NaN. */
export interface Activity {
  readonly agent: number;
  readonly step: number;
  readonly action: Action;
  /** Index into `World.locations`. */
  readonly location: number;
  /** The joint doing: partners share this number. */
  readonly occasion: number;
  readonly partners: readonly number[];
  /** Needed by the plan, asked for by no node of the crowd graph. */
  readonly implied: boolean;
  readonly planStart: number;
  readonly planEnd: number;
  readonly status: Status;
  readonly leave: number;
  readonly arrive: number;
  readonly start: number;
  readonly end: number;
  readonly x: number;
  readonly y: number;
  readonly facing: number;
}

export interface Person {
  readonly id: number;
  readonly group: number;
  readonly speed: number;
  readonly activities: readonly Activity[];
}

export interface Group {
  readonly id: number;
  readonly caption: string;
  readonly members: readonly number[];
}

/** Everybody at every frame, frame-major: person `a` in frame `t` is entry `t * nAgents + a`. */
export interface Frames {
  readonly nFrames: number;
  readonly nAgents: number;
  /** Seconds between frames. */
  readonly dt: number;
  /** x, y in turn. */
  readonly positions: Float32Array;
  readonly headings: Float32Array;
  readonly present: Uint8Array;
}

export interface World {
  readonly provenance: Readonly<Record<string, string | number | null>>;
  readonly duration: number;
  readonly locations: readonly Location[];
  readonly groups: readonly Group[];
  readonly people: readonly Person[];
  readonly notes: readonly string[];
  readonly frames: Frames;
}

/**
 * What a person is up to at a moment: `walk` to an activity, `wait` there for it to begin, `do` it; `idle` after the
 * last one. Whether the person is in sight is `Frames.present`.
 */
export type Phase = "walk" | "wait" | "do" | "idle";

export interface Doing {
  readonly phase: Phase;
  /** The activity walked to, waited for or done; null where the person has none. */
  readonly activity: Activity | null;
}
