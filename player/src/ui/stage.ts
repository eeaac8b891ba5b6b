/** The scene, or where the browser cannot draw it, a flat map and a line that says so. */

import { createScene } from "../scene/create";
import type { Scene, Theme } from "../scene/scene";
import type { World } from "../world/world";
import { createFlatScene } from "./flat_scene";

export interface Stage {
  readonly scene: Scene;
  /** What the user should know; empty where all is well. */
  readonly notice: string;
}

/** Draws in three dimensions wherever the browser can. */
export function createStage(world: World, theme: Theme): Stage {
  if (!hasWebGl2()) {
    return { scene: createFlatScene(world), notice: "This browser cannot draw in 3D (no WebGL 2): here is the map." };
  }
  try {
    return { scene: createScene(world, { theme }), notice: "" };
  } catch (error) {
    console.error(error);
    return { scene: createFlatScene(world), notice: "The 3D view could not be started: here is the map." };
  }
}

function hasWebGl2(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return context !== null;
}
