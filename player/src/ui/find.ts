/** Search: words to people, groups, places and actions. */

import { ACTIONS, type World } from "../world/world";
import type { Focus } from "./state";

export interface Hit {
  readonly focus: Focus;
  readonly title: string;
  readonly detail: string;
}

const MOST_HITS = 12;

/** The best hits first: a number is a person or a group, words are sought in actions, places and captions. */
export function find(world: World, query: string): Hit[] {
  const words = query.trim().toLowerCase();
  if (words === "") return [];
  const hits = [...numbered(world, words), ...actions(words), ...places(world, words), ...captions(world, words)];
  return hits.slice(0, MOST_HITS);
}

export function personHit(world: World, id: number): Hit {
  return { focus: { kind: "person", id }, title: `Person ${id}`, detail: `Group ${world.people[id]!.group}` };
}

export function groupHit(world: World, id: number): Hit {
  const { caption, members } = world.groups[id]!;
  const size = `${members.length} ${members.length === 1 ? "person" : "people"}`;
  const own = caption === "" || caption === world.provenance["text"] ? "" : ` · ${caption}`;
  return { focus: { kind: "group", id }, title: `Group ${id}`, detail: size + own };
}

function numbered(world: World, words: string): Hit[] {
  const match = /^(?:(person|p|group|g)\s*)?(\d+)?$/.exec(words);
  if (match === null) return [];
  const [, kind, digits = ""] = match;
  if (digits === "" && (kind === undefined || kind.length === 1)) return [];
  const ids = (n: number): number[] => Array.from({ length: n }, (_, id) => id).filter((id) => starts(id, digits));
  const people = kind?.startsWith("g") ? [] : ids(world.people.length).map((id) => personHit(world, id));
  const groups = kind?.startsWith("p") ? [] : ids(world.groups.length).map((id) => groupHit(world, id));
  const all = kind === undefined ? [...people.slice(0, 8), ...groups.slice(0, 4)] : [...people, ...groups];
  return all;
}

/** Ids in order, so that "1" finds 1 before 10. */
function starts(id: number, digits: string): boolean {
  return String(id).startsWith(digits);
}

function actions(words: string): Hit[] {
  return ACTIONS.filter((action) => action.includes(words)).map((action) => ({
    focus: { kind: "action", action },
    title: action,
    detail: "who does it now",
  }));
}

function places(world: World, words: string): Hit[] {
  return world.locations.flatMap((location, id): Hit[] =>
    location.name.toLowerCase().includes(words) || location.category.includes(words)
      ? [{ focus: { kind: "place", id }, title: location.name, detail: location.category }]
      : [],
  );
}

function captions(world: World, words: string): Hit[] {
  const own = world.groups.filter(({ caption }) => caption !== world.provenance["text"]);
  return own.filter(({ caption }) => caption.toLowerCase().includes(words)).map(({ id }) => groupHit(world, id));
}
