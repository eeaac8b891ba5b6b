/** The 3D view of a world: what the panels may ask of it. */

export type Theme = "light" | "dark";
export type View = "overview" | "top" | "street";

export interface Pick {
  readonly agent: number | null;
  readonly location: number | null;
}

export interface SceneStats {
  readonly drawCalls: number;
  /** Script time of the last `draw`, in milliseconds; the GPU's (or the software renderer's) work apart. */
  readonly scriptMs: number;
  /** Of these, what goes into working out where everybody is; the rest hands it to the graphics card. */
  readonly updateMs?: number;
}

export interface SceneOptions {
  readonly theme?: Theme;
  readonly antialias?: boolean;
  readonly width?: number;
  readonly height?: number;
  readonly pixelRatio?: number;
}

/** One step of the scale of the heat map. */
export interface HeatStop {
  /** Person-seconds by square metre. */
  readonly value: number;
  /** As CSS writes it. */
  readonly colour: string;
}

export interface Scene {
  readonly canvas: HTMLCanvasElement;
  /** Draws the world as it is at a time, in seconds. */
  draw(time: number): void;
  /** Marks a person and the partners of what the person is at, and dims the rest a little; null for nobody. */
  select(agent: number | null): void;
  /** Marks the people of a group. */
  selectGroup(group: number | null): void;
  /** Lets the camera go with a person; null lets it stand. */
  follow(agent: number | null): void;
  /** Moves the camera smoothly to one of the standard views. */
  view(view: View): void;
  /** Moves the camera smoothly to a location. */
  lookAt(location: number): void;
  /** What is under a point of the page. */
  pick(clientX: number, clientY: number): Pick;
  /** Shows where people were over the whole time, as colours on the floor. */
  heat(on: boolean): void;
  /** The scale of the heat map, from little to much. */
  heatLegend?(): readonly HeatStop[];
  names(on: boolean): void;
  theme(theme: Theme): void;
  resize(width: number, height: number, pixelRatio: number): void;
  stats(): SceneStats;
  /** True while something moves by itself, such as the camera on its way: draw again soon. */
  readonly moving?: boolean;
  dispose?(): void;
}
