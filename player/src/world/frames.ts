/** Frames out of the packed arrays of a world file (docs/formats.md, "Frames"). */

import { parseNpy, uint16, type NpyArray } from "./npy";
import type { Frames } from "./world";

export interface FrameHead {
  readonly nFrames: number;
  readonly nAgents: number;
  readonly dt: number;
  readonly origin: readonly [number, number];
  readonly quantum: number;
}

export interface PackedFrames {
  readonly positions: Uint8Array;
  readonly headings: Uint8Array;
  readonly present: Uint8Array;
}

/** Positions in metres and headings in radians; throws where an array has another shape than the head says. */
export function unpackFrames(head: FrameHead, packed: PackedFrames): Frames {
  const { nFrames, nAgents, dt } = head;
  const positions = shaped(packed.positions, "positions.npy", [nFrames, nAgents, 2]);
  const headings = shaped(packed.headings, "headings.npy", [nFrames, nAgents]);
  const present = shaped(packed.present, "present.npy", [nFrames, nAgents]);
  return {
    nFrames,
    nAgents,
    dt,
    positions: metres(summed(uint16(positions), 2 * nAgents), head),
    headings: Float32Array.from(new Int16Array(summed(uint16(headings), nAgents).buffer), (d) => (d * Math.PI) / 32768),
    present: present.bytes.slice(),
  };
}

function shaped(file: Uint8Array, name: string, shape: readonly number[]): NpyArray {
  const array = parseNpy(file);
  if (array.shape.join() !== shape.join()) {
    throw new Error(`${name} is of shape ${array.shape.join(" x ")}, not ${shape.join(" x ")}`);
  }
  return array;
}

/** The running sum over frames, in place, modulo 65,536. */
function summed(steps: Uint16Array, perFrame: number): Uint16Array<ArrayBuffer> {
  for (let i = perFrame; i < steps.length; i += 1) steps[i] = steps[i]! + steps[i - perFrame]!;
  return steps as Uint16Array<ArrayBuffer>;
}

function metres(cells: Uint16Array, head: FrameHead): Float32Array {
  const values = new Float32Array(cells.length);
  for (let i = 0; i < cells.length; i += 1) values[i] = head.origin[i & 1]! + cells[i]! * head.quantum;
  return values;
}
