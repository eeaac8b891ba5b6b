/** The help page: keys, the mouse, and what the colours stand for. */

import { SEEN_ORDER } from "../world/census";
import { button, el } from "./dom";
import { icon } from "./icons";
import { KEY_HELP } from "./keyboard";
import { SEEN_COLOURS } from "./palette";
import type { PlayerStore } from "./state";

const MOUSE: readonly (readonly [string, string])[] = [
  ["Drag", "turn the view; with the right button, move it"],
  ["Wheel", "nearer or farther"],
  ["Click", "a person or a place: what goes on there"],
  ["Double click", "go to a place"],
];

export function createHelp(store: PlayerStore): HTMLElement {
  const close = button(
    { class: "quiet close", label: "Close help", click: () => store.set({ help: false }) },
    icon("close"),
  );
  const page = el(
    "dialog",
    { class: "help card", label: "Help" },
    close,
    el("div", {}, el("h2", { text: "Keys" }), createList(KEY_HELP, "kbd")),
    el(
      "div",
      {},
      el("h2", { text: "Mouse" }),
      createList(MOUSE, "span"),
      el("h2", { text: "Colours of actions" }),
      createLegend(),
    ),
  );
  page.addEventListener("close", () => store.set({ help: false }));
  page.addEventListener("click", (event) => {
    if (event.target === page) store.set({ help: false });
  });
  store.watch(["help"], ({ help }) => {
    if (help && !page.open && page.isConnected) page.showModal();
    else if (!help && page.open) page.close();
  });
  return page;
}

function createList(rows: readonly (readonly [string, string])[], tag: "kbd" | "span"): HTMLElement {
  return el(
    "dl",
    {},
    ...rows.flatMap(([name, meaning]) => [
      el("dt", {}, ...(tag === "kbd" ? name.split(" ").map((key) => el("kbd", { text: key })) : [name])),
      el("dd", { text: meaning }),
    ]),
  );
}

export function createLegend(): HTMLElement {
  const items = [...SEEN_ORDER].reverse().map((kind) => {
    const swatch = el("i", { class: "swatch" });
    swatch.style.background = SEEN_COLOURS[kind];
    return el("li", {}, swatch, kind);
  });
  return el("ul", { class: "legend" }, ...items);
}
