/** The player: scene, panels and time, put together. */

import type { World } from "../world/world";
import type { PlayerApi } from "./api";
import { perform, seek } from "./commands";
import { createDock } from "./dock";
import { el } from "./dom";
import { createGraphView } from "./graph_view";
import { parseHash, type HashWishes } from "./hash";
import { createHeader, sentenceOf } from "./header";
import { createHeatLegend } from "./heat_legend";
import { createHelp } from "./help";
import { listenToKeys, type Command } from "./keyboard";
import { Loop } from "./loop";
import { createPanel, type Live, type PanelActions } from "./panel";
import { listenToPointer } from "./pointer";
import { createSearchBox } from "./search_box";
import { createStage } from "./stage";
import { focusOf, initialState, type Focus, type PlayerStore, type State } from "./state";
import { Store } from "./store";
import { createToolbar } from "./toolbar";

/** Milliseconds between two updates of the panels. */
const PANELS_EVERY = 200;

/** More pixels than this cost time and are not seen. */
const SHARPEST = 2;

export interface Player {
  readonly api: PlayerApi;
  /** Stops it and lets go of the page. */
  readonly stop: () => void;
}

/** Plays a world in `root`, which it fills. */
export function startPlayer(root: HTMLElement, world: World): Player {
  document.title = sentenceOf(world);
  return new App(root, world, parseHash(location.hash));
}

class App implements Player {
  readonly api: PlayerApi;
  readonly #world: World;
  readonly #store: PlayerStore;
  readonly #scene;
  readonly #live: Live[] = [];
  readonly #loop = new Loop((seconds) => this.#tick(seconds));
  readonly #ended = new AbortController();
  #panels = { at: 0, time: Number.NaN };
  #drawn: () => void = () => {};

  constructor(root: HTMLElement, world: World, wishes: HashWishes) {
    this.#world = world;
    this.#store = new Store(initialState(world, wishes));
    const stage = createStage(world, this.#store.state.theme);
    this.#scene = stage.scene;
    const ready = new Promise<void>((resolve) => {
      this.#drawn = resolve;
    });
    this.api = this.#createApi(ready);
    root.replaceChildren(this.#scene.canvas, ...this.#createPanels(stage.notice));
    root.classList.toggle("bare", wishes.ui === false);
    this.#watch();
    this.#listen();
    this.#scene.view(this.#store.state.view ?? "overview");
    this.#fit();
  }

  stop(): void {
    this.#ended.abort();
    this.#loop.stop();
    this.#scene.dispose?.();
    this.#scene.canvas.remove();
  }

  #createPanels(notice: string): Node[] {
    const { signal } = this.#ended;
    const search = createSearchBox(this.#world, (focus) => this.#goTo(focus));
    const run = (command: Command): void => this.#run(command, search.open);
    listenToKeys(run, signal);
    const actions = this.#createActions(run);
    const panel = createPanel(this.#world, this.#store, actions);
    const graph = createGraphView(this.#world, this.#store, actions);
    const label = listenToPointer(this.#scene, this.#world, {
      time: () => this.#store.state.time,
      choose: (focus) => this.#focus(focus),
      moved: () => this.#store.set({ view: null }),
      wake: this.#loop.wake,
    });
    this.#live.push(panel, graph, label);
    const said = el("p", { class: "notice card", text: notice, attrs: { role: "status" } });
    said.hidden = notice === "";
    const tools = el("div", { class: "tools" }, search.element, createToolbar(this.#store, run));
    const dock = createDock(this.#world, this.#store);
    const left = el(
      "div",
      { class: "left" },
      createHeader(this.#world),
      said,
      createHeatLegend(this.#scene, this.#store),
    );
    const ui = el("div", { class: "ui" }, left, tools, panel.element, graph.element, dock);
    return [ui, label.element, createHelp(this.#store)];
  }

  #createActions(run: (command: Command) => void): PanelActions {
    return {
      seek: (time) => seek(this.#store, this.#world, time),
      focus: (focus) => this.#focus(focus),
      lookAt: (location) => {
        this.#scene.lookAt(location);
        this.#loop.wake();
      },
      toggle: (kind) => run({ kind }),
    };
  }

  #createApi(ready: Promise<void>): PlayerApi {
    const [store, scene, loop] = [this.#store, this.#scene, this.#loop];
    return {
      ready,
      duration: this.#world.duration,
      get time() {
        return store.state.time;
      },
      get playing() {
        return store.state.playing;
      },
      get selected() {
        return store.state.focus?.kind === "person" ? store.state.focus.id : null;
      },
      seek: (time) => seek(store, this.#world, time),
      play: () => store.set({ playing: true }),
      pause: () => store.set({ playing: false }),
      select: (agent) => this.#focus(agent === null ? null : focusOf(this.#world, { agent })),
      pick: (x, y) => scene.pick(x, y),
      stats: () => ({ drawCalls: scene.stats().drawCalls, scriptMs: loop.scriptMs, nFrames: loop.nFrames }),
    };
  }

  /** Passes on what changes to the scene. */
  #watch(): void {
    const [store, scene] = [this.#store, this.#scene];
    store.watch(["focus", "following"], ({ focus, following }) => {
      const agent = focus?.kind === "person" ? focus.id : null;
      scene.select(agent);
      scene.selectGroup(focus?.kind === "group" ? focus.id : null);
      scene.follow(following ? agent : null);
    });
    store.watch(["heat"], ({ heat }) => scene.heat(heat));
    store.watch(["names"], ({ names }) => scene.names(names));
    store.watch(["theme"], ({ theme }) => {
      document.documentElement.dataset["theme"] = theme;
      scene.theme(theme);
    });
    const anything = Object.keys(store.state) as (keyof State)[];
    store.watch(anything, this.#loop.wake);
  }

  #listen(): void {
    const { signal } = this.#ended;
    addEventListener("resize", () => this.#fit(), { signal });
    addEventListener("hashchange", () => this.#heed(parseHash(location.hash)), { signal });
  }

  #fit(): void {
    this.#scene.resize(innerWidth, innerHeight, Math.min(devicePixelRatio, SHARPEST));
    this.#loop.wake();
  }

  /** A changed address is a wish anew. */
  #heed(wishes: HashWishes): void {
    const { theme, names } = this.#store.state;
    this.#store.set(initialState(this.#world, { theme, names, ...wishes }));
    this.#scene.view(this.#store.state.view ?? "overview");
  }

  #run(command: Command, openSearch: () => void): void {
    perform(command, this.#store, this.#world, openSearch);
    if (command.kind !== "view") return;
    this.#scene.view(command.view);
    this.#loop.wake();
  }

  #focus(focus: Focus | null): void {
    const following = focus?.kind === "person" && this.#store.state.following;
    this.#store.set({ focus, following });
  }

  /** What a search found: put it in focus, and go there. */
  #goTo(focus: Focus): void {
    this.#store.set({ focus, following: focus.kind === "person" });
    if (focus.kind === "place") this.#scene.lookAt(focus.id);
  }

  #tick(seconds: number): boolean {
    this.#advance(seconds);
    const { time, playing } = this.#store.state;
    this.#scene.draw(time);
    this.#updatePanels(time);
    this.#drawn();
    return playing || this.#scene.moving === true;
  }

  #advance(seconds: number): void {
    const { playing, speed, time } = this.#store.state;
    if (!playing) return;
    const next = time + seconds * speed;
    const ends = next >= this.#world.duration;
    this.#store.set(ends ? { time: this.#world.duration, playing: false } : { time: next });
  }

  #updatePanels(time: number): void {
    const now = performance.now();
    if (time === this.#panels.time || now - this.#panels.at < PANELS_EVERY) return;
    this.#panels = { at: now, time };
    for (const live of this.#live) live.update(this.#store.state);
  }
}
