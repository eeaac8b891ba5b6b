/**
 * The crowd scenario graph of a group as the paper draws it: a row for each person, a node `i_t` for each step,
 * sequence edges along the rows, share edges between partners. What is going on is marked as time runs.
 */

import { phaseAt } from "../world/doing";
import { groupGraph, type GraphNode, type GroupGraph } from "../world/group_graph";
import type { World } from "../world/world";
import { button, el, svg } from "./dom";
import { icon } from "./icons";
import { NODE, cornerOf, pathOf, shortened, sizeOf } from "./graph_layout";
import { SEEN_COLOURS } from "./palette";
import type { Live, PanelActions } from "./panel";
import { setState } from "./panel_parts";
import { groupOf, type PlayerStore } from "./state";
import { clock, counted } from "./words";

const UNIT = 16;
const LONGEST_NAME = 24;

/** The drawer with the graph of the group in focus; empty and hidden where there is none. */
export function createGraphView(world: World, store: PlayerStore, actions: PanelActions): Live {
  const element = el("section", { class: "graph card", label: "Crowd scenario graph" });
  let group: number | null = null;
  let drawing: Drawing | null = null;
  store.watch(["focus", "graph"], (state) => {
    const wanted = state.graph ? groupOf(world, state.focus) : null;
    if (wanted !== group) {
      group = wanted;
      drawing = group === null ? null : new Drawing(world, group, actions);
      element.replaceChildren(...(drawing === null ? [] : [drawing.heading, drawing.body]));
      element.hidden = drawing === null;
    }
    drawing?.select(state.focus?.kind === "person" ? state.focus.id : null);
    drawing?.update(state.time);
    drawing?.reveal(true);
  });
  element.hidden = drawing === null;
  return {
    element,
    update: ({ time }) => {
      drawing?.update(time);
      drawing?.reveal(false);
    },
  };
}

class Drawing {
  readonly heading: HTMLElement;
  readonly body: HTMLElement;
  readonly #world: World;
  readonly #graph: GroupGraph;
  readonly #actions: PanelActions;
  readonly #nodes: readonly SVGGElement[];
  readonly #rows: readonly HTMLElement[];
  #agent: number | null = null;
  #column = -1;

  constructor(world: World, group: number, actions: PanelActions) {
    this.#world = world;
    this.#actions = actions;
    this.#graph = groupGraph(world, group);
    this.#nodes = this.#graph.nodes.map((node) => this.#createNode(node));
    this.#rows = this.#graph.members.map((id, row) => this.#createRowName(id, row));
    this.heading = createHeading(group, this.#graph, actions);
    this.body = el("div", { class: "graph-body" }, el("div", { class: "rows" }, ...this.#rows), this.#createPicture());
  }

  select(agent: number | null): void {
    this.#agent = agent;
    this.#column = -1;
    this.#rows.forEach((row, i) => row.setAttribute("aria-current", String(this.#graph.members[i] === agent)));
    this.#graph.nodes.forEach(({ activity }, i) => this.#nodes[i]!.classList.toggle("own", activity.agent === agent));
  }

  update(time: number): void {
    this.#graph.nodes.forEach((node, i) => setState(this.#nodes[i]!, stateOf(node, time)));
  }

  /** Scrolls to where the person in focus is, unless the pointer is in the graph. */
  reveal(atOnce: boolean): void {
    const at = this.#graph.nodes.findLastIndex(({ activity }, i) => {
      const state = this.#nodes[i]!.getAttribute("data-state");
      return (this.#agent === null || activity.agent === this.#agent) && state !== "future";
    });
    const node = this.#graph.nodes[at];
    const unseen = this.body.clientWidth === 0;
    if (node === undefined || node.column === this.#column || unseen || this.body.matches(":hover")) return;
    this.#column = node.column;
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const x = (cornerOf(node).x / UNIT) * rem - this.body.clientWidth * 0.3;
    const calm = atOnce || matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.body.scrollTo({ left: Math.max(x, 0), behavior: calm ? "instant" : "smooth" });
  }

  #createPicture(): SVGSVGElement {
    const { width, height } = sizeOf(this.#graph);
    const edges = this.#graph.edges.map((edge) =>
      svg("path", { class: `edge ${edge.kind}`, d: pathOf(edge, this.#graph) }),
    );
    const arrow = svg(
      "marker",
      { id: "arrow", viewBox: "0 0 8 8", refX: 6.5, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" },
      svg("path", { d: "M0 .5 8 4 0 7.500z" }),
    );
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}` }, svg("defs", {}, arrow), ...edges, ...this.#nodes);
    picture.style.width = `${width / UNIT}rem`;
    picture.style.height = `${height / UNIT}rem`;
    return picture;
  }

  #createNode(node: GraphNode): SVGGElement {
    const { activity, turn } = node;
    const place = this.#world.locations[activity.location]!.name;
    const { x, y } = cornerOf(node);
    const made = svg(
      "g",
      { class: "node", transform: `translate(${x} ${y})`, tabindex: 0, role: "button", "data-agent": activity.agent },
      svg("title", {}, tellNode(node, place)),
      svg("rect", { width: NODE.width, height: NODE.height, rx: 7 }),
      svg("text", { class: "what", x: 9, y: 16 }, activity.action),
      svg("text", { class: "id", x: NODE.width - 8, y: 15 }, `${activity.agent}_${turn}`),
      svg("text", { class: "where", x: 9, y: 30 }, shortened(place, LONGEST_NAME)),
    );
    made.style.setProperty("--colour", SEEN_COLOURS[activity.action]);
    made.addEventListener("click", () => this.#choose(node));
    made.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      event.stopPropagation();
      this.#choose(node);
    });
    return made;
  }

  #createRowName(id: number, row: number): HTMLElement {
    const made = button({
      class: "row-name",
      text: `Person ${id}`,
      click: () => this.#actions.focus({ kind: "person", id }),
    });
    made.style.top = `${(cornerOf({ column: 0, row }).y + NODE.height / 2) / UNIT}rem`;
    return made;
  }

  #choose({ activity }: GraphNode): void {
    const moment = [activity.start, activity.arrive, activity.leave].find((time) => !Number.isNaN(time));
    this.#actions.focus({ kind: "person", id: activity.agent });
    if (moment !== undefined) this.#actions.seek(moment);
  }
}

function createHeading(group: number, graph: GroupGraph, actions: PanelActions): HTMLElement {
  const n = (kind: "sequence" | "share"): number => graph.edges.filter((edge) => edge.kind === kind).length;
  return el(
    "header",
    {},
    el("h2", { text: `Crowd scenario graph of group ${group}` }),
    el("p", { class: "key" }, counted(graph.nodes.length, "node", "nodes")),
    el(
      "p",
      { class: "key" },
      el("i", { class: "line sequence" }),
      counted(n("sequence"), "sequence edge", "sequence edges"),
    ),
    el("p", { class: "key" }, el("i", { class: "line share" }), counted(n("share"), "share edge", "share edges")),
    button(
      { class: "quiet close", label: "Close the graph", title: "Close (G)", click: () => actions.toggle("graph") },
      icon("close"),
    ),
  );
}

/** `walk` and `wait` before it, `do` while it is done, `past` after; `future` while something else comes first. */
function stateOf({ activity }: GraphNode, time: number): string {
  if (!(activity.leave <= time)) return "future";
  const phase = phaseAt(activity, time);
  return phase === "idle" ? "past" : phase;
}

function tellNode({ activity, turn }: GraphNode, place: string): string {
  const { agent, action, partners, start, end, status } = activity;
  const company = partners.length > 0 ? ` with ${partners.map((p) => `Person ${p}`).join(", ")}` : "";
  const times = Number.isNaN(start) ? "not begun" : `${clock(start)} – ${clock(end)}`;
  const outcome = status === null || status === "done" ? "" : ` (${status})`;
  return `${agent}_${turn}: ${action} at ${place}${company}, ${times}${outcome}`;
}
