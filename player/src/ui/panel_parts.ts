/** The parts that panels are made of. */

import { button, el } from "./dom";
import { icon } from "./icons";
import type { PanelActions } from "./panel";

export interface Heading {
  readonly title: string;
  readonly under: readonly (Node | string)[];
}

export function createHeading({ title, under }: Heading, actions: PanelActions): HTMLElement {
  return el(
    "header",
    {},
    el("h2", { text: title }),
    button(
      { class: "quiet close", label: "Close", title: "Close (Esc)", click: () => actions.focus(null) },
      icon("close"),
    ),
    el("p", { class: "under" }, ...under),
  );
}

export function createSection(title: string, ...children: readonly Node[]): HTMLElement {
  return el("section", {}, el("h3", { text: title }), ...children);
}

/** People as small buttons; a click puts one in focus. */
export function createChips(agents: readonly number[], actions: PanelActions): HTMLButtonElement[] {
  return agents.map((id) =>
    button({ class: "chip", text: `Person ${id}`, click: () => actions.focus({ kind: "person", id }) }),
  );
}

export function createSwatch(colour: string): HTMLElement {
  const swatch = el("i", { class: "swatch" });
  swatch.style.background = colour;
  return swatch;
}

/** Keeps the class list of an element to one of several states. */
export function setState(element: Element, state: string): void {
  if (element.getAttribute("data-state") !== state) element.setAttribute("data-state", state);
}
