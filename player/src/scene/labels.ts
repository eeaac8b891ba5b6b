/** Names of places: text drawn once on a canvas, shown as one mesh of pixel-exact plates. */

import {
  BufferAttribute, CanvasTexture, CustomBlending, DynamicDrawUsage, InstancedBufferGeometry, InstancedInterleavedBuffer,
  InterleavedBufferAttribute, LinearFilter, Mesh, OneFactor, OneMinusSrcAlphaFactor, ShaderMaterial, Vector2, Vector3,
  type Camera,
} from "three";
import { placeLabels, type Candidate } from "./label_layout";
import { css, type Skin } from "./palette";

export interface Label {
  readonly text: string;
  readonly x: number;
  readonly y: number;
  /** Top of what it names; a thin stem goes down to it. */
  readonly z: number;
  readonly colour: number;
  /** Size of what it names, metres: larger things keep their names longer. */
  readonly size: number;
}

interface Plate {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

const STRIDE = 12;
const FONTS = 'system-ui, "Segoe UI", Roboto, "Helvetica Neue", "Noto Sans", "DejaVu Sans", sans-serif';
const FADE_MS = 180;
const STEM = 0.95;

const VERTEX = /* glsl */ `
attribute vec4 screen; // left, top, width, height, in pixels
attribute vec4 source; // the same in the atlas
attribute vec4 look;   // share
uniform vec2 screenSize, atlasSize;
varying vec2 uv2;
varying float share;
void main() {
  vec2 at = screen.xy + position.xy * screen.zw;
  uv2 = (source.xy + position.xy * source.zw) / atlasSize;
  share = look.x;
  gl_Position = vec4(at.x / screenSize.x * 2.0 - 1.0, 1.0 - at.y / screenSize.y * 2.0, 0.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
uniform sampler2D atlas;
varying vec2 uv2;
varying float share;
void main() {
  gl_FragColor = texture2D(atlas, uv2) * share;
}
`;

export class Labels {
  readonly mesh: Mesh;
  private readonly labels: readonly Label[];
  private readonly plates: Plate[] = [];
  private readonly shares: Float32Array;
  private readonly buffer: InstancedInterleavedBuffer;
  private readonly geometry = new InstancedBufferGeometry();
  private readonly screenSize = { value: new Vector2(1, 1) };
  private readonly atlasSize = { value: new Vector2(1, 1) };
  private readonly atlas = { value: null as CanvasTexture | null };
  private readonly point = new Vector3();
  private stemSource: Plate = { x: 1, y: 1, width: 1, height: 1 };
  private scale = 1;
  private last = -1;
  private n = 0;

  constructor(labels: readonly Label[]) {
    this.labels = labels;
    this.shares = new Float32Array(labels.length);
    this.buffer = new InstancedInterleavedBuffer(new Float32Array(STRIDE * 2 * Math.max(labels.length, 1)), STRIDE);
    this.buffer.setUsage(DynamicDrawUsage);
    this.geometry.setAttribute(
      "position",
      new BufferAttribute(Float32Array.from([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]), 3),
    );
    this.geometry.setIndex([0, 2, 1, 0, 3, 2]);
    ["screen", "source", "look"].forEach(
      (name, i) => this.geometry.setAttribute(name, new InterleavedBufferAttribute(this.buffer, 4, 4 * i))
    );
    const material = new ShaderMaterial({
      uniforms: { screenSize: this.screenSize, atlasSize: this.atlasSize, atlas: this.atlas },
      vertexShader: VERTEX, fragmentShader: FRAGMENT, depthTest: false, depthWrite: false,
      blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor, transparent: true,
    });
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 100;
  }

  /** Draws the texts anew, for a theme and a resolution: `scale` is how many pixels a CSS pixel at normal size has. */
  paint(skin: Skin, width: number, height: number, scale: number): void {
    this.screenSize.value.set(width, height);
    this.scale = scale;
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("2d")!;
    const font = `500 ${12.5 * scale}px ${FONTS}`;
    context.font = font;
    this.arrange(this.labels.map((label) => context.measureText(label.text).width), canvas);
    context.font = font;
    this.plates.forEach((plate, i) => drawPlate(context, plate, this.labels[i]!, skin, scale));
    context.fillStyle = skin.label.text;
    context.fillRect(0, 0, 3, 3);
    this.stemSource = { x: 1, y: 1, width: 1, height: 1 };
    this.atlas.value?.dispose();
    const texture = new CanvasTexture(canvas);
    texture.flipY = false;
    texture.premultiplyAlpha = true;
    texture.generateMipmaps = false;
    texture.minFilter = LinearFilter;
    this.atlas.value = texture;
    this.atlasSize.value.set(canvas.width, canvas.height);
  }

  /** Places the names for a camera; those without room fade away. Says whether any is still fading. */
  update(camera: Camera, now: number): boolean {
    const first = this.last < 0;
    const step = first ? 1 : Math.min((now - this.last) / FADE_MS, 1);
    this.last = now;
    const boxes: (Candidate["box"] | null)[] = this.labels.map(
      (label, i) => this.boxOf(label, this.plates[i]!, camera)
    );
    const shown = new Set(placeLabels(this.candidates(boxes, camera)));
    let fading = false;
    this.n = 0;
    boxes.forEach((box, i) => {
      const goal = box !== null && shown.has(i) ? 1 : 0;
      this.shares[i] = goal > this.shares[i]! ? Math.min(
        goal,
        this.shares[i]! + step,
      ) : Math.max(goal, this.shares[i]! - step);
      if (this.shares[i] !== goal) fading = true;
      if (box !== null && this.shares[i]! > 0) this.put(box, this.plates[i]!, this.shares[i]!);
    });
    this.geometry.instanceCount = this.n;
    this.buffer.needsUpdate = true;
    return fading;
  }

  private candidates(boxes: readonly (Candidate["box"] | null)[], camera: Camera): Candidate[] {
    return boxes.flatMap((box, label) => {
      if (box === null) return [];
      const { x, y, z, size } = this.labels[label]!;
      const far = this.point.set(x, y, z).distanceTo(camera.position);
      // A small step down for who is hidden now, so that names do not flicker back and forth.
      return [{ label, box, rank: far / Math.sqrt(size) - 0.5 * this.shares[label]! }];
    });
  }

  private boxOf(label: Label, plate: Plate, camera: Camera): Candidate["box"] | null {
    this.point.set(label.x, label.y, label.z + STEM).project(camera);
    const { x, y, z } = this.point;
    if (z > 1 || z < -1 || Math.abs(x) > 1.05 || Math.abs(y) > 1.05) return null;
    const left = Math.round(((x + 1) / 2) * this.screenSize.value.x - plate.width / 2);
    const top = Math.round(((1 - y) / 2) * this.screenSize.value.y - plate.height);
    return { x: left, y: top, width: plate.width, height: plate.height };
  }

  private put(box: Candidate["box"], plate: Plate, share: number): void {
    const stem = Math.max(1, Math.round(this.scale));
    const long = Math.round(9 * this.scale);
    this.write(
      Math.round(box.x + box.width / 2 - stem / 2),
      box.y + box.height,
      stem,
      long,
      this.stemSource,
      0.45 * share,
    );
    this.write(box.x, box.y, box.width, box.height, plate, share);
  }

  private write(x: number, y: number, width: number, height: number, source: Plate, share: number): void {
    const values = this.buffer.array as Float32Array;
    const to = this.n * STRIDE;
    values[to] = x;
    values[to + 1] = y;
    values[to + 2] = width;
    values[to + 3] = height;
    values[to + 4] = source.x;
    values[to + 5] = source.y;
    values[to + 6] = source.width;
    values[to + 7] = source.height;
    values[to + 8] = share;
    this.n += 1;
  }

  /** Rows of plates on a canvas that is large enough. */
  private arrange(widths: readonly number[], canvas: HTMLCanvasElement): void {
    const height = Math.ceil(23 * this.scale);
    const widest = 2048;
    let [x, y] = [6, 6];
    this.plates.length = 0;
    for (const text of widths) {
      const width = Math.min(Math.ceil(text + 29 * this.scale), widest - 12);
      if (x + width > widest) [x, y] = [6, y + height + 2];
      this.plates.push({ x, y, width, height });
      x += width + 2;
    }
    canvas.width = widest;
    canvas.height = y + height + 4;
  }
}

function drawPlate(context: CanvasRenderingContext2D, plate: Plate, label: Label, skin: Skin, scale: number): void {
  const { x, y, width, height } = plate;
  context.beginPath();
  context.roundRect(x + scale, y + scale, width - 2 * scale, height - 2 * scale, (height - 2 * scale) / 2);
  context.fillStyle = skin.label.back;
  context.fill();
  context.lineWidth = scale;
  context.strokeStyle = skin.label.edge;
  context.stroke();
  context.beginPath();
  context.arc(x + 11.5 * scale, y + height / 2, 3.4 * scale, 0, 2 * Math.PI);
  context.fillStyle = css(label.colour);
  context.fill();
  context.fillStyle = skin.label.text;
  context.textBaseline = "middle";
  context.fillText(label.text, x + 19 * scale, y + height / 2 + 0.6 * scale, width - 26 * scale);
}
