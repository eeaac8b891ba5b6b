/** What each command does to the state. */

import type { World } from "../world/world";
import type { Command } from "./keyboard";
import { SPEEDS, groupOf, type PlayerStore } from "./state";

/** Carries out a command. `openSearch` puts the cursor into the search box. */
export function perform(command: Command, store: PlayerStore, world: World, openSearch: () => void): void {
  const { state } = store;
  switch (command.kind) {
    case "play":
      return togglePlay(store, world);
    case "step":
      return seek(store, world, state.time + command.seconds);
    case "seek":
      return seek(store, world, command.to === "start" ? 0 : world.duration);
    case "speed":
      return store.set({ speed: nextSpeed(state.speed, command.by) });
    case "view":
      return store.set({ view: command.view, following: false });
    case "follow":
      return store.set({ following: state.focus?.kind === "person" && !state.following });
    case "graph":
      return store.set({ graph: groupOf(world, state.focus) === null ? state.graph : !state.graph });
    case "heat":
      return store.set({ heat: !state.heat });
    case "names":
      return store.set({ names: !state.names });
    case "theme":
      return store.set({ theme: state.theme === "light" ? "dark" : "light" });
    case "help":
      return store.set({ help: !state.help });
    case "search":
      return openSearch();
    case "clear":
      return store.set(state.help ? { help: false } : { focus: null, following: false });
  }
}

export function seek(store: PlayerStore, world: World, time: number): void {
  store.set({ time: Math.min(Math.max(time, 0), world.duration) });
}

/** Plays or pauses; at the end it begins again. */
export function togglePlay(store: PlayerStore, world: World): void {
  const { playing, time } = store.state;
  const again = !playing && time >= world.duration;
  store.set(again ? { playing: true, time: 0 } : { playing: !playing });
}

/** The next speed up or down the list; a speed that is not in it goes to its neighbour. */
export function nextSpeed(speed: number, by: 1 | -1): number {
  const faster = SPEEDS.filter((known) => known > speed);
  const slower = SPEEDS.filter((known) => known < speed);
  return (by > 0 ? faster[0] : slower.at(-1)) ?? speed;
}
