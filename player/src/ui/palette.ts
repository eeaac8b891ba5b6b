/**
 * Colours of what people do, in four families: waiting (ambers), attending to a thing (blues), being with each other
 * (reds), moving (greens). Each holds on light and on dark ground; a word always stands beside it.
 */

import type { Seen } from "../world/census";

export const SEEN_COLOURS: Readonly<Record<Seen, string>> = {
  stand: "#8d939c",
  wait: "#e3b341",
  sit: "#c28a2e",
  queue: "#e07f33",
  "object interact": "#4a86d8",
  "look at": "#62b3e4",
  read: "#5c62c9",
  "talk on phone": "#8f7be0",
  discuss: "#d1495f",
  meet: "#b8478f",
  "wave at": "#ee8a80",
  carry: "#2f8f83",
  wander: "#56b08c",
  "enter/exit": "#7d9a55",
  walk: "#a9b6b3",
};
