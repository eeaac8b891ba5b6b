/** A group, a place or an action: who belongs to it at the moment, and what each does. */

import { doingAt } from "../world/doing";
import { seen, SEEN_ORDER, type Seen } from "../world/census";
import type { Doing, World } from "../world/world";
import { button, el, setText } from "./dom";
import { sentenceOf } from "./header";
import { SEEN_COLOURS } from "./palette";
import type { Live, PanelActions } from "./panel";
import { createHeading, createSection, createSwatch } from "./panel_parts";
import type { Focus } from "./state";
import { counted, isPresent, tellDoing, tellThere } from "./words";

type CrowdFocus = Exclude<Focus, { kind: "person" }>;

const MOST_ROWS = 60;

interface Entry {
  readonly id: number;
  readonly kind: Seen;
  readonly told: string;
}

export function createCrowdPanel(world: World, focus: CrowdFocus, actions: PanelActions): Live {
  const list = el("ul", { class: "people" });
  const count = el("p", { class: "told" });
  const extra = focus.kind === "place" ? [createGo(focus.id, actions)] : [];
  let shown = "";
  return {
    element: el(
      "div",
      { class: "crowd" },
      createHeading(headingOf(world, focus), actions),
      el("div", { class: "now" }, count),
      ...extra,
      createSection("Now", list),
    ),
    update: ({ time }) => {
      const entries = entriesOf(world, focus, time);
      const key = entries.map(({ id, told }) => `${id} ${told}`).join("|");
      if (key === shown && shown !== "") return;
      shown = key;
      setText(count, tellCount(focus, entries.length));
      list.replaceChildren(...createRows(entries, actions));
    },
  };
}

function headingOf(world: World, focus: CrowdFocus): { title: string; under: string[] } {
  if (focus.kind === "action") return { title: focus.action, under: ["Action"] };
  if (focus.kind === "place") {
    const { name, category, width, depth } = world.locations[focus.id]!;
    return { title: name, under: [`${category} · ${width} × ${depth} m`] };
  }
  const { caption } = world.groups[focus.id]!;
  return { title: `Group ${focus.id}`, under: [caption === sentenceOf(world) ? "" : caption] };
}

function tellCount(focus: CrowdFocus, n: number): string {
  const people = counted(n, "person", "people");
  if (focus.kind === "group") return people;
  return focus.kind === "place" ? `${people} here` : `${people} at it`;
}

function createGo(location: number, actions: PanelActions): HTMLElement {
  return el(
    "div",
    { class: "actions" },
    button({ class: "action", text: "Go there", click: () => actions.lookAt(location) }),
  );
}

/** The people of a focus at a moment, alike doings together. */
function entriesOf(world: World, focus: CrowdFocus, time: number): Entry[] {
  const ids = focus.kind === "group" ? (world.groups[focus.id]?.members ?? []) : world.people.keys();
  const entries: Entry[] = [];
  for (const id of ids) {
    const doing = doingAt(world.people[id]!, time);
    if (!belongs(focus, doing)) continue;
    const kind = seen(doing);
    if (focus.kind === "action" && !isPresent(world, id, time)) continue;
    const told = focus.kind === "place" ? tellThere(world, doing, time) : tellDoing(world, id, doing, time);
    entries.push({ id, kind, told });
  }
  if (focus.kind === "group") return entries;
  return entries.sort((a, b) => SEEN_ORDER.indexOf(a.kind) - SEEN_ORDER.indexOf(b.kind) || a.id - b.id);
}

function belongs(focus: CrowdFocus, { phase, activity }: Doing): boolean {
  if (focus.kind === "group") return true;
  if (activity === null || phase === "walk") return false;
  return focus.kind === "place" ? activity.location === focus.id : phase === "do" && activity.action === focus.action;
}

function createRows(entries: readonly Entry[], actions: PanelActions): HTMLElement[] {
  const rows = entries
    .slice(0, MOST_ROWS)
    .map(({ id, kind, told }) =>
      el(
        "li",
        {},
        button(
          { class: "row", click: () => actions.focus({ kind: "person", id }) },
          createSwatch(SEEN_COLOURS[kind]),
          el("span", {}, el("b", { text: `Person ${id}` }), ` ${told}`),
        ),
      ),
    );
  if (entries.length > MOST_ROWS)
    rows.push(el("li", { class: "rest", text: `and ${entries.length - MOST_ROWS} more` }));
  return rows;
}
