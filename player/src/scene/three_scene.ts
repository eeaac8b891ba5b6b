/** Puts the parts of the 3D view together: the place, the crowd, marks, names, camera. */

import {
  BufferGeometry, DataTexture, LinearFilter, Mesh, NoToneMapping, RGBAFormat, RGFormat,
  Scene as Stage, SRGBColorSpace, UnsignedByteType, Vector3, WebGLRenderer,
} from "three";
import type { World } from "../world/world";
import { CameraRig } from "./camera";
import { AT, Cast, STRIDE } from "./cast";
import { Crowd } from "./crowd";
import { floorGeometry, floorMesh, floorUniforms } from "./floor";
import { Focus } from "./focus";
import { heightOf, kindsOf, type Kind } from "./kinds";
import { Labels } from "./labels";
import { lightUniforms, setLight, SUN } from "./light";
import { FloorMarks } from "./marks";
import { boundsOf, buildHeatMap, buildOccupancy, type HeatMap, type Occupancy } from "./occupancy";
import { CATEGORY_COLOURS, lookOf, SKINS } from "./palette";
import { pickLocation, pickPerson } from "./picking";
import { buildPoseTable } from "./pose_table";
import type { HeatStop, Pick, Scene, SceneOptions, SceneStats, Theme, View } from "./scene";
import { buildShadeMap } from "./shade";
import { solidMaterial } from "./solid_shader";
import { buildPlace } from "./structure";
import { buildTrack } from "./track";
import { shotFor, shotOfLocation } from "./views";

const PICK_PX = 5;
/** Rings stay at least so large on the screen. */
const RING_PX = 9;
const HEAT_MS = 350;

export class ThreeScene implements Scene {
  readonly canvas: HTMLCanvasElement;
  private readonly world: World;
  private readonly renderer: WebGLRenderer;
  private readonly stage = new Stage();
  private readonly rig: CameraRig;
  private readonly light = lightUniforms();
  private readonly ground = floorUniforms();
  private readonly occupancy: Occupancy;
  private readonly kinds: readonly Kind[];
  private readonly heights: readonly number[];
  private readonly cast: Cast;
  private readonly crowd: Crowd;
  private readonly marks: FloorMarks;
  private readonly labels: Labels;
  private readonly focus: Focus;
  private readonly solids: Mesh;
  private readonly floor: Mesh;
  private heatMapOf: HeatMap | null = null;
  private heatOn = false;
  private followed: number | null = null;
  private standing: View = "overview";
  private skinName: Theme;
  private size = { width: 1, height: 1, ratio: 1 };
  private fading = false;
  private lastDraw = 0;
  private lastStats: SceneStats = { drawCalls: 0, scriptMs: 0, updateMs: 0 };

  constructor(world: World, options: SceneOptions) {
    this.world = world;
    this.renderer = rendererFor(options.antialias ?? true);
    this.canvas = this.renderer.domElement;
    this.skinName = options.theme ?? "light";
    const bounds = boundsOf(world.locations);
    this.rig = new CameraRig(this.canvas, bounds);
    this.occupancy = buildOccupancy(world.frames, world.locations);
    this.kinds = kindsOf(world);
    this.heights = world.locations.map((place, i) => heightOf(place, this.kinds[i]!));
    const looks = world.people.map((person) => lookOf(person.id, person.group));
    const table = buildPoseTable();
    this.cast = new Cast(world, buildTrack(world.frames), table, looks.map((look) => look.height));
    this.crowd = new Crowd(looks, table, this.light);
    this.marks = new FloorMarks(world.people.length);
    this.labels = new Labels(this.labelList());
    this.focus = new Focus(world);
    this.solids = new Mesh(new BufferGeometry(), solidMaterial(this.light, this.ground.heat));
    this.solids.renderOrder = 10;
    this.solids.frustumCulled = false;
    this.floor = floorMesh(bounds, this.light, this.ground);
    this.stage.add(this.floor, this.crowd.shadows, this.marks.mesh, this.solids, this.crowd.figures, this.labels.mesh);
    this.rebuild();
    this.resize(options.width ?? 1280, options.height ?? 800, options.pixelRatio ?? 1);
    this.rig.go(shotFor("overview", world, this.occupancy, this.rig), 0);
  }

  draw(time: number): void {
    const began = performance.now();
    this.cast.update(time);
    this.fadeHeat(began);
    this.rig.update(began, this.placeOf(this.followed));
    this.rig.camera.updateMatrixWorld();
    this.focus.dim(this.crowd.dimming, time);
    const { x, y, z } = this.rig.camera.position;
    const pixels = this.pixelsAtOneMetre();
    this.crowd.update(this.cast, { x, y, z, pixels });
    this.mark(time, pixels);
    this.fading = this.labels.mesh.visible && this.labels.update(this.rig.camera, began);
    const updated = performance.now();
    this.renderer.render(this.stage, this.rig.camera);
    const ended = performance.now();
    this.lastDraw = began;
    this.lastStats = { drawCalls: this.renderer.info.render.calls, scriptMs: ended - began, updateMs: updated - began };
  }

  select(agent: number | null): void {
    this.focus.agent = agent;
    if (agent !== null) this.focus.group = null;
  }

  selectGroup(group: number | null): void {
    this.focus.group = group;
    if (group !== null) this.focus.agent = null;
  }

  follow(agent: number | null): void {
    this.followed = agent;
    const place = this.placeOf(agent);
    if (place !== null) this.rig.go(this.rig.shotOf(place.x, place.y), performance.now());
  }

  view(view: View): void {
    this.followed = null;
    this.standing = view;
    this.rig.go(shotFor(view, this.world, this.occupancy, this.rig), performance.now());
  }

  lookAt(location: number): void {
    const place = this.world.locations[location];
    if (place === undefined) return;
    this.followed = null;
    this.rig.go(shotOfLocation(place, this.rig), performance.now());
  }

  pick(clientX: number, clientY: number): Pick {
    const box = this.canvas.getBoundingClientRect();
    const point = new Vector3(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
      0.5,
    );
    const { position } = this.rig.camera;
    const way = point.unproject(this.rig.camera).sub(position).normalize();
    const ray = { x: position.x, y: position.y, z: position.z, dx: way.x, dy: way.y, dz: way.z };
    const slack = (PICK_PX * this.size.ratio) / this.pixelsAtOneMetre();
    const agent = pickPerson(ray, this.cast.values, this.cast.count, slack);
    return { agent, location: agent === null ? pickLocation(ray, this.world.locations, this.heights) : null };
  }

  heat(on: boolean): void {
    this.heatOn = on;
    if (on && this.ground.heatMap.value === null) this.uploadHeat();
  }

  heatLegend(): readonly HeatStop[] {
    this.heatMapOf ??= buildHeatMap(this.occupancy);
    return this.heatMapOf.legend;
  }

  names(on: boolean): void {
    this.labels.mesh.visible = on;
  }

  theme(theme: Theme): void {
    if (theme === this.skinName) return;
    this.skinName = theme;
    this.rebuild();
    this.paintLabels();
  }

  resize(width: number, height: number, pixelRatio: number): void {
    this.size = { width: Math.max(width, 1), height: Math.max(height, 1), ratio: pixelRatio };
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(this.size.width, this.size.height);
    this.rig.resize(this.size.width / this.size.height);
    if (this.lastDraw === 0) this.rig.go(shotFor(this.standing, this.world, this.occupancy, this.rig), 0);
    this.paintLabels();
  }

  stats(): SceneStats {
    return this.lastStats;
  }

  get moving(): boolean {
    return this.rig.moving || this.fading || this.ground.heat.value !== Number(this.heatOn);
  }

  dispose(): void {
    this.rig.controls.dispose();
    this.renderer.dispose();
  }

  /** Everything that has the colours of the theme in it. */
  private rebuild(): void {
    const skin = SKINS[this.skinName];
    setLight(this.light, this.skinName);
    const { site, patches } = buildPlace(this.world, this.occupancy, skin);
    for (const mesh of [this.solids, this.floor]) mesh.geometry.dispose();
    this.solids.geometry = site.mesh.geometry();
    this.floor.geometry = floorGeometry(boundsOf(this.world.locations), patches, skin);
    this.ground.background.value.setHex(skin.background);
    this.ground.ink.value.setHex(skin.ink);
    this.crowd.setColours(skin.mist, this.skinName === "dark" ? [0.02, 0.02, 0.03, 0.5] : [0.17, 0.15, 0.22, 0.27]);
    this.renderer.setClearColor(skin.background);
    if (this.light.shadeMap.value === null) this.uploadShade(site.casters);
  }

  private uploadShade(casters: Parameters<typeof buildShadeMap>[1]): void {
    const map = buildShadeMap(boundsOf(this.world.locations, 9), casters, SUN);
    const texture = new DataTexture(map.texels, map.nx, map.ny, RGFormat, UnsignedByteType);
    smoothTexture(texture);
    this.light.shadeMap.value = texture;
    this.light.shadeOrigin.value.set(map.bounds.x0, map.bounds.y0);
    this.light.shadeSize.value.set(map.bounds.x1 - map.bounds.x0, map.bounds.y1 - map.bounds.y0);
  }

  private uploadHeat(): void {
    this.heatLegend();
    const { nx, ny, pixels } = this.heatMapOf!;
    const texture = new DataTexture(pixels, nx, ny, RGBAFormat, UnsignedByteType);
    texture.colorSpace = SRGBColorSpace;
    smoothTexture(texture);
    this.ground.heatMap.value = texture;
    const { x0, y0, x1, y1 } = this.occupancy.bounds;
    this.ground.heatRect.value.set(x0, y0, x1 - x0, y1 - y0);
  }

  private fadeHeat(now: number): void {
    const step = this.lastDraw === 0 ? 1 : (now - this.lastDraw) / HEAT_MS;
    const { heat } = this.ground;
    heat.value = this.heatOn ? Math.min(1, heat.value + step) : Math.max(0, heat.value - step);
  }

  private mark(time: number, pixels: number): void {
    const { values, count } = this.cast;
    const { position } = this.rig.camera;
    this.marks.begin();
    for (let agent = 0; agent < count; agent += 1) {
      const base = STRIDE * agent;
      if (values[base + AT.presence]! > 0) this.marks.spot(
        values[base]!,
        values[base + 1]!,
        0.36,
        0.34 * values[base + AT.presence]!,
      );
    }
    const reach = (x: number, y: number): number =>
      (RING_PX * this.size.ratio * Math.hypot(x - position.x, y - position.y, position.z)) / pixels / 0.42;
    this.focus.mark(this.marks, this.cast, time, SKINS[this.skinName], reach);
    this.marks.end();
  }

  private pixelsAtOneMetre(): number {
    return (this.size.height * this.size.ratio) / (2 * Math.tan((this.rig.camera.fov * Math.PI) / 360));
  }

  private placeOf(agent: number | null): { x: number; y: number } | null {
    if (agent === null || !(this.cast.values[STRIDE * agent + AT.presence]! > 0)) return null;
    return { x: this.cast.values[STRIDE * agent]!, y: this.cast.values[STRIDE * agent + 1]! };
  }

  private labelList(): ConstructorParameters<typeof Labels>[0] {
    return this.world.locations.map((place, i) => ({
      text: place.name, x: place.x, y: place.y, z: this.heights[i]!, colour: CATEGORY_COLOURS[place.category],
      size: Math.sqrt(place.width * place.depth),
    }));
  }

  /** Names are a little larger on large screens. */
  private paintLabels(): void {
    const { width, height, ratio } = this.size;
    const grown = Math.min(Math.max(Math.min(width / 1280, height / 800), 1), 2.4) ** 0.8;
    this.labels.paint(SKINS[this.skinName], Math.round(width * ratio), Math.round(height * ratio), ratio * grown);
  }
}

function rendererFor(antialias: boolean): WebGLRenderer {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext(
    "webgl2",
    { antialias, stencil: true, alpha: false, powerPreference: "high-performance" },
  );
  if (context === null) throw new Error(
    "This browser offers no WebGL 2, which the 3D view needs. Turn on hardware acceleration, or use another browser."
  );
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.toneMapping = NoToneMapping;
  renderer.sortObjects = true;
  return renderer;
}

function smoothTexture(texture: DataTexture): void {
  texture.minFilter = LinearFilter;
  texture.magFilter = LinearFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
}
