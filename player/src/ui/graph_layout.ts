/** Where the nodes and edges of a crowd scenario graph are drawn. */

import type { GraphEdge, GraphNode, GroupGraph } from "../world/group_graph";

/** Lengths in units of 1/16 of the page's font size. */
export const NODE = { width: 150, height: 38 } as const;
const PITCH = { x: 192, y: 58 } as const;
const MARGIN = { x: 14, y: 12 } as const;
const BULGE = 9;
const WIDEST_BULGE = 34;

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** The upper left corner of a node. */
export function cornerOf({ column, row }: Pick<GraphNode, "column" | "row">): Point {
  return { x: MARGIN.x + column * PITCH.x, y: MARGIN.y + row * PITCH.y };
}

export function sizeOf({ members, nColumns }: GroupGraph): { readonly width: number; readonly height: number } {
  return {
    width: 2 * MARGIN.x + nColumns * PITCH.x - (PITCH.x - NODE.width),
    height: 2 * MARGIN.y + members.length * PITCH.y - (PITCH.y - NODE.height),
  };
}

/**
 * The line of an edge. Sequence edges run along the row. Share edges between neighbours in a column run straight
 * down; those that would cross another partner go around it at the right.
 */
export function pathOf(edge: GraphEdge, graph: GroupGraph): string {
  const [from, to] = [graph.nodes[edge.from]!, graph.nodes[edge.to]!];
  const [a, b] = [cornerOf(from), cornerOf(to)];
  if (edge.kind === "sequence") {
    const y = a.y + NODE.height / 2;
    return `M${a.x + NODE.width} ${y}H${b.x - 3}`;
  }
  const crossed = graph.nodes.some((node) => node.column === from.column && node.row > from.row && node.row < to.row);
  if (!crossed) return `M${a.x + NODE.width / 2} ${a.y + NODE.height}V${b.y}`;
  const x = a.x + NODE.width;
  const out = x + Math.min(BULGE * (to.row - from.row + 1), WIDEST_BULGE);
  const [y1, y2] = [a.y + NODE.height * 0.8, b.y + NODE.height * 0.2];
  return `M${x} ${y1}C${out} ${y1} ${out} ${y1 + 12} ${out} ${(y1 + y2) / 2}S${out} ${y2} ${x} ${y2}`;
}

/** A text cut to `most` letters. */
export function shortened(text: string, most: number): string {
  return text.length <= most ? text : `${text.slice(0, most - 1).trimEnd()}…`;
}
