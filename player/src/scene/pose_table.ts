/** All clips as one table for the graphics card: a row for every frame of a clip, two texels for every joint. */

import { CLIP_NAMES, CLIPS, type ClipName } from "./poses";
import { JOINTS, solve } from "./skeleton";

export const TEXELS_PER_JOINT = 2;

export interface PoseTable {
  readonly width: number;
  readonly height: number;
  /** Rotation (x, y, z, w), then place and size, by joint; row-major. */
  readonly texels: Float32Array<ArrayBuffer>;
  /** The first row of each clip. */
  readonly firstRow: Readonly<Record<ClipName, number>>;
}

/** Every clip, sampled. */
export function buildPoseTable(): PoseTable {
  const width = JOINTS.length * TEXELS_PER_JOINT;
  const height = CLIP_NAMES.reduce((sum, name) => sum + CLIPS[name].frames, 0);
  const texels = new Float32Array(4 * width * height);
  const firstRow = {} as Record<ClipName, number>;
  let row = 0;
  for (const name of CLIP_NAMES) {
    firstRow[name] = row;
    const clip = CLIPS[name];
    for (let frame = 0; frame < clip.frames; frame += 1) {
      writeRow(texels.subarray(4 * width * row, 4 * width * (row + 1)), solve(clip.at(frame / clip.frames)));
      row += 1;
    }
  }
  return { width, height, texels, firstRow };
}

function writeRow(row: Float32Array, solved: ReturnType<typeof solve>): void {
  JOINTS.forEach((joint, j) => {
    const { at, turn, size } = solved[joint];
    row.set(turn, 8 * j);
    row.set([...at, size], 8 * j + 4);
  });
}
