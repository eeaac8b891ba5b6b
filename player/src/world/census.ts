/** How many people do what over time: the stacked strip under the time line. */

import { doingAt } from "./doing";
import { ACTIONS, type Action, type Doing, type World } from "./world";

/** What somebody in sight is seen doing; on the way, and after the last activity, it is `walk` and `stand`. */
export type Seen = Action | "walk" | "stand";

/** Bottom to top: standing and waiting, attending to things, being with each other, moving. */
export const SEEN_ORDER: readonly Seen[] = [
  "stand",
  "wait",
  "sit",
  "queue",
  "object interact",
  "look at",
  "read",
  "talk on phone",
  "discuss",
  "meet",
  "wave at",
  "carry",
  "wander",
  "enter/exit",
  "walk",
];

export interface Census {
  readonly nBins: number;
  /** Seconds that a bin covers. */
  readonly width: number;
  /** Count of people in sight, bin-major in `SEEN_ORDER`. */
  readonly counts: Uint32Array;
  /** The largest number of people in sight at once. */
  readonly most: number;
}

/** What a doing looks like from outside. Who waits for others, or for the time to come, is seen waiting. */
export function seen(doing: Doing): Seen {
  if (doing.phase === "walk") return "walk";
  if (doing.phase === "wait") return doing.activity?.action === "queue" ? "queue" : "wait";
  return doing.activity?.action ?? "stand";
}

/** Counts at the middle of each bin. */
export function takeCensus(world: World, nBins: number): Census {
  const { frames, people, duration } = world;
  const width = duration / nBins;
  const kinds = SEEN_ORDER.length;
  const place = new Map(SEEN_ORDER.map((kind, i) => [kind, i]));
  const counts = new Uint32Array(nBins * kinds);
  let most = 0;
  for (let bin = 0; bin < nBins; bin += 1) {
    const time = (bin + 0.5) * width;
    const frame = Math.min(Math.round(time / frames.dt), frames.nFrames - 1);
    let inSight = 0;
    for (const person of people) {
      if (frames.present[frame * frames.nAgents + person.id] !== 1) continue;
      counts[bin * kinds + place.get(seen(doingAt(person, time)))!]! += 1;
      inSight += 1;
    }
    most = Math.max(most, inSight);
  }
  return { nBins, width, counts, most };
}

/** The counts at a time, the most frequent first, without those that nobody does. */
export function countsAt(census: Census, time: number): { kind: Seen; count: number }[] {
  const bin = Math.max(0, Math.min(Math.floor(time / census.width), census.nBins - 1));
  return SEEN_ORDER.map((kind, i) => ({ kind, count: census.counts[bin * SEEN_ORDER.length + i]! }))
    .filter(({ count }) => count > 0)
    .sort((a, b) => b.count - a.count);
}

/** Whether the words of a search name this action. */
export function isAction(name: string): name is Action {
  return (ACTIONS as readonly string[]).includes(name);
}
