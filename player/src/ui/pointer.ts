/** The mouse in the scene: a click puts what is under it in focus, and it says whom it points at. */

import type { Scene } from "../scene/scene";
import type { World } from "../world/world";
import { el, setText } from "./dom";
import type { Live } from "./panel";
import type { Focus } from "./state";
import { tellNow } from "./words";

const STILL = 5;
const LONGEST_CLICK = 500;
const HOVER_EVERY = 90;

export interface PointerHooks {
  readonly time: () => number;
  readonly choose: (focus: Focus | null) => void;
  /** The user turns or moves the view by hand. */
  readonly moved: () => void;
  readonly wake: () => void;
}

/** Listens on the scene's canvas; gives back the label that goes with the pointer. */
export function listenToPointer(scene: Scene, world: World, hooks: PointerHooks): Live {
  const { canvas } = scene;
  for (const kind of ["pointerdown", "pointerup", "wheel"] as const) {
    canvas.addEventListener(kind, hooks.wake, { passive: true });
  }
  canvas.addEventListener("wheel", hooks.moved, { passive: true });
  canvas.addEventListener("pointermove", ({ buttons }) => {
    if (buttons === 0) return;
    hooks.wake();
    hooks.moved();
  });
  listenToClicks(scene, hooks);
  return new HoverLabel(scene, world, hooks.time);
}

function listenToClicks(scene: Scene, hooks: PointerHooks): void {
  let down: PointerEvent | null = null;
  scene.canvas.addEventListener("pointerdown", (event) => {
    down = event.button === 0 && event.isPrimary ? event : null;
  });
  scene.canvas.addEventListener("pointerup", (event) => {
    const still = down !== null && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) <= STILL;
    if (still && event.timeStamp - down!.timeStamp <= LONGEST_CLICK) hooks.choose(under(scene, event));
    down = null;
  });
  scene.canvas.addEventListener("dblclick", (event) => {
    const { location } = scene.pick(event.clientX, event.clientY);
    if (location !== null) scene.lookAt(location);
    hooks.wake();
  });
}

function under(scene: Scene, { clientX, clientY }: PointerEvent): Focus | null {
  const { agent, location } = scene.pick(clientX, clientY);
  if (agent !== null) return { kind: "person", id: agent };
  return location === null ? null : { kind: "place", id: location };
}

/** Says whom the pointer is at. People move under a pointer that stands still, so it is kept up to date as well. */
class HoverLabel implements Live {
  readonly element = el("div", { class: "hover card", attrs: { "aria-hidden": "true" } });
  readonly #scene: Scene;
  readonly #world: World;
  readonly #time: () => number;
  #at: PointerEvent | null = null;
  #last = 0;

  constructor(scene: Scene, world: World, time: () => number) {
    [this.#scene, this.#world, this.#time] = [scene, world, time];
    this.element.hidden = true;
    scene.canvas.addEventListener("pointermove", (event) => this.#follow(event));
    scene.canvas.addEventListener("pointerleave", () => this.#leave());
  }

  readonly update = (): void => {
    if (this.#at === null) return;
    const { clientX, clientY } = this.#at;
    const { agent } = this.#scene.pick(clientX, clientY);
    this.element.hidden = agent === null;
    this.#scene.canvas.style.cursor = agent === null ? "" : "pointer";
    if (agent === null) return;
    setText(this.element, `Person ${agent} ${tellNow(this.#world, agent, this.#time())}`);
    this.element.style.transform = `translate(${clientX + 14}px, ${clientY + 12}px)`;
    this.element.classList.toggle("left", clientX > innerWidth * 0.7);
  };

  #follow(event: PointerEvent): void {
    if (event.buttons !== 0) return this.#leave();
    this.#at = event;
    if (event.timeStamp - this.#last < HOVER_EVERY) return;
    this.#last = event.timeStamp;
    this.update();
  }

  #leave(): void {
    this.#at = null;
    this.element.hidden = true;
  }
}
