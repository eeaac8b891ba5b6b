/** Which labels are shown, and where: nearer and more important ones first, none over another. */

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Candidate {
  readonly label: number;
  /** Smaller goes first. */
  readonly rank: number;
  readonly box: Box;
}

const GAP_PX = 3;

/** The labels that have room, by rank. */
export function placeLabels(candidates: readonly Candidate[]): number[] {
  const kept: Candidate[] = [];
  for (const candidate of [...candidates].sort((a, b) => a.rank - b.rank || a.label - b.label)) {
    if (!kept.some((other) => overlap(candidate.box, other.box))) kept.push(candidate);
  }
  return kept.map((candidate) => candidate.label);
}

function overlap(a: Box, b: Box): boolean {
  const apart = (x: number, width: number, other: number): boolean => x + width + GAP_PX <= other;
  const aside = apart(a.x, a.width, b.x) || apart(b.x, b.width, a.x);
  return !aside && !apart(a.y, a.height, b.y) && !apart(b.y, b.height, a.y);
}
