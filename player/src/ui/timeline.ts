/** The time line: a slider over a strip that shows how many people do what over time. */

import { SEEN_ORDER, countsAt, takeCensus, type Census } from "../world/census";
import type { World } from "../world/world";
import { seek } from "./commands";
import { el, setText } from "./dom";
import { SEEN_COLOURS } from "./palette";
import type { PlayerStore } from "./state";
import { clock, counted } from "./words";

const N_BINS = 300;
const MOST_TOLD = 7;

export function createTimeline(world: World, store: PlayerStore): HTMLElement {
  const census = takeCensus(world, N_BINS);
  const strip = el("canvas", { attrs: { "aria-hidden": "true" } });
  const future = el("div", { class: "future" });
  const head = el("div", { class: "playhead" });
  const tip = el("div", { class: "tip card" });
  tip.hidden = true;
  const slider = el("div", {
    class: "timeline",
    label: "Time",
    attrs: { role: "slider", tabindex: "0", "aria-valuemin": "0", "aria-valuemax": String(Math.round(world.duration)) },
  });
  slider.append(strip, future, head, tip);
  new ResizeObserver(() => drawStrip(strip, census)).observe(slider);
  store.watch(["time"], ({ time }) => {
    const share = time / world.duration;
    future.style.transform = `scaleX(${1 - share})`;
    head.style.left = `${100 * share}%`;
  });
  sayTime(slider, world, store);
  letScrub(slider, world, store);
  letHover(slider, tip, census, world);
  return slider;
}

/** The value for screen readers changes with whole seconds only. */
function sayTime(slider: HTMLElement, world: World, store: PlayerStore): void {
  let said = -1;
  store.watch(["time"], ({ time }) => {
    const seconds = Math.floor(time);
    if (seconds === said) return;
    said = seconds;
    slider.setAttribute("aria-valuenow", String(seconds));
    slider.setAttribute("aria-valuetext", `${clock(time)} of ${clock(world.duration)}`);
  });
}

function letScrub(slider: HTMLElement, world: World, store: PlayerStore): void {
  const scrub = (event: PointerEvent): void => seek(store, world, shareAt(slider, event.clientX) * world.duration);
  slider.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    slider.setPointerCapture(event.pointerId);
    scrub(event);
  });
  slider.addEventListener("pointermove", (event) => {
    if (slider.hasPointerCapture(event.pointerId)) scrub(event);
  });
}

function letHover(slider: HTMLElement, tip: HTMLElement, census: Census, world: World): void {
  slider.addEventListener("pointermove", (event) => {
    const share = shareAt(slider, event.clientX);
    tip.hidden = false;
    tip.style.left = `${100 * share}%`;
    tip.classList.toggle("left", share > 0.7);
    tip.replaceChildren(...tell(census, share * world.duration));
  });
  slider.addEventListener("pointerleave", () => {
    tip.hidden = true;
  });
}

function tell(census: Census, time: number): HTMLElement[] {
  const counts = countsAt(census, time);
  const total = counts.reduce((sum, { count }) => sum + count, 0);
  const heading = el("p", {
    class: "heading",
    text: `${clock(time)} · ${counted(total, "person", "people")} in sight`,
  });
  const rows = counts.slice(0, MOST_TOLD).map(({ kind, count }) => {
    const swatch = el("i", { class: "swatch" });
    swatch.style.background = SEEN_COLOURS[kind];
    return el("p", {}, swatch, el("span", { text: kind }), el("b", { text: String(count) }));
  });
  const rest = counts.slice(MOST_TOLD).reduce((sum, { count }) => sum + count, 0);
  if (rest > 0) rows.push(el("p", { class: "rest" }, el("span", { text: "other" }), el("b", { text: String(rest) })));
  return [heading, ...rows];
}

function shareAt(slider: HTMLElement, clientX: number): number {
  const { left, width } = slider.getBoundingClientRect();
  return Math.min(Math.max((clientX - left) / width, 0), 1);
}

/** Stacked areas; the height is the number of people in sight. */
function drawStrip(strip: HTMLCanvasElement, census: Census): void {
  const { clientWidth, clientHeight } = strip;
  const context = strip.getContext("2d");
  if (context === null || clientWidth === 0) return;
  strip.width = Math.round(clientWidth * devicePixelRatio);
  strip.height = Math.round(clientHeight * devicePixelRatio);
  const x = (bin: number): number => (strip.width * (bin + 0.5)) / census.nBins;
  const y = (count: number): number => strip.height * (1 - (0.96 * count) / Math.max(census.most, 1));
  const below = new Float64Array(census.nBins);
  SEEN_ORDER.forEach((kind, k) => {
    const floor = below.slice();
    for (let bin = 0; bin < census.nBins; bin += 1) below[bin]! += census.counts[bin * SEEN_ORDER.length + k]!;
    fillBand(
      context,
      SEEN_COLOURS[kind],
      [...below].map((count, bin) => [x(bin), y(count), y(floor[bin]!)]),
      strip.width,
    );
  });
}

function fillBand(
  context: CanvasRenderingContext2D,
  colour: string,
  band: readonly (readonly number[])[],
  width: number,
): void {
  const [first, last] = [band[0]!, band.at(-1)!];
  context.fillStyle = colour;
  context.beginPath();
  context.moveTo(0, first[1]!);
  for (const [x, top] of band) context.lineTo(x!, top!);
  context.lineTo(width, last[1]!);
  context.lineTo(width, last[2]!);
  for (const [x, , bottom] of [...band].reverse()) context.lineTo(x!, bottom!);
  context.lineTo(0, first[2]!);
  context.fill();
}

/** The clock beside the time line: "02:45 / 10:00". */
export function createClock(world: World, store: PlayerStore): HTMLElement {
  const now = el("b", {});
  store.watch(["time"], ({ time }) => setText(now, clock(time)));
  return el("p", { class: "clock" }, now, el("span", { text: ` / ${clock(world.duration)}` }));
}
