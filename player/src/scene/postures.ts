/** From the activity table and the frames to what each body does when: a row of stretches for every person. */

import type { Action, Activity, Location, Person, World } from "../world/world";
import { chance, pick } from "./chance";
import { kindsOf, type Kind } from "./kinds";
import type { ClipName } from "./poses";
import type { Track } from "./track";

/** Time between two postures. */
export const CHANGE_S = 0.45;
const SHORTEST_S = 0.3;
const GREETING_S = 1.8;
const MOVING_MPS = 0.12;
/** From the edge of a bench inwards to who sits on it. */
const ON_BENCH_M = 0.22;
const SEAT_REACH_M = 0.75;

/** A bench seat: who sits is drawn on it, though the slot lies before it. */
export interface Seat {
  readonly x: number;
  readonly y: number;
  readonly heading: number;
}

export interface Stretch {
  readonly start: number;
  readonly clip: ClipName;
  /** What it is while somebody else of the occasion speaks; null where nobody speaks. */
  readonly listening: ClipName | null;
  /** Everybody of the conversation, ascending; the occasion is what turns are drawn by. */
  readonly circle: readonly number[];
  readonly occasion: number;
  readonly seat: Seat | null;
}

interface Bearing {
  readonly clip: ClipName;
  readonly listening?: ClipName;
  readonly circle?: readonly number[];
  readonly occasion?: number;
  readonly seat?: Seat | null;
}

/** What everybody does when, by person, each without gaps from -Infinity on. */
export function buildStretches(world: World, track: Track): Stretch[][] {
  const kinds = kindsOf(world);
  return world.people.map((person) => new PersonStretches(world, kinds, person, track).build());
}

/** The last stretch that has begun; `from` is a guess, as a rule the answer of the moment before. */
export function stretchAt(stretches: readonly Stretch[], time: number, from: number): number {
  let i = Math.min(from, stretches.length - 1);
  if (stretches[i]!.start <= time && (i + 1 === stretches.length || stretches[i + 1]!.start > time)) return i;
  let low = 0;
  let high = stretches.length;
  while (low < high) {
    i = (low + high) >> 1;
    if (stretches[i]!.start <= time) low = i + 1;
    else high = i;
  }
  return Math.max(low - 1, 0);
}

interface Move {
  readonly start: number;
  readonly end: number;
  readonly speed: number;
}

class PersonStretches {
  private readonly moves: readonly Move[];
  private readonly world: World;
  private readonly kinds: readonly Kind[];
  private readonly person: Person;

  constructor(world: World, kinds: readonly Kind[], person: Person, track: Track) {
    this.world = world;
    this.kinds = kinds;
    this.person = person;
    this.moves = movesOf(track, person.id);
  }

  build(): Stretch[] {
    const edges = this.edges();
    const found: Stretch[] = [];
    edges.forEach((start, i) => {
      const end = edges[i + 1] ?? start + 2;
      if (found.length > 0 && end - start < SHORTEST_S) return;
      const stretch = this.stretch(start, (Math.max(start, 0) + end) / 2);
      const last = found.at(-1);
      if (last === undefined || !alike(last, stretch)) found.push(stretch);
    });
    return found;
  }

  private edges(): number[] {
    const times: number[] = [];
    for (const move of this.moves) times.push(move.start, move.end);
    for (const activity of this.person.activities) {
      const { leave, arrive, start, end, action } = activity;
      times.push(...[leave, arrive, start, end].filter((time) => !Number.isNaN(time)));
      if (action === "meet" && !Number.isNaN(start)) times.push(start + GREETING_S);
    }
    // What begins at the beginning has been going on before.
    return [-Infinity, ...[...new Set(times)].filter((time) => time > 0.01).sort((a, b) => a - b)];
  }

  private stretch(start: number, time: number): Stretch {
    const activity = this.person.activities.findLast(
      (candidate) => candidate.leave <= time && !(candidate.end <= time)
    ) ?? null;
    const move = this.moves.find((candidate) => candidate.start <= time && time < candidate.end);
    const bearing = move === undefined ? this.standing(activity, time) : walkingBearing(activity, move, time);
    const { clip, listening = null, circle = [], occasion = 0, seat = null } = bearing;
    return { start, clip, listening, circle, occasion, seat };
  }

  private standing(activity: Activity | null, time: number): Bearing {
    if (activity === null || !(activity.arrive <= time)) return { clip: this.idle() };
    const kind = this.kinds[activity.location];
    const seat = kind === "bench" ? seatOn(this.world.locations[activity.location]!, activity) : null;
    const atSeat = (kind === "bench" && seat !== null) || (
      kind === "table" && nearby(this.world.locations[activity.location]!, activity)
    );
    if (!(activity.start <= time)) return this.waiting(activity, atSeat, seat);
    return this.doing(activity, atSeat, seat, time);
  }

  private waiting(activity: Activity, atSeat: boolean, seat: Seat | null): Bearing {
    if (activity.action === "sit" || (atSeat && SEATED.has(activity.action))) return { clip: "sit", seat };
    return { clip: activity.action === "queue" ? "clasp" : this.idle() };
  }

  private doing(activity: Activity, atSeat: boolean, seat: Seat | null, time: number): Bearing {
    const seated = activity.action === "sit" || (atSeat && SEATED.has(activity.action));
    if (activity.action === "discuss" || activity.action === "meet") return this.talking(activity, seated, seat, time);
    if (seated) return { clip: SITTING[activity.action] ?? "sit", seat };
    if (activity.action === "wait") return { clip: pick(["fold", "clasp", "stand"], chance(this.person.id, 3)) };
    return { clip: STANDING[activity.action] };
  }

  private talking(activity: Activity, seated: boolean, seat: Seat | null, time: number): Bearing {
    if (!seated && activity.action === "meet" && time < activity.start + GREETING_S && this.shakesHands(activity)) {
      return { clip: "greet" };
    }
    const circle = [this.person.id, ...activity.partners].sort((a, b) => a - b);
    const listens = chance(this.person.id, 5) < 0.4 ? "listenFold" : "listen";
    const clips: Bearing = seated ? { clip: "sitTalk", listening: "sitListen" } : { clip: "talk", listening: listens };
    return { ...clips, circle, occasion: activity.occasion, seat: seated ? seat : null };
  }

  private shakesHands(activity: Activity): boolean {
    if (activity.partners.length !== 1) return false;
    const partner = this.world.people[activity.partners[0]!];
    const theirs = partner?.activities.find((other) => other.occasion === activity.occasion);
    if (theirs === undefined || theirs.start !== activity.start) return false;
    return Math.hypot(theirs.x - activity.x, theirs.y - activity.y) < 1.1;
  }

  private idle(): ClipName {
    return pick(["stand", "clasp", "stand"], chance(this.person.id, 4));
  }
}

/** What people do sitting where there are seats. */
const SEATED: ReadonlySet<Action> = new Set<Action>(
  ["sit", "read", "talk on phone", "discuss", "meet", "object interact"]
);
const SITTING: Partial<Record<Action, ClipName>> = {
  read: "sitRead", "talk on phone": "sitPhone", "object interact": "sitUse",
};

/** What people do standing, or anyhow. */
export const STANDING: Readonly<Record<Action, ClipName>> = {
  "carry": "carry",
  "discuss": "talk",
  "enter/exit": "stand",
  "look at": "look",
  "meet": "talk",
  "object interact": "use",
  "queue": "clasp",
  "read": "read",
  "sit": "sit",
  "talk on phone": "phone",
  "wait": "stand",
  "wander": "stand",
  "wave at": "wave",
};

function walkingBearing(activity: Activity | null, move: Move, time: number): Bearing {
  if (activity?.action === "carry") return { clip: "walkCarry" };
  if (activity?.action === "talk on phone" && activity.start <= time) return { clip: "walkPhone" };
  if (move.speed < 0.9) return { clip: "stroll" };
  return { clip: move.speed < 1.3 ? "walk" : "stride" };
}

function alike(a: Stretch, b: Stretch): boolean {
  return a.clip === b.clip && a.occasion === b.occasion && a.seat?.x === b.seat?.x && a.seat?.y === b.seat?.y;
}

/** When a person is on the way, from the frames; short stops on the way are part of it. */
export function movesOf(track: Track, agent: number): Move[] {
  const { nFrames, nAgents, dt } = track.frames;
  const moves: Move[] = [];
  let first = -1;
  let last = -1;
  const close = (): void => {
    if (first < 0) return;
    const far = track.walked[last * nAgents + agent]! - track.walked[first * nAgents + agent]!;
    moves.push({ start: first * dt, end: last * dt, speed: far / ((last - first) * dt) });
    first = -1;
  };
  for (let frame = 0; frame + 1 < nFrames; frame += 1) {
    const step = track.walked[(frame + 1) * nAgents + agent]! - track.walked[frame * nAgents + agent]!;
    if (step > MOVING_MPS * dt) {
      if (first < 0) first = frame;
      last = frame + 1;
    } else if (first >= 0 && (frame + 1 - last) * dt > 0.5) close();
  }
  close();
  return moves;
}

/** The seat of a bench next to a slot that lies before it; null where it is too far. */
export function seatOn(bench: Location, slot: { readonly x: number; readonly y: number }): Seat | null {
  const [ex, ey] = nearestEdge(bench, slot);
  const gap = Math.hypot(slot.x - ex, slot.y - ey);
  if (!(gap > 0.01 && gap < SEAT_REACH_M)) return null;
  const nx = (slot.x - ex) / gap;
  const ny = (slot.y - ey) / gap;
  const inward = Math.min(ON_BENCH_M, Math.min(bench.width, bench.depth) * 0.35);
  return { x: ex - nx * inward, y: ey - ny * inward, heading: Math.atan2(ny, nx) };
}

function nearestEdge(place: Location, slot: { readonly x: number; readonly y: number }): [number, number] {
  const clamp = (v: number, middle: number, size: number): number => Math.min(
    Math.max(v, middle - size / 2),
    middle + size / 2,
  );
  return [clamp(slot.x, place.x, place.width), clamp(slot.y, place.y, place.depth)];
}

function nearby(place: Location, slot: { readonly x: number; readonly y: number }): boolean {
  const [ex, ey] = nearestEdge(place, slot);
  return Math.hypot(slot.x - ex, slot.y - ey) < SEAT_REACH_M;
}
