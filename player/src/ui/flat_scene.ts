/** A plain map seen from the top: what is shown where the browser cannot draw in three dimensions. */

import type { Pick, Scene, SceneStats, Theme } from "../scene/scene";
import type { World } from "../world/world";

const MARGIN = 0.12;
const REACH = 12;

export function createFlatScene(world: World): Scene {
  return new FlatScene(world);
}

class FlatScene implements Scene {
  readonly canvas = document.createElement("canvas");
  readonly #world: World;
  readonly #context = this.canvas.getContext("2d")!;
  readonly #box: readonly [west: number, south: number, east: number, north: number];
  #time = 0;
  #agent: number | null = null;
  #group: number | null = null;
  #names = true;
  #theme: Theme = "light";
  #ratio = 1;
  #scriptMs = 0;

  constructor(world: World) {
    this.#world = world;
    const edges = world.locations.map((l) => [
      l.x - l.width / 2,
      l.y - l.depth / 2,
      l.x + l.width / 2,
      l.y + l.depth / 2,
    ]);
    const ends = (i: number): number[] => edges.map((edge) => edge[i]!);
    this.#box = [Math.min(...ends(0)), Math.min(...ends(1)), Math.max(...ends(2)), Math.max(...ends(3))];
  }

  draw(time: number): void {
    const began = performance.now();
    this.#time = time;
    this.#drawPlaces();
    this.#drawPeople();
    this.#scriptMs = performance.now() - began;
  }

  select(agent: number | null): void {
    this.#agent = agent;
  }

  selectGroup(group: number | null): void {
    this.#group = group;
  }

  follow(): void {}
  view(): void {}
  lookAt(): void {}
  heat(): void {}

  names(on: boolean): void {
    this.#names = on;
  }

  theme(theme: Theme): void {
    this.#theme = theme;
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.#ratio = pixelRatio;
    this.canvas.width = Math.round(width * pixelRatio);
    this.canvas.height = Math.round(height * pixelRatio);
  }

  pick(clientX: number, clientY: number): Pick {
    const { left, top } = this.canvas.getBoundingClientRect();
    const [px, py] = [(clientX - left) * this.#ratio, (clientY - top) * this.#ratio];
    let nearest: number | null = null;
    let best = REACH * this.#ratio;
    for (const { id, x, y } of this.#present()) {
      const distance = Math.hypot(x - px, y - py);
      if (distance < best) [nearest, best] = [id, distance];
    }
    return { agent: nearest, location: nearest === null ? this.#placeAt(px, py) : null };
  }

  stats(): SceneStats {
    return { drawCalls: 0, scriptMs: this.#scriptMs };
  }

  #drawPlaces(): void {
    const context = this.#context;
    const dark = this.#theme === "dark";
    context.fillStyle = dark ? "#15181d" : "#efebe4";
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    context.font = `${11 * this.#ratio}px system-ui, sans-serif`;
    context.textAlign = "center";
    for (const place of this.#inOrder()) {
      const [x, y] = this.#project(place.x - place.width / 2, place.y + place.depth / 2);
      const scale = this.#scale();
      context.fillStyle = dark ? "rgb(255 255 255 / .07)" : "rgb(40 60 70 / .09)";
      context.fillRect(x, y, place.width * scale, place.depth * scale);
      if (!this.#names) continue;
      context.fillStyle = dark ? "#9aa3ad" : "#5c6470";
      context.fillText(place.name, x + (place.width * scale) / 2, y + 13 * this.#ratio);
    }
  }

  #drawPeople(): void {
    const context = this.#context;
    for (const { id, x, y } of this.#present()) {
      const marked = id === this.#agent || this.#world.people[id]!.group === this.#group;
      context.fillStyle = marked ? "#e0512f" : `hsl(${(this.#world.people[id]!.group * 137.5) % 360} 45% 50%)`;
      context.beginPath();
      context.arc(x, y, (marked ? 5 : 3) * this.#ratio, 0, 2 * Math.PI);
      context.fill();
    }
  }

  *#present(): Iterable<{ readonly id: number; readonly x: number; readonly y: number }> {
    const { dt, nFrames, nAgents, positions, present } = this.#world.frames;
    const frame = Math.min(Math.round(this.#time / dt), nFrames - 1);
    for (let id = 0; id < nAgents; id += 1) {
      const i = frame * nAgents + id;
      if (present[i] !== 1) continue;
      const [x, y] = this.#project(positions[2 * i]!, positions[2 * i + 1]!);
      yield { id, x, y };
    }
  }

  #placeAt(px: number, py: number): number | null {
    const hit = this.#inOrder().findLast((place) => {
      const [x, y] = this.#project(place.x, place.y);
      const half = this.#scale() / 2;
      return Math.abs(px - x) <= place.width * half && Math.abs(py - y) <= place.depth * half;
    });
    return hit === undefined ? null : this.#world.locations.indexOf(hit);
  }

  /** Large places first, so that what lies in them is on top. */
  #inOrder(): World["locations"][number][] {
    return [...this.#world.locations].sort((a, b) => b.width * b.depth - a.width * a.depth);
  }

  #scale(): number {
    const [west, south, east, north] = this.#box;
    const room = 1 - 2 * MARGIN;
    return Math.min((this.canvas.width * room) / (east - west), (this.canvas.height * room) / (north - south));
  }

  #project(x: number, y: number): readonly [number, number] {
    const [west, south, east, north] = this.#box;
    const scale = this.#scale();
    return [
      this.canvas.width / 2 + (x - (west + east) / 2) * scale,
      this.canvas.height / 2 - (y - (south + north) / 2) * scale,
    ];
  }
}
