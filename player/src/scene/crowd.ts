/** The crowd on the screen: figures the finer the larger they are there, and everybody's shadow. */

import {
  BufferAttribute, BufferGeometry, Color, CustomBlending, DataTexture, DynamicDrawUsage, EqualStencilFunc, FloatType,
  Group, IncrementStencilOp, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Mesh,
  NearestFilter, OneMinusSrcAlphaFactor, RGBAFormat, ShaderMaterial, SrcAlphaFactor, Vector4,
} from "three";
import { AT, STRIDE, type Cast } from "./cast";
import { CROWD_FRAGMENT, CROWD_VERTEX, LEAST_GIRTH, SHADOW_FRAGMENT, SHADOW_VERTEX } from "./crowd_shader";
import { buildFigure } from "./figure";
import type { LightUniforms } from "./light";
import type { Detail, FigureMesh } from "./loft";
import type { Look } from "./palette";
import type { PoseTable } from "./pose_table";

/** Where the camera is, and how tall a metre at one metre's distance is on the screen, in pixels. */
export interface Eye {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  readonly pixels: number;
}

/** How tall a figure is on the screen, in pixels, from which on it has detail 1 and 2. */
const DETAIL_FROM_PX = [36, 96] as const;
const BYTES = 16;

/** One set of buffers: the people drawn with one mesh. */
interface Cohort {
  readonly moving: InstancedInterleavedBuffer;
  readonly looks: InstancedInterleavedBuffer;
  readonly geometries: readonly InstancedBufferGeometry[];
  n: number;
}

export class Crowd {
  readonly shadows = new Group();
  readonly figures = new Group();
  /** By person, 0 plain to 1 faded into the background. */
  readonly dimming: Float32Array;
  /** By detail. */
  private readonly cohorts: readonly [Cohort, Cohort, Cohort];
  private readonly looks: Uint8Array;
  private readonly mist = { value: new Color() };
  private readonly shadow = { value: new Vector4(0.16, 0.14, 0.2, 0.3) };

  constructor(looks: readonly Look[], table: PoseTable, light: LightUniforms) {
    this.dimming = new Float32Array(looks.length);
    this.looks = packedLooks(looks);
    const meshes = ([0, 1, 2] as const).map((detail) => geometryOf(buildFigure(detail)));
    const n = looks.length;
    // A shadow needs less detail than who throws it.
    const cohortOf = (detail: Detail): Cohort => cohort(n, [meshes[detail]!, meshes[Math.max(detail - 1, 0)]!]);
    this.cohorts = [cohortOf(0), cohortOf(1), cohortOf(2)];
    const poses = { value: poseTexture(table) };
    const uniforms = { ...light, poses, mist: this.mist, shadow: this.shadow };
    this.cohorts.forEach(({ geometries }, detail) => {
      const defines = detail === 2 ? { FINE: 1 } : {};
      const shaders = { vertexShader: CROWD_VERTEX, fragmentShader: CROWD_FRAGMENT };
      this.figures.add(drawn(geometries[0]!, new ShaderMaterial({ uniforms, defines, ...shaders }), 20));
      this.shadows.add(drawn(geometries[1]!, shadowMaterial(uniforms), 5));
    });
  }

  setColours(mist: number, shadow: readonly [number, number, number, number]): void {
    this.mist.value.setHex(mist);
    this.shadow.value.set(...shadow);
  }

  /** Sorts those in sight by how large they are on the screen, and hands them to the graphics card. */
  update(cast: Cast, eye: Eye): void {
    for (const group of this.cohorts) group.n = 0;
    const [first, second] = DETAIL_FROM_PX;
    for (let agent = 0; agent < cast.count; agent += 1) {
      const base = STRIDE * agent;
      if (cast.values[base + AT.presence]! <= 0) continue;
      const dx = cast.values[base]! - eye.x;
      const dy = cast.values[base + 1]! - eye.y;
      const tall = (1.75 * eye.pixels) / Math.sqrt(dx * dx + dy * dy + eye.z * eye.z);
      cast.values[base + AT.dim] = this.dimming[agent]!;
      this.put(this.cohorts[tall < first ? 0 : tall < second ? 1 : 2], agent, cast.values);
    }
    for (const group of this.cohorts) publish(group);
  }

  private put(group: Cohort, agent: number, values: Float32Array): void {
    const moving = group.moving.array as Float32Array;
    const looks = group.looks.array as Uint8Array;
    const to = group.n * STRIDE;
    const from = agent * STRIDE;
    for (let k = 0; k < STRIDE; k += 1) moving[to + k] = values[from + k]!;
    const heading = values[from + AT.heading]!;
    const height = values[from + AT.height]!;
    moving[to + 2] = Math.cos(heading) * height;
    moving[to + 3] = Math.sin(heading) * height;
    for (let k = 0; k < BYTES; k += 1) looks[group.n * BYTES + k] = this.looks[agent * BYTES + k]!;
    group.n += 1;
  }
}

function publish(group: Cohort): void {
  for (const geometry of group.geometries) geometry.instanceCount = group.n;
  for (const [buffer, stride] of [[group.moving, STRIDE], [group.looks, BYTES]] as const) {
    buffer.clearUpdateRanges();
    if (group.n === 0) continue;
    buffer.addUpdateRange(0, group.n * stride);
    buffer.needsUpdate = true;
  }
}

function drawn(geometry: BufferGeometry, material: ShaderMaterial, order: number): Mesh {
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = order;
  mesh.matrixAutoUpdate = false;
  return mesh;
}

/** On the floor only, and every place once, however many shadows fall on it. */
function shadowMaterial(uniforms: ShaderMaterial["uniforms"]): ShaderMaterial {
  return new ShaderMaterial({
    uniforms,
    vertexShader: SHADOW_VERTEX,
    fragmentShader: SHADOW_FRAGMENT,
    depthTest: false,
    depthWrite: false,
    blending: CustomBlending,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
    stencilWrite: true,
    stencilFunc: EqualStencilFunc,
    stencilRef: 0,
    stencilZPass: IncrementStencilOp,
  });
}

function geometryOf(mesh: FigureMesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(mesh.positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(Float32Array.from(mesh.normals), 3));
  geometry.setAttribute("skin", new BufferAttribute(Float32Array.from(mesh.skins), 4));
  geometry.setAttribute("extra", new BufferAttribute(Float32Array.from(mesh.extras), 2));
  geometry.setIndex(new BufferAttribute(Uint16Array.from(mesh.index), 1));
  return geometry;
}

function cohort(n: number, meshes: readonly BufferGeometry[]): Cohort {
  const moving = new InstancedInterleavedBuffer(new Float32Array(n * STRIDE), STRIDE);
  const looks = new InstancedInterleavedBuffer(new Uint8Array(n * BYTES), BYTES);
  moving.setUsage(DynamicDrawUsage);
  looks.setUsage(DynamicDrawUsage);
  return { moving, looks, n: 0, geometries: meshes.map((mesh) => instanced(mesh, moving, looks)) };
}

function instanced(
  mesh: BufferGeometry,
  moving: InstancedInterleavedBuffer,
  looks: InstancedInterleavedBuffer,
): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  for (const name of ["position", "normal", "skin", "extra"]) geometry.setAttribute(name, mesh.getAttribute(name));
  geometry.setIndex(mesh.getIndex());
  ["place", "poseA", "poseB", "manner"].forEach((name, i) => {
    geometry.setAttribute(name, new InterleavedBufferAttribute(moving, 4, 4 * i));
  });
  ["shirtAttr", "legsAttr", "skinAttr", "hairAttr"].forEach((name, i) => {
    geometry.setAttribute(name, new InterleavedBufferAttribute(looks, 4, 4 * i, true));
  });
  geometry.instanceCount = 0;
  return geometry;
}

function poseTexture(table: PoseTable): DataTexture {
  const texture = new DataTexture(table.texels, table.width, table.height, RGBAFormat, FloatType);
  texture.minFilter = NearestFilter;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Four colours by person, each with a fourth byte of its own (crowd_shader.ts). */
function packedLooks(looks: readonly Look[]): Uint8Array {
  const bytes = new Uint8Array(BYTES * looks.length);
  looks.forEach((look, i) => {
    const { shirt, trousers, skin, hair, shoes, longSleeves, parts, girth } = look;
    const rows = [
      [shirt, parts],
      [trousers, longSleeves ? 255 : 0],
      [skin, Math.round((girth - LEAST_GIRTH) * 255)],
      [hair, Math.round(255 * shoes)],
    ] as const;
    rows.forEach(([colour, more], k) => {
      bytes.set([(colour >> 16) & 255, (colour >> 8) & 255, colour & 255, more], BYTES * i + 4 * k);
    });
  });
  return bytes;
}
