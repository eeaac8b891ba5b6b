/** What is being built: the mesh, and the shadows that it throws. */

import type { Skin } from "./palette";
import type { Caster } from "./shade";
import { SolidMesh, type Area, type Point, type PrismOptions } from "./solid";

export class Site {
  readonly mesh = new SolidMesh();
  readonly casters: Caster[] = [];
  readonly skin: Skin;

  constructor(skin: Skin) {
    this.skin = skin;
  }

  /** A box that throws a shadow. */
  box(over: Area, from: number, to: number, colour: number, options: PrismOptions = {}): void {
    this.mesh.box(over, from, to, colour, options);
    this.casters.push({ ...over, from, to });
  }

  /** A prism over any outline; its shadow is that of the rectangle round it. */
  prism(outline: readonly Point[], from: number, to: number, colour: number, options: PrismOptions = {}): void {
    this.mesh.prism(outline, from, to, colour, options);
    const xs = outline.map((p) => p[0]);
    const ys = outline.map((p) => p[1]);
    const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const tight = outline.length > 12 ? 0.86 : 1;
    this.casters.push(
      { x: (x0 + x1) / 2, y: (y0 + y1) / 2, width: (x1 - x0) * tight, depth: (y1 - y0) * tight, from, to }
    );
  }
}
