/** Where people are between frames, how far they have walked, and when they are in sight. */

import type { Frames } from "../world/world";

/** Less than this from one frame to the next is standing still. */
export const STILL_M = 0.002;
const FADE_S = 0.3;
/** Half the time over which a turn on the spot is spread. */
const TURN_S = 0.35;

export interface Track {
  readonly frames: Frames;
  /** Metres walked up to each frame, frame-major. */
  readonly walked: Float32Array;
  /** Headings without jumps at half a turn, and with turns on the spot spread over a moment; frame-major. */
  readonly headings: Float32Array;
  /** By person, the times between which they are in sight: from, to, from, to, ... */
  readonly sights: readonly Float64Array[];
}

/** Where somebody is at a moment. */
export interface Spot {
  x: number;
  y: number;
  heading: number;
  walked: number;
  /** 0 out of sight, 1 in sight, between while coming and going. */
  fade: number;
}

export const newSpot = (): Spot => ({ x: 0, y: 0, heading: 0, walked: 0, fade: 0 });

export function buildTrack(frames: Frames): Track {
  const sights = Array.from({ length: frames.nAgents }, (_, agent) => sightsOf(frames, agent));
  return { frames, walked: distances(frames), headings: steadyHeadings(frames), sights };
}

/** Writes where a person is at a time into `spot`. */
export function sample(track: Track, agent: number, time: number, spot: Spot): void {
  const { nFrames, nAgents, dt, positions } = track.frames;
  const at = Math.min(Math.max(time / dt, 0), nFrames - 1);
  const frame = Math.min(Math.floor(at), Math.max(nFrames - 2, 0));
  const share = at - frame;
  const here = frame * nAgents + agent;
  const next = nFrames > 1 ? here + nAgents : here;
  spot.fade = fadeAt(track.sights[agent]!, time);
  const x = positions[2 * here]!;
  const y = positions[2 * here + 1]!;
  const dx = positions[2 * next]! - x;
  const dy = positions[2 * next + 1]! - y;
  const goes = isSeen(track.frames, here) && isSeen(track.frames, next) && dx * dx + dy * dy > STILL_M * STILL_M;
  const on = goes ? share : isSeen(track.frames, here) ? 0 : 1;
  spot.x = x + dx * on;
  spot.y = y + dy * on;
  spot.heading = track.headings[here]! + (track.headings[next]! - track.headings[here]!) * share;
  spot.walked = track.walked[here]! + (track.walked[next]! - track.walked[here]!) * share;
}

const isSeen = (frames: Frames, entry: number): boolean => frames.present[entry] === 1;

/** An angle brought into (-pi, pi]. */
export function wrapped(angle: number): number {
  return angle - 2 * Math.PI * Math.ceil((angle - Math.PI) / (2 * Math.PI));
}

function distances(frames: Frames): Float32Array {
  const { nFrames, nAgents, positions, present } = frames;
  const walked = new Float32Array(nFrames * nAgents);
  for (let i = nAgents; i < walked.length; i += 1) {
    const before = i - nAgents;
    const dx = positions[2 * i]! - positions[2 * before]!;
    const dy = positions[2 * i + 1]! - positions[2 * before + 1]!;
    const square = dx * dx + dy * dy;
    const counts = square > STILL_M * STILL_M && present[i] === 1 && present[before] === 1;
    walked[i] = walked[before]! + (counts ? Math.sqrt(square) : 0);
  }
  return walked;
}

/** The mean over a moment round each frame. */
function steadyHeadings(frames: Frames): Float32Array {
  const { nFrames, nAgents, dt } = frames;
  const whole = unwound(frames);
  const steady = new Float32Array(whole.length);
  const reach = Math.max(1, Math.round(TURN_S / dt));
  const row = (frame: number): number => Math.min(Math.max(frame, 0), nFrames - 1) * nAgents;
  const sums = new Float64Array(nAgents);
  const change = (frame: number, by: number): void => {
    const from = row(frame);
    for (let agent = 0; agent < nAgents; agent += 1) sums[agent]! += by * whole[from + agent]!;
  };
  for (let k = -reach; k < reach; k += 1) change(k, 1);
  for (let frame = 0; frame < nFrames; frame += 1) {
    change(frame + reach, 1);
    for (let agent = 0; agent < nAgents; agent += 1) steady[frame * nAgents + agent] = sums[agent]! / (2 * reach + 1);
    change(frame - reach, -1);
  }
  return steady;
}

/** Headings, each within half a turn of the one before. */
function unwound({ headings, nAgents }: Frames): Float32Array {
  const whole = headings.slice();
  for (let i = nAgents; i < whole.length; i += 1) {
    const turn = headings[i]! - headings[i - nAgents]!;
    whole[i] = whole[i - nAgents]! + (Math.abs(turn) <= Math.PI ? turn : wrapped(turn));
  }
  return whole;
}

function sightsOf(frames: Frames, agent: number): Float64Array {
  const { nFrames, nAgents, dt, present } = frames;
  const times: number[] = [];
  let seen = false;
  for (let frame = 0; frame < nFrames; frame += 1) {
    if ((present[frame * nAgents + agent] === 1) === seen) continue;
    seen = !seen;
    times.push(seen && frame === 0 ? -Infinity : frame * dt);
  }
  if (seen) times.push(Infinity);
  return Float64Array.from(times);
}

/** How far somebody has come into sight. */
export function fadeAt(sights: Float64Array, time: number): number {
  let low = 0;
  let high = sights.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sights[middle]! <= time) low = middle + 1;
    else high = middle;
  }
  if (low % 2 === 0) return 0;
  return Math.min((time - sights[low - 1]!) / FADE_S, (sights[low]! - time) / FADE_S, 1);
}
