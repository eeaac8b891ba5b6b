/** The camera: standard views, smooth ways between them, going along with a person, and the mouse. */

import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { smooth } from "./gait";
import type { Bounds } from "./occupancy";

const FIELD_DEG = 30;
const WAY_MS = 900;
const FOLLOW_M = 9;
/** Share of the picture that the place fills. */
const FILL = 0.96;
/** How soon the camera has caught up with who it follows. */
const CATCH_UP_MS = 160;

/** Where a camera stands and what it looks at. */
export interface Shot {
  readonly eye: Vector3;
  readonly target: Vector3;
}

export class CameraRig {
  readonly camera = new PerspectiveCamera(FIELD_DEG, 1, 0.4, 1500);
  readonly controls: OrbitControls;
  private way: { from: Shot; to: Shot; start: number } | null = null;
  private started = false;
  private last = 0;
  private readonly step = new Vector3();

  constructor(canvas: HTMLCanvasElement, bounds: Bounds) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    const extent = Math.hypot(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = 1.52;
    this.controls.minDistance = 2;
    this.controls.maxDistance = 4 * extent + 20;
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = false;
    this.controls.addEventListener("start", () => (this.way = null));
  }

  /** Goes to a shot: at once before the first picture, smoothly later. */
  go(shot: Shot, now: number): void {
    if (this.started) this.way = { from: this.shot(), to: shot, start: now };
    else this.set(shot);
  }

  shot(): Shot {
    return { eye: this.camera.position.clone(), target: this.controls.target.clone() };
  }

  /** A shot of a person from where the camera looks now, near enough to see what the person does. */
  shotOf(x: number, y: number): Shot {
    const target = new Vector3(x, y, 0.95);
    const way = this.camera.position.clone().sub(this.controls.target);
    const far = Math.min(way.length(), FOLLOW_M);
    way.normalize();
    if (way.z > 0.6) way.set(way.x, way.y, 0).normalize().multiplyScalar(0.87).setZ(0.5);
    return { eye: target.clone().addScaledVector(way.normalize(), far), target };
  }

  /** Once a picture. `followed` is where the person is whom the camera goes along with. */
  update(now: number, followed: { readonly x: number; readonly y: number } | null): void {
    const passed = this.started ? Math.min(now - this.last, 250) : 0;
    this.last = now;
    this.started = true;
    if (this.way !== null) this.travel(now, followed);
    else if (followed !== null) this.goAlong(passed, followed);
    this.controls.update();
    if (this.camera.position.z < 0.3) this.camera.position.z = 0.3;
  }

  get moving(): boolean {
    return this.way !== null;
  }

  resize(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** The shot from a direction in which all rectangles, up to a height, are in the picture. */
  framing(areas: readonly Bounds[], direction: Vector3, height = 2.5): Shot {
    const target = new Vector3();
    const back = direction.clone().normalize();
    const right = new Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const tan = Math.tan((FIELD_DEG * Math.PI) / 360) * FILL;
    const [tanX, tanY] = [tan * this.camera.aspect, tan];
    let [left, wide, low, high] = [-Infinity, -Infinity, -Infinity, -Infinity];
    for (const p of areas.flatMap((area) => cornersOf(area, height))) {
      const [r, u, near] = [p.dot(right), p.dot(up), p.dot(back)];
      wide = Math.max(wide, r + near * tanX);
      left = Math.max(left, -r + near * tanX);
      high = Math.max(high, u + near * tanY);
      low = Math.max(low, -u + near * tanY);
    }
    // With the camera shifted sideways by s, the distance d must hold |r - s| <= (d - near) tan.
    const far = Math.max((wide + left) / (2 * tanX), (high + low) / (2 * tanY));
    target.addScaledVector(right, (wide - left) / 2).addScaledVector(up, (high - low) / 2);
    // Back on to the ground along the line of sight.
    const down = target.z / back.z;
    target.addScaledVector(back, -down);
    return { eye: target.clone().addScaledVector(back, far + down), target };
  }

  private set({ eye, target }: Shot): void {
    this.camera.position.copy(eye);
    this.controls.target.copy(target);
    this.camera.lookAt(target);
  }

  private travel(now: number, followed: { readonly x: number; readonly y: number } | null): void {
    const { from, to, start } = this.way!;
    const share = smooth((now - start) / WAY_MS);
    if (followed !== null) {
      this.step.set(followed.x - to.target.x, followed.y - to.target.y, 0);
      to.target.add(this.step);
      to.eye.add(this.step);
    }
    this.camera.position.lerpVectors(from.eye, to.eye, share);
    this.controls.target.lerpVectors(from.target, to.target, share);
    if (share >= 1) this.way = null;
  }

  private goAlong(passed: number, followed: { readonly x: number; readonly y: number }): void {
    const share = 1 - Math.exp(-passed / CATCH_UP_MS);
    this.step.set(followed.x - this.controls.target.x, followed.y - this.controls.target.y, 0).multiplyScalar(share);
    this.controls.target.add(this.step);
    this.camera.position.add(this.step);
  }
}

function cornersOf({ x0, y0, x1, y1 }: Bounds, height: number): Vector3[] {
  return [0, height].flatMap(
    (z) => [new Vector3(x0, y0, z), new Vector3(x1, y0, z), new Vector3(x0, y1, z), new Vector3(x1, y1, z)]
  );
}
