/** Top right: the views, and switches for heat map, names, theme and help. */

import type { View } from "../scene/scene";
import { button, el } from "./dom";
import { icon, type IconName } from "./icons";
import type { Command } from "./keyboard";
import type { PlayerStore, State } from "./state";

const VIEWS: readonly (readonly [View, string])[] = [
  ["overview", "Overview"],
  ["top", "Top"],
  ["street", "Street"],
];

export function createToolbar(store: PlayerStore, run: (command: Command) => void): HTMLElement {
  return el(
    "div",
    { class: "toolbar card", attrs: { role: "toolbar", "aria-label": "View" } },
    createViews(store, run),
    createSwitch(store, run, { command: "heat", icon: "heat", label: "Heat map", key: "H", on: (state) => state.heat }),
    createSwitch(store, run, {
      command: "names",
      icon: "names",
      label: "Names of places",
      key: "N",
      on: (state) => state.names,
    }),
    createSwitch(store, run, {
      command: "theme",
      icon: "theme",
      label: "Dark",
      key: "T",
      on: (state) => state.theme === "dark",
    }),
    createSwitch(store, run, { command: "help", icon: "help", label: "Help", key: "?", on: (state) => state.help }),
  );
}

function createViews(store: PlayerStore, run: (command: Command) => void): HTMLElement {
  const buttons = VIEWS.map(([view, name], i) =>
    button({ class: "segment", text: name, title: `${name} (${i + 1})`, click: () => run({ kind: "view", view }) }),
  );
  store.watch(["view"], (state) => {
    VIEWS.forEach(([view], i) => buttons[i]!.setAttribute("aria-pressed", String(state.view === view)));
  });
  return el("div", { class: "segments", attrs: { role: "group", "aria-label": "Camera" } }, ...buttons);
}

interface Switch {
  readonly command: "heat" | "names" | "theme" | "help";
  readonly icon: IconName;
  readonly label: string;
  readonly key: string;
  readonly on: (state: Readonly<State>) => boolean;
}

function createSwitch(store: PlayerStore, run: (command: Command) => void, what: Switch): HTMLElement {
  const made = button(
    {
      class: "quiet",
      label: what.label,
      title: `${what.label} (${what.key})`,
      click: () => run({ kind: what.command }),
    },
    icon(what.icon),
  );
  store.watch([what.command], (state) => made.setAttribute("aria-pressed", String(what.on(state))));
  return made;
}
