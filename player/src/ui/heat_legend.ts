/** The scale of the heat map: colours from little to much, with what they stand for. */

import type { HeatStop, Scene } from "../scene/scene";
import { el } from "./dom";
import type { PlayerStore } from "./state";

/** Shown while the heat map is, where the scene has one. */
export function createHeatLegend(scene: Scene, store: PlayerStore): HTMLElement {
  const element = el("figure", { class: "heat-legend card", label: "Scale of the heat map" });
  store.watch(["heat", "theme"], ({ heat }) => {
    const stops = (heat ? scene.heatLegend?.() : undefined) ?? [];
    element.hidden = stops.length === 0;
    element.replaceChildren(...(stops.length === 0 ? [] : draw(stops)));
  });
  return element;
}

function draw(stops: readonly HeatStop[]): HTMLElement[] {
  const bar = el("div", { class: "bar" });
  bar.style.background = `linear-gradient(to right, ${stops.map(({ colour }) => colour).join(", ")})`;
  const ends = [stops[0]!, stops.at(-1)!].map(({ value }) => el("span", { text: told(value) }));
  const caption = el("figcaption", { text: "Person-seconds per square metre" });
  return [caption, bar, el("div", { class: "ends" }, ...ends)];
}

/** Two digits say enough of a scale. */
function told(value: number): string {
  return Number(value.toPrecision(2)).toLocaleString("en");
}
