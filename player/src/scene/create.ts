/** The 3D view: a `Scene` on three.js. */

import { ThreeScene } from "./three_scene";
import type { World } from "../world/world";
import type { Scene, SceneOptions } from "./scene";

/** The view of a world on a canvas of its own. Throws an `Error` to be shown where the browser has no WebGL 2. */
export function createScene(world: World, options: SceneOptions = {}): Scene {
  return new ThreeScene(world, options);
}
