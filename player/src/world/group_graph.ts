/**
 * The crowd scenario graph of a group, out of its activities (Gen-C, Graph-Based Representation): a node for each
 * activity that the graph asked for, sequence edges along a person, share edges between partners.
 */

import type { Activity, World } from "./world";

export interface GraphNode {
  readonly activity: Activity;
  /** Row: the place of the person among the members. */
  readonly row: number;
  /** Column: partners share it, and it grows along every person. */
  readonly column: number;
  /** The person's how-manieth node, from 0: the `t` of the paper's `i_t`. */
  readonly turn: number;
}

export interface GraphEdge {
  readonly kind: "sequence" | "share";
  /** Indices into `nodes`. */
  readonly from: number;
  readonly to: number;
}

export interface GroupGraph {
  readonly members: readonly number[];
  readonly nodes: readonly GraphNode[];
  readonly edges: readonly GraphEdge[];
  readonly nColumns: number;
}

/** The graph of a group. Activities that only the plan needed (coming, leaving) have no node. */
export function groupGraph(world: World, group: number): GroupGraph {
  const members = world.groups[group]?.members ?? [];
  const rows = members.map((agent) => world.people[agent]!.activities.filter((activity) => !activity.implied));
  const columns = layer(rows);
  const nodes = rows.flatMap((own, row) =>
    own.map((activity, turn) => ({ activity, row, turn, column: columns.get(activity.occasion)! })),
  );
  const nColumns = nodes.reduce((most, node) => Math.max(most, node.column + 1), 0);
  return { members, nodes, edges: [...sequences(nodes), ...shares(nodes)], nColumns };
}

/**
 * The column of each occasion: one more than the last column of anybody who takes part, so that every edge along a
 * person runs to the right and partners stand above each other.
 */
function layer(rows: readonly (readonly Activity[])[]): Map<number, number> {
  const done = rows.map(() => 0);
  const next = rows.map(() => 0);
  const columns = new Map<number, number>();
  for (;;) {
    const open = rows.map((own, row) => own[done[row]!]).filter((activity) => activity !== undefined);
    if (open.length === 0) return columns;
    const occasion = firstReady(open, rows).occasion;
    const taking = rows.flatMap((own, row) => (own[done[row]!]?.occasion === occasion ? [row] : []));
    const column = Math.max(columns.get(occasion) ?? 0, ...taking.map((row) => next[row]!));
    columns.set(occasion, column);
    for (const row of taking) {
      done[row]! += 1;
      next[row] = column + 1;
    }
  }
}

/** An occasion that all its people have come to; in an odd file, where they wait for each other, the earliest. */
function firstReady(open: readonly Activity[], rows: readonly (readonly Activity[])[]): Activity {
  const inOrder = [...open].sort((a, b) => a.planStart - b.planStart);
  const isReady = (activity: Activity): boolean => {
    const due = rows.filter((own) => own.some((other) => other.occasion === activity.occasion)).length;
    return open.filter((other) => other.occasion === activity.occasion).length === due;
  };
  return inOrder.find(isReady) ?? inOrder[0]!;
}

function sequences(nodes: readonly GraphNode[]): GraphEdge[] {
  return nodes.flatMap((node, i) =>
    nodes[i + 1]?.row === node.row ? [{ kind: "sequence" as const, from: i, to: i + 1 }] : [],
  );
}

function shares(nodes: readonly GraphNode[]): GraphEdge[] {
  const edges: GraphEdge[] = [];
  nodes.forEach((node, i) => {
    for (let j = i + 1; j < nodes.length; j += 1) {
      const other = nodes[j]!;
      if (other.row !== node.row && other.activity.occasion === node.activity.occasion) {
        edges.push({ kind: "share", from: i, to: j });
      }
    }
  });
  return edges;
}
