/** The ground and the floors of areas, in one mesh, painted one over the other; the heat map lies on them. */

import { BufferAttribute, BufferGeometry, Color, Mesh, ShaderMaterial, Vector2, Vector4, type Texture } from "three";
import { LIGHT_GLSL, type LightUniforms } from "./light";
import type { Bounds } from "./occupancy";
import { mixed, type Skin } from "./palette";
import { inset, rectangle, rounded, type Point } from "./solid";

/** A patch of floor, with an edge in another tone. */
export interface Patch {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly depth: number;
  readonly radius: number;
  readonly colour: number;
  readonly edge: number;
  readonly edgeWidth: number;
}

export interface FloorUniforms {
  readonly background: { value: Color };
  readonly ink: { value: Color };
  readonly heatMap: { value: Texture | null };
  /** 0 without the heat map, 1 with it. */
  readonly heat: { value: number };
  readonly heatRect: { value: Vector4 };
}

const FAR_M = 2000;

const VERTEX = /* glsl */ `
attribute vec4 tone;
varying vec4 colour;
varying vec2 onGround;
void main() {
  colour = tone;
  onGround = position.xy;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_GLSL}
uniform vec3 background, ink;
uniform sampler2D heatMap;
uniform float heat;
uniform vec4 heatRect;
uniform vec2 middle;
uniform float reach;
varying vec4 colour;
varying vec2 onGround;

/** Small crosses every ten metres. */
float crosses() {
  vec2 d = abs(fract(onGround / 10.0 + 0.5) - 0.5) * 10.0;
  vec2 w = max(fwidth(onGround), vec2(1e-4));
  vec2 line = clamp((0.014 + w * 0.5 - d) / w, 0.0, 1.0) * step(d.yx, vec2(0.3));
  return max(line.x, line.y) * clamp(0.5 / max(w.x, w.y) - 0.6, 0.0, 1.0);
}

void main() {
  vec3 albedo = colour.rgb;
  vec2 shade = shadeAt(onGround);
  float far = colour.a * smoothstep(0.75 * reach, 2.1 * reach, length(onGround - middle));
  if (colour.a > 0.5) albedo = mix(albedo, ink, 0.5 * crosses() * (1.0 - far));
  if (heat > 0.0) {
    vec2 uv = (onGround - heatRect.xy) / heatRect.zw;
    float grey = dot(albedo, vec3(0.3, 0.5, 0.2));
    albedo = mix(albedo, vec3(grey), 0.7 * heat);
    if (all(greaterThan(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0)))) {
      vec4 use = textureLod(heatMap, uv, 0.0);
      albedo = mix(albedo, use.rgb, use.a * heat);
    }
  }
  vec3 shown = lit(albedo, vec3(0.0, 0.0, 1.0), shade.r) * shade.g;
  gl_FragColor = vec4(mix(shown, background, far), 1.0);
  #include <colorspace_fragment>
}
`;

export function floorUniforms(): FloorUniforms {
  return {
    background: { value: new Color() }, ink: { value: new Color() }, heatMap: { value: null }, heat: { value: 0 },
    heatRect: { value: new Vector4(0, 0, 1, 1) },
  };
}

/** Drawn before all else and without depth, so that nothing fights for the ground. */
export function floorMesh(bounds: Bounds, light: LightUniforms, uniforms: FloorUniforms): Mesh {
  const reach = Math.hypot(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0) / 2;
  const middle = new Vector2((bounds.x0 + bounds.x1) / 2, (bounds.y0 + bounds.y1) / 2);
  const material = new ShaderMaterial({
    uniforms: { ...light, ...uniforms, middle: { value: middle }, reach: { value: reach } },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
  const mesh = new Mesh(new BufferGeometry(), material);
  mesh.renderOrder = 0;
  mesh.frustumCulled = false;
  return mesh;
}

/** The ground, then the patches, large ones first. */
export function floorGeometry(bounds: Bounds, patches: readonly Patch[], skin: Skin): BufferGeometry {
  const build = new FloorBuilder();
  const [x, y] = [(bounds.x0 + bounds.x1) / 2, (bounds.y0 + bounds.y1) / 2];
  build.fill(rectangle(x, y, FAR_M, FAR_M), skin.ground, 1);
  for (const patch of [...patches].sort((a, b) => b.width * b.depth - a.width * a.depth)) build.patch(patch);
  return build.geometry();
}

class FloorBuilder {
  private readonly positions: number[] = [];
  private readonly tones: number[] = [];
  private readonly index: number[] = [];
  private readonly colour = new Color();

  patch({ x, y, width, depth, radius, colour, edge, edgeWidth }: Patch): void {
    const outline = rounded(x, y, width, depth, radius, radius > 0.3 ? 10 : 2);
    this.fill(outline, edge, 0);
    this.fill(inset(outline, Math.min(edgeWidth, width / 3, depth / 3)), colour, 0);
  }

  fill(outline: readonly Point[], colour: number, isGround: number): void {
    const first = this.positions.length / 3;
    this.colour.setHex(colour);
    for (const [x, y] of outline) {
      this.positions.push(x, y, 0);
      this.tones.push(this.colour.r, this.colour.g, this.colour.b, isGround);
    }
    for (let k = 1; k + 1 < outline.length; k += 1) this.index.push(first, first + k, first + k + 1);
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(this.positions), 3));
    geometry.setAttribute("tone", new BufferAttribute(Float32Array.from(this.tones), 4));
    geometry.setIndex(this.index);
    return geometry;
  }
}

/** The tone of an edge round a floor. */
export const edgeTone = (colour: number, ink: number, share = 0.3): number => mixed(colour, ink, share);
