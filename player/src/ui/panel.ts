/** The panel at the right: the person, group, place or action in focus. */

import type { World } from "../world/world";
import { createCrowdPanel } from "./crowd_panel";
import { el } from "./dom";
import { createPersonPanel } from "./person_panel";
import type { Focus, PlayerStore, State } from "./state";

/** Something on the page that follows the state: the time a few times a second, all else at once. */
export interface Live {
  readonly element: HTMLElement;
  readonly update: (state: Readonly<State>) => void;
}

export interface PanelActions {
  readonly seek: (time: number) => void;
  readonly focus: (focus: Focus | null) => void;
  readonly lookAt: (location: number) => void;
  readonly toggle: (what: "follow" | "graph") => void;
}

export function createPanel(world: World, store: PlayerStore, actions: PanelActions): Live {
  const element = el("aside", { class: "panel card", label: "In focus" });
  let content: Live | null = null;
  store.watch(["focus"], ({ focus }) => {
    content = focus === null ? null : createContent(world, focus, actions);
    element.hidden = content === null;
    element.replaceChildren(...(content === null ? [] : [content.element]));
    element.scrollTop = 0;
  });
  store.watch(["focus", "following", "graph"], (state) => content?.update(state));
  return { element, update: (state) => content?.update(state) };
}

function createContent(world: World, focus: Focus, actions: PanelActions): Live {
  if (focus.kind === "person") return createPersonPanel(world, focus.id, actions);
  return createCrowdPanel(world, focus, actions);
}
