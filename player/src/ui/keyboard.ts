/** Keys, and the commands they stand for. */

import type { View } from "../scene/scene";

export type Command =
  | { readonly kind: "play" | "follow" | "heat" | "names" | "theme" | "graph" | "search" | "clear" | "help" }
  | { readonly kind: "step"; readonly seconds: number }
  | { readonly kind: "seek"; readonly to: "start" | "end" }
  | { readonly kind: "speed"; readonly by: 1 | -1 }
  | { readonly kind: "view"; readonly view: View };

export interface Key {
  readonly key: string;
  readonly shiftKey: boolean;
}

const STEP = 5;
const LONG_STEP = 30;

/** The command of a key, or null. */
export function commandOf({ key, shiftKey }: Key): Command | null {
  const seconds = shiftKey ? LONG_STEP : STEP;
  switch (key.length === 1 ? key.toLowerCase() : key) {
    case " ":
      return { kind: "play" };
    case "ArrowLeft":
      return { kind: "step", seconds: -seconds };
    case "ArrowRight":
      return { kind: "step", seconds };
    case "Home":
      return { kind: "seek", to: "start" };
    case "End":
      return { kind: "seek", to: "end" };
    case "+":
    case "=":
      return { kind: "speed", by: 1 };
    case "-":
      return { kind: "speed", by: -1 };
    case "f":
      return { kind: "follow" };
    case "g":
      return { kind: "graph" };
    case "h":
      return { kind: "heat" };
    case "n":
      return { kind: "names" };
    case "t":
      return { kind: "theme" };
    case "1":
      return { kind: "view", view: "overview" };
    case "2":
      return { kind: "view", view: "top" };
    case "3":
      return { kind: "view", view: "street" };
    case "/":
      return { kind: "search" };
    case "?":
      return { kind: "help" };
    case "Escape":
      return { kind: "clear" };
    default:
      return null;
  }
}

/** What the help page says of the keys. */
export const KEY_HELP: readonly (readonly [keys: string, meaning: string])[] = [
  ["Space", "play or pause"],
  ["← →", "5 seconds back or on; with Shift 30"],
  ["+ −", "faster or slower"],
  ["Home End", "to the beginning or the end"],
  ["1 2 3", "view from the side, from the top, from the street"],
  ["F", "follow the person"],
  ["G", "crowd scenario graph"],
  ["H", "heat map: where people were"],
  ["N", "names of the places"],
  ["T", "light or dark"],
  ["/", "search"],
  ["Esc", "put all away"],
  ["?", "this page"],
];

/** Sends every key that means something to `run`, except what is typed into a field or meant for a focused button. */
export function listenToKeys(run: (command: Command) => void, signal: AbortSignal): void {
  const onKey = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target instanceof Element ? event.target : null;
    if (target?.closest("input, textarea, select") != null) return;
    const pressesButton = event.key === " " && target?.matches("button:focus-visible, summary:focus-visible") === true;
    const command = pressesButton ? null : commandOf(event);
    if (command === null) return;
    event.preventDefault();
    run(command);
  };
  document.addEventListener("keydown", onKey, { signal });
}
