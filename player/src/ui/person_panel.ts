/** A person: what is going on now, the plan over time, partners, group, and everything the person does. */

import { doingAt } from "../world/doing";
import type { Activity, Doing, World } from "../world/world";
import { button, el, setText } from "./dom";
import { icon } from "./icons";
import { sentenceOf } from "./header";
import { SEEN_COLOURS } from "./palette";
import type { Live, PanelActions } from "./panel";
import { createChips, createHeading, createSection, createSwatch, setState } from "./panel_parts";
import { createPlanStrip } from "./plan_strip";
import type { State } from "./state";
import { clock, tellDoing } from "./words";

export function createPersonPanel(world: World, id: number, actions: PanelActions): Live {
  const person = world.people[id]!;
  const now = createNow(world, id);
  const strip = createPlanStrip(world, person, actions);
  const rows = createActivityList(world, person.activities, actions);
  const group = createGroup(world, id, actions);
  const buttons = createButtons(actions);
  const parts = [now, strip, group, rows, buttons];
  const element = el(
    "div",
    { class: "person" },
    createHeading({ title: `Person ${id}`, under: tellGroup(world, person.group, actions) }, actions),
    now.element,
    buttons.element,
    createSection("Plan", strip.element),
    group.element,
    createSection("Activities", rows.element),
  );
  return {
    element,
    update: (state) => {
      const doing = doingAt(person, state.time);
      for (const part of parts) part.update(state, doing);
    },
  };
}

interface Part {
  readonly element: HTMLElement;
  readonly update: (state: Readonly<State>, doing: Doing) => void;
}

function tellGroup(world: World, group: number, actions: PanelActions): (Node | string)[] {
  const { caption } = world.groups[group]!;
  const link = button({
    class: "link",
    text: `Group ${group}`,
    click: () => actions.focus({ kind: "group", id: group }),
  });
  return caption === "" || caption === sentenceOf(world) ? [link] : [link, ` · ${caption}`];
}

function createNow(world: World, id: number): Part {
  const told = el("p", { class: "told" });
  const times = el("p", { class: "times" });
  return {
    element: el("div", { class: "now", attrs: { "aria-live": "off" } }, told, times),
    update: ({ time }, doing) => {
      const words = tellDoing(world, id, doing, time);
      setText(told, words.charAt(0).toUpperCase() + words.slice(1));
      setText(times, tellTimes(doing));
    },
  };
}

function tellTimes({ phase, activity }: Doing): string {
  if (activity === null || phase === "idle") return "";
  const { leave, arrive, start, end } = activity;
  const [from, to] = phase === "walk" ? [leave, arrive] : phase === "wait" ? [arrive, start] : [start, end];
  return `${clock(from)} – ${Number.isNaN(to) ? "end of the world" : clock(to)}`;
}

function createButtons(actions: PanelActions): Part {
  const follow = button(
    { class: "action", title: "Follow (F)", click: () => actions.toggle("follow") },
    icon("follow"),
    "Follow",
  );
  const graph = button(
    { class: "action", title: "Crowd scenario graph (G)", click: () => actions.toggle("graph") },
    icon("graph"),
    "Graph",
  );
  return {
    element: el("div", { class: "actions" }, follow, graph),
    update: (state) => {
      follow.setAttribute("aria-pressed", String(state.following));
      graph.setAttribute("aria-pressed", String(state.graph));
    },
  };
}

/** The others of the group; those who are at it together with the person are marked. */
function createGroup(world: World, id: number, actions: PanelActions): Part {
  const { members } = world.groups[world.people[id]!.group]!;
  const others = members.filter((member) => member !== id);
  const chips = createChips(others, actions);
  const element = createSection("In the same group", el("div", { class: "chips" }, ...chips));
  element.hidden = others.length === 0;
  return {
    element,
    update: (_, { activity }) => {
      others.forEach((other, i) =>
        setState(chips[i]!, activity?.partners.includes(other) === true ? "partner" : "apart"),
      );
    },
  };
}

function createActivityList(world: World, activities: readonly Activity[], actions: PanelActions): Part {
  const rows = activities.map((activity) => createRow(world, activity, actions));
  return {
    element: el("ol", { class: "activities" }, ...rows),
    update: ({ time }, doing) => {
      activities.forEach((activity, i) => setState(rows[i]!, stateOf(activity, time, doing)));
    },
  };
}

/** Whether an activity is over, going on (or on its way), or yet to come. */
function stateOf(activity: Activity, time: number, doing: Doing): string {
  if (doing.activity === activity) return "now";
  return activity.leave <= time ? "past" : "future";
}

function createRow(world: World, activity: Activity, actions: PanelActions): HTMLElement {
  const { action, location, partners, implied, leave, start, arrive, planStart } = activity;
  const moment = [start, arrive, leave].find((time) => !Number.isNaN(time));
  const company =
    partners.length > 0
      ? [
          el("span", {
            class: "with",
            text: `+${partners.length}`,
            title: `with ${partners.map((p) => `Person ${p}`).join(", ")}`,
          }),
        ]
      : [];
  const row = button(
    { class: "activity", click: () => moment !== undefined && actions.seek(moment) },
    el("time", { text: clock(moment ?? planStart) }),
    createSwatch(SEEN_COLOURS[action]),
    el("span", { class: "what" }, el("b", { text: action }), ` ${world.locations[location]!.name}`),
    ...company,
    ...createBadge(activity),
  );
  row.disabled = moment === undefined;
  return el("li", { class: implied ? "implied" : "" }, row);
}

function createBadge({ status }: Activity): HTMLElement[] {
  if (status === "done") return [];
  const meaning = {
    timeout: ["timed out", "went on without the others, or gave up"],
    cut: ["cut", "the world ended first"],
    none: ["not begun", "never set off for it"],
  }[status ?? "none"];
  return [el("span", { class: `badge ${status ?? "none"}`, text: meaning[0]!, title: meaning[1]! })];
}
