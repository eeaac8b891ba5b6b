/** What the page shows at a moment. */

import type { Theme, View } from "../scene/scene";
import type { Action, World } from "../world/world";
import type { HashWishes } from "./hash";
import type { Store } from "./store";

/** What the user looks at more closely. */
export type Focus =
  | { readonly kind: "person"; readonly id: number }
  | { readonly kind: "group"; readonly id: number }
  | { readonly kind: "place"; readonly id: number }
  | { readonly kind: "action"; readonly action: Action };

export interface State {
  time: number;
  playing: boolean;
  speed: number;
  focus: Focus | null;
  following: boolean;
  /** Null once the user has moved the camera by hand. */
  view: View | null;
  heat: boolean;
  names: boolean;
  theme: Theme;
  /** Whether the crowd scenario graph of the group in focus is open. */
  graph: boolean;
  help: boolean;
}

export type PlayerStore = Store<State>;

export const SPEEDS: readonly number[] = [0.5, 1, 2, 4, 8, 16];

/** What the page starts with: what its address asks for, else what suits the system's settings. */
export function initialState(world: World, wishes: HashWishes): State {
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  return {
    time: Math.min(wishes.t ?? 0, world.duration),
    playing: wishes.play ?? (wishes.t === undefined && !calm),
    speed: wishes.speed ?? 1,
    focus: focusOf(world, wishes),
    following: wishes.follow ?? false,
    view: wishes.view ?? "overview",
    heat: wishes.heat ?? false,
    names: wishes.names ?? true,
    theme: wishes.theme ?? (dark ? "dark" : "light"),
    graph: wishes.graph ?? true,
    help: false,
  };
}

/** The person or group that an address names, where the world has it. */
export function focusOf(world: World, wishes: HashWishes): Focus | null {
  const { agent, group } = wishes;
  if (agent !== undefined && agent < world.people.length) return { kind: "person", id: agent };
  if (group !== undefined && group < world.groups.length) return { kind: "group", id: group };
  return null;
}

/** The group whose graph belongs to a focus. */
export function groupOf(world: World, focus: Focus | null): number | null {
  if (focus?.kind === "group") return focus.id;
  if (focus?.kind === "person") return world.people[focus.id]?.group ?? null;
  return null;
}
