import { describe, expect, test } from "vitest";
import { groupGraph, type GraphEdge, type GroupGraph } from "../src/world/group_graph";
import { readWorld } from "../src/world/read";
import type { Activity, World } from "../src/world/world";
import { NODE, cornerOf, pathOf, shortened, sizeOf } from "../src/ui/graph_layout";
import { activity, person, SMALL } from "./fixture";

const world = readWorld(SMALL);

function count(graph: GroupGraph, kind: GraphEdge["kind"]): number {
  return graph.edges.filter((edge) => edge.kind === kind).length;
}

/** A world of one group with these activities: rows of occasions. */
function grouped(rows: readonly (readonly Partial<Activity>[])[]): World {
  const people = rows.map((row, id) =>
    person(
      id,
      row.map((change, step) => activity({ agent: id, step, planStart: step, ...change })),
    ),
  );
  return { ...world, people, groups: [{ id: 0, caption: "", members: people.map(({ id }) => id) }] };
}

describe("groupGraph", () => {
  test.each([
    [0, 11, 9, 2],
    [1, 18, 16, 6],
    [2, 4, 3, 0],
  ])("group %d has its nodes and edges", (group, nodes, sequence, share) => {
    const graph = groupGraph(world, group);
    expect([graph.nodes.length, count(graph, "sequence"), count(graph, "share")]).toEqual([nodes, sequence, share]);
  });

  test("partners share a column, and every person goes to the right", () => {
    for (const { id } of world.groups) {
      const { nodes, edges } = groupGraph(world, id);
      for (const { kind, from, to } of edges) {
        const [a, b] = [nodes[from]!, nodes[to]!];
        if (kind === "share") expect([b.column, b.activity.occasion]).toEqual([a.column, a.activity.occasion]);
        else expect([b.row, b.turn, b.column > a.column]).toEqual([a.row, a.turn + 1, true]);
      }
    }
  });

  test("who has more to do before holds the column back", () => {
    const graph = groupGraph(
      grouped([
        [{ occasion: 1 }, { occasion: 5 }],
        [{ occasion: 2 }, { occasion: 3 }, { occasion: 5 }],
      ]),
      0,
    );
    expect(graph.nodes.map((node) => node.column)).toEqual([0, 2, 0, 1, 2]);
    expect(graph.nColumns).toBe(3);
  });

  test("three together have three share edges; what the plan alone needed has no node", () => {
    const row = [{ occasion: 1, implied: true }, { occasion: 2 }];
    const graph = groupGraph(grouped([row, row, row]), 0);
    expect([graph.nodes.length, count(graph, "share"), count(graph, "sequence")]).toEqual([3, 3, 0]);
  });

  test("an odd file, in which two wait for each other, still gets a graph", () => {
    const graph = groupGraph(
      grouped([
        [{ occasion: 1 }, { occasion: 2 }],
        [{ occasion: 2 }, { occasion: 1 }],
      ]),
      0,
    );
    expect(graph.nodes.length).toBe(4);
  });

  test("a group that is not there has an empty graph", () => {
    expect(groupGraph(world, 99)).toMatchObject({ members: [], nodes: [], edges: [], nColumns: 0 });
  });
});

describe("the drawing", () => {
  const graph = groupGraph(world, 1);

  test("holds every node, and none lies on another", () => {
    const { width, height } = sizeOf(graph);
    const corners = graph.nodes.map(cornerOf);
    expect(new Set(corners.map(({ x, y }) => `${x} ${y}`)).size).toBe(graph.nodes.length);
    for (const { x, y } of corners) {
      expect(x >= 0 && x + NODE.width <= width && y >= 0 && y + NODE.height <= height).toBe(true);
    }
  });

  test("sequence edges run along the row, share edges down, or around whom they would cross", () => {
    const row = [{ occasion: 1 }];
    const three = groupGraph(grouped([row, row, row]), 0);
    const share = three.edges.filter((edge) => edge.kind === "share").map((edge) => pathOf(edge, three));
    expect(share.map((path) => path.includes("C"))).toEqual([false, true, false]);
    const sequence = graph.edges.find((edge) => edge.kind === "sequence")!;
    expect(pathOf(sequence, graph)).toMatch(/^M\S+ \S+H\S+$/);
  });

  test("long names are cut", () => {
    expect(shortened("general's statue", 9)).toBe("general'…");
    expect(shortened("lawn", 9)).toBe("lawn");
  });
});
