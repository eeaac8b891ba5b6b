/** Bottom: play, clock, time line, speed. */

import type { World } from "../world/world";
import { nextSpeed, togglePlay } from "./commands";
import { button, el, setText } from "./dom";
import { icon } from "./icons";
import type { PlayerStore } from "./state";
import { createClock, createTimeline } from "./timeline";

export function createDock(world: World, store: PlayerStore): HTMLElement {
  return el(
    "section",
    { class: "dock card", label: "Playback" },
    createPlay(world, store),
    createClock(world, store),
    createTimeline(world, store),
    createSpeed(store),
  );
}

function createPlay(world: World, store: PlayerStore): HTMLElement {
  const made = button({ class: "play", title: "Play or pause (Space)", click: () => togglePlay(store, world) });
  let shown = "";
  store.watch(["playing", "time"], ({ playing, time }) => {
    const name = playing ? "pause" : time >= world.duration ? "again" : "play";
    if (name === shown) return;
    shown = name;
    made.replaceChildren(icon(name));
    made.setAttribute("aria-label", { play: "Play", pause: "Pause", again: "Play again" }[name]);
  });
  return made;
}

function createSpeed(store: PlayerStore): HTMLElement {
  const value = el("output", { label: "Speed" });
  const change = (by: 1 | -1) => (): void => store.set({ speed: nextSpeed(store.state.speed, by) });
  store.watch(["speed"], ({ speed }) => setText(value, `${speed}×`));
  return el(
    "div",
    { class: "speed", attrs: { role: "group", "aria-label": "Speed" } },
    button({ class: "quiet", text: "−", label: "Slower", title: "Slower (−)", click: change(-1) }),
    value,
    button({ class: "quiet", text: "+", label: "Faster", title: "Faster (+)", click: change(1) }),
  );
}
