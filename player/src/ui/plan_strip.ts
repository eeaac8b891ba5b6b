/** A person's life as a strip: thin where the person walks, hatched while waiting, a block of colour for each doing. */

import type { Activity, Person, World } from "../world/world";
import { el } from "./dom";
import { SEEN_COLOURS } from "./palette";
import type { Live, PanelActions } from "./panel";
import { clock } from "./words";

export interface Piece {
  readonly phase: "walk" | "wait" | "do";
  readonly activity: Activity;
  readonly from: number;
  readonly to: number;
}

/** The pieces of a life in order; what has no end before the world's lasts to `duration`. */
export function planPieces(activities: readonly Activity[], duration: number): Piece[] {
  const until = (time: number): number => (Number.isNaN(time) ? duration : Math.min(time, duration));
  return activities.flatMap((activity): Piece[] => {
    const { leave, arrive, start, end } = activity;
    if (Number.isNaN(leave)) return [];
    const pieces: Piece[] = [
      { phase: "walk", activity, from: leave, to: until(arrive) },
      { phase: "wait", activity, from: until(arrive), to: until(start) },
      { phase: "do", activity, from: until(start), to: until(end) },
    ];
    return pieces.filter(({ from, to }) => to > from);
  });
}

export function createPlanStrip(world: World, person: Person, actions: PanelActions): Live {
  const share = (time: number): string => `${(100 * time) / world.duration}%`;
  const line = el("div", { class: "now-line" });
  const pieces = planPieces(person.activities, world.duration).map((piece) => {
    const made = el("div", {
      class: `piece ${piece.phase} ${piece.activity.status ?? ""}`,
      title: tellPiece(world, piece),
    });
    made.style.left = share(piece.from);
    made.style.width = share(piece.to - piece.from);
    made.style.setProperty("--colour", SEEN_COLOURS[piece.phase === "walk" ? "walk" : piece.activity.action]);
    return made;
  });
  const strip = el(
    "div",
    { class: "strip", attrs: { role: "img", "aria-label": "Plan over time; the list below says the same" } },
    ...pieces,
    line,
  );
  strip.addEventListener("click", (event) => {
    const { left, width } = strip.getBoundingClientRect();
    actions.seek(((event.clientX - left) / width) * world.duration);
  });
  return {
    element: el("div", { class: "plan" }, strip, createScale(world.duration)),
    update: ({ time }) => {
      line.style.left = share(time);
    },
  };
}

function createScale(duration: number): HTMLElement {
  const marks = [0, duration / 2, duration].map((time) => el("span", { text: clock(time) }));
  return el("div", { class: "scale", attrs: { "aria-hidden": "true" } }, ...marks);
}

function tellPiece(world: World, { phase, activity, from, to }: Piece): string {
  const place = world.locations[activity.location]!.name;
  const what = {
    walk: `walks to ${place}`,
    wait: `waits for ${activity.action} at ${place}`,
    do: `${activity.action} at ${place}`,
  }[phase];
  const end = phase === "do" && activity.status !== "done" ? ` (${activity.status})` : "";
  return `${clock(from)} – ${clock(to)}  ${what}${end}`;
}
