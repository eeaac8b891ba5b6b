/** Top left: the sentence that the world was made from, how much it became, and how it was made. */

import type { World } from "../world/world";
import { button, el } from "./dom";
import { icon } from "./icons";
import { counted } from "./words";

/** The sentence of a world; worlds from a script may have none. */
export function sentenceOf(world: World): string {
  const { text } = world.provenance;
  return typeof text === "string" && text !== "" ? text : "A populated world";
}

export function createHeader(world: World): HTMLElement {
  const sentence = el("h1", { class: "sentence", text: sentenceOf(world) });
  const details = createDetails(world);
  details.hidden = true;
  const more = button(
    { class: "quiet more", label: "More about this world", attrs: { "aria-expanded": "false" } },
    icon("down"),
  );
  const header = el("header", { class: "header card" }, sentence, createCounts(world, more), details);
  more.addEventListener("click", () => {
    const open = header.classList.toggle("open");
    details.hidden = !open;
    more.setAttribute("aria-expanded", String(open));
  });
  return header;
}

function createCounts(world: World, more: HTMLElement): HTMLElement {
  const minutes = Number((world.duration / 60).toFixed(1));
  const said = [
    counted(world.people.length, "person", "people"),
    counted(world.groups.length, "group", "groups"),
    counted(world.locations.length, "place", "places"),
    counted(minutes, "minute", "minutes"),
  ];
  return el("div", { class: "counts" }, el("p", { text: said.join(" · ") }), more);
}

function createDetails(world: World): HTMLElement {
  const known = Object.entries(world.provenance).filter(([key, value]) => key !== "text" && value !== null);
  const facts = known.flatMap(([key, value]) => [el("dt", { text: key }), el("dd", { text: String(value) })]);
  const notes = world.notes.map((note) => el("li", { text: note }));
  return el(
    "div",
    { class: "details" },
    el("dl", {}, ...facts),
    ...(notes.length > 0 ? [el("h2", { text: "What the planner changed" }), el("ul", {}, ...notes)] : []),
  );
}
