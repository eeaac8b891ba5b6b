/** Marks on the floor: a soft dark spot under everybody, rings round the chosen, links between partners. */

import {
  BufferAttribute, Color, CustomBlending, DynamicDrawUsage, InstancedBufferGeometry, InstancedInterleavedBuffer,
  InterleavedBufferAttribute, Mesh, OneMinusSrcAlphaFactor, ShaderMaterial, SrcAlphaFactor,
} from "three";

const STRIDE = 12;
const KINDS = { spot: 0, ring: 1, link: 2 } as const;
const MOST_EXTRA = 600;
const SPOT = 0x1a1620;

const VERTEX = /* glsl */ `
attribute vec4 rect;   // middle, half length, half width
attribute vec4 tint;   // colour, share
attribute vec4 shape;  // angle, kind, unused
varying vec2 local;
varying vec4 colour;
varying vec3 form;
void main() {
  vec2 half2 = rect.zw;
  local = position.xy * half2;
  float s = sin(shape.x), c = cos(shape.x);
  vec2 at = rect.xy + vec2(c * local.x - s * local.y, s * local.x + c * local.y);
  colour = tint;
  form = vec3(half2, shape.y);
  gl_Position = projectionMatrix * viewMatrix * vec4(at, 0.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
varying vec2 local;
varying vec4 colour;
varying vec3 form;
void main() {
  float share = 0.0;
  float r = length(local / form.xy);
  float w = fwidth(r);
  if (form.z < 0.5) {
    share = 1.0 - smoothstep(0.15, 1.0, r);
  } else if (form.z < 1.5) {
    share = smoothstep(1.0, 1.0 - w, r) * smoothstep(0.80 - w, 0.80, r) + 0.22 * smoothstep(0.80, 0.80 - w, r);
  } else {
    float across = abs(local.y) / form.y;
    float wa = fwidth(across);
    float ends = smoothstep(form.x, form.x - 0.12, abs(local.x));
    share = smoothstep(1.0, 1.0 - wa, across) * ends;
  }
  gl_FragColor = vec4(colour.rgb, colour.a * share);
  #include <colorspace_fragment>
}
`;

export class FloorMarks {
  readonly mesh: Mesh;
  private readonly buffer: InstancedInterleavedBuffer;
  private readonly values: Float32Array;
  private readonly geometry = new InstancedBufferGeometry();
  private readonly colour = new Color();
  private n = 0;

  constructor(nPeople: number) {
    this.buffer = new InstancedInterleavedBuffer(new Float32Array(STRIDE * (nPeople + MOST_EXTRA)), STRIDE);
    this.values = this.buffer.array as Float32Array;
    this.buffer.setUsage(DynamicDrawUsage);
    const corners = Float32Array.from([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);
    this.geometry.setAttribute("position", new BufferAttribute(corners, 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    ["rect", "tint", "shape"].forEach(
      (name, i) => this.geometry.setAttribute(name, new InterleavedBufferAttribute(this.buffer, 4, 4 * i))
    );
    const material = new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, depthTest: false, depthWrite: false,
      blending: CustomBlending, blendSrc: SrcAlphaFactor, blendDst: OneMinusSrcAlphaFactor,
    });
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 6;
  }

  begin(): void {
    this.n = 0;
  }

  spot(x: number, y: number, radius: number, share: number): void {
    this.rect(x, y, radius, radius, 0);
    this.fill(KINDS.spot, SPOT, share);
  }

  ring(x: number, y: number, radius: number, colour: number, share = 1): void {
    this.rect(x, y, radius, radius, 0);
    this.fill(KINDS.ring, colour, share);
  }

  link(x0: number, y0: number, x1: number, y1: number, colour: number, width: number): void {
    const long = Math.hypot(x1 - x0, y1 - y0) / 2;
    this.rect((x0 + x1) / 2, (y0 + y1) / 2, long, width, Math.atan2(y1 - y0, x1 - x0));
    this.fill(KINDS.link, colour, 0.75);
  }

  end(): void {
    this.geometry.instanceCount = this.n;
    this.buffer.clearUpdateRanges();
    if (this.n === 0) return;
    this.buffer.addUpdateRange(0, this.n * STRIDE);
    this.buffer.needsUpdate = true;
  }

  private rect(x: number, y: number, long: number, wide: number, angle: number): void {
    const to = this.n * STRIDE;
    this.values[to] = x;
    this.values[to + 1] = y;
    this.values[to + 2] = long;
    this.values[to + 3] = wide;
    this.values[to + 8] = angle;
  }

  /** Completes the mark whose rectangle has been written; those beyond the room there is are left out. */
  private fill(kind: number, colour: number, share: number): void {
    const to = this.n * STRIDE;
    if (to >= this.values.length) return;
    this.colour.setHex(colour);
    this.values[to + 4] = this.colour.r;
    this.values[to + 5] = this.colour.g;
    this.values[to + 6] = this.colour.b;
    this.values[to + 7] = share;
    this.values[to + 9] = kind;
    this.n += 1;
  }
}
