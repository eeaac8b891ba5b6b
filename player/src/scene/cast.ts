/** Everybody at one moment: where each is drawn, in which poses, and where the head is turned. No graphics here. */

import type { World } from "../world/world";
import { chance } from "./chance";
import { smooth } from "./gait";
import type { PoseTable } from "./pose_table";
import { CLIPS, type ClipName } from "./poses";
import { buildStretches, CHANGE_S, stretchAt, type Stretch } from "./postures";
import { SEAT_Z } from "./skeleton";
import { newSpot, sample, wrapped, type Spot, type Track } from "./track";

/** Numbers by person: place, pose A, pose B, manner, as the shader reads them (crowd_shader.ts). */
export const STRIDE = 16;
export const AT = {
  x: 0,
  y: 1,
  heading: 2,
  height: 3,
  poseA: 4,
  stool: 7,
  poseB: 8,
  share: 11,
  headYaw: 12,
  lift: 13,
  presence: 14,
  dim: 15,
} as const;

const TURN_OF_TALK_S = 3.6;
const TAKING_OVER_S = 0.5;
const MOST_HEAD_TURN = 0.95;
const NECK_S = 0.6;

export class Cast {
  /** The numbers of person `a` begin at `STRIDE * a`; those out of sight have presence 0. */
  readonly values: Float32Array;
  readonly count: number;
  private readonly track: Track;
  private readonly table: PoseTable;
  private readonly stretches: readonly (readonly Stretch[])[];
  private readonly cursors: Int32Array;
  private readonly spot = newSpot();
  private readonly other = newSpot();

  constructor(world: World, track: Track, table: PoseTable, heights: readonly number[]) {
    this.count = world.people.length;
    this.track = track;
    this.table = table;
    this.stretches = buildStretches(world, track);
    this.values = new Float32Array(STRIDE * this.count);
    this.cursors = new Int32Array(this.count);
    heights.forEach((height, agent) => (this.values[STRIDE * agent + AT.height] = height));
  }

  /** Puts everybody where they are at a time; depends on nothing but the time. */
  update(time: number): void {
    for (let agent = 0; agent < this.count; agent += 1) {
      sample(this.track, agent, time, this.spot);
      this.values[STRIDE * agent + AT.presence] = this.spot.fade;
      if (this.spot.fade > 0) this.place(agent, time, this.spot);
    }
  }

  private place(agent: number, time: number, spot: Spot): void {
    const own = this.stretches[agent]!;
    const i = stretchAt(own, time, this.cursors[agent]!);
    this.cursors[agent] = i;
    const now = own[i]!;
    const before = i > 0 ? own[i - 1]! : now;
    const share = smooth((time - now.start) / CHANGE_S);
    this.seat(agent, spot, before, now, share);
    const base = STRIDE * agent;
    if (share < 1) {
      this.pose(base + AT.poseA, agent, clipOf(now, agent, time), time, spot.walked);
      this.pose(base + AT.poseB, agent, clipOf(before, agent, now.start), time, spot.walked);
      this.values[base + AT.share] = share;
    } else {
      this.talkOn(base, agent, now, time, spot.walked);
    }
    this.values[base + AT.headYaw] = this.headYaw(agent, before, now, time);
  }

  /** Who sits on a bench is drawn on it; between frames and seat the change is as long as that of the posture. */
  private seat(agent: number, spot: Spot, before: Stretch, now: Stretch, share: number): void {
    const base = STRIDE * agent;
    const { values } = this;
    const from = share < 1 ? before.seat : now.seat;
    values[base + AT.x] = mix(from?.x ?? spot.x, now.seat?.x ?? spot.x, share);
    values[base + AT.y] = mix(from?.y ?? spot.y, now.seat?.y ?? spot.y, share);
    const heading = from?.heading ?? spot.heading;
    values[base + AT.heading] = heading + wrapped((now.seat?.heading ?? spot.heading) - heading) * share;
    // On a bench of a given height people of all sizes sit alike, and nobody needs a stool.
    const onBench = mix(from === null ? 0 : 1, now.seat === null ? 0 : 1, share);
    values[base + AT.lift] = SEAT_Z * (1 - values[base + AT.height]!) * onBench;
    values[base + AT.stool] = onBench > 0 ? 0 : 1;
  }

  /** Within a conversation the one who speaks and those who listen change over softly. */
  private talkOn(base: number, agent: number, now: Stretch, time: number, walked: number): void {
    const clip = clipOf(now, agent, time);
    this.pose(base + AT.poseA, agent, clip, time, walked);
    const into = now.listening === null ? Infinity : intoTurn(now.occasion, time);
    const last = into < TAKING_OVER_S ? clipOf(now, agent, time - into - 0.01) : clip;
    this.values[base + AT.share] = last === clip ? 1 : smooth(into / TAKING_OVER_S);
    if (last !== clip) this.pose(base + AT.poseB, agent, last, time, walked);
  }

  /** Two neighbouring rows of the pose table and the share of the second. */
  private pose(at: number, agent: number, name: ClipName, time: number, walked: number): void {
    const clip = CLIPS[name];
    const cycles = clip.walks ? walked / (clip.cycle * this.values[STRIDE * agent + AT.height]!) : time / clip.cycle;
    const phase = cycles + chance(agent, 7);
    const frame = (phase - Math.floor(phase)) * clip.frames;
    const first = Math.min(Math.floor(frame), clip.frames - 1);
    const row = this.table.firstRow[name];
    this.values[at] = row + first;
    this.values[at + 1] = row + ((first + 1) % clip.frames);
    this.values[at + 2] = frame - first;
  }

  private headYaw(agent: number, before: Stretch, now: Stretch, time: number): number {
    const share = smooth((time - now.start) / NECK_S);
    const yaw = this.lookOf(agent, now, time);
    return share >= 1 || before === now ? yaw : mix(this.lookOf(agent, before, time), yaw, share);
  }

  /** Where somebody looks: at who speaks, or about. */
  private lookOf(agent: number, at: Stretch, time: number): number {
    if (at.listening === null) return LOOKS_ROUND.has(at.clip) ? lookingRound(agent, time) : 0;
    const into = intoTurn(at.occasion, time);
    const yaw = this.yawTo(agent, watched(at, agent, time), time);
    if (into >= TAKING_OVER_S) return yaw;
    const last = this.yawTo(agent, watched(at, agent, time - into - 0.01), time);
    return mix(last, yaw, smooth(into / TAKING_OVER_S));
  }

  /** How far the head turns towards somebody. */
  private yawTo(agent: number, whom: number, time: number): number {
    const base = STRIDE * agent;
    if (whom === agent) return 0.25 * Math.sin(time * 0.5 + 9 * chance(agent, 8));
    sample(this.track, whom, time, this.other);
    if (this.other.fade <= 0) return 0;
    const way = Math.atan2(this.other.y - this.values[base + AT.y]!, this.other.x - this.values[base + AT.x]!);
    const yaw = wrapped(way - this.values[base + AT.heading]!);
    // Nobody looks over their back; the turn dies away there, without a leap from one side to the other.
    const behind = Math.max(0, (Math.abs(yaw) - 2.2) / (Math.PI - 2.2));
    return Math.max(-MOST_HEAD_TURN, Math.min(MOST_HEAD_TURN, yaw)) * (1 - behind);
  }
}

const mix = (a: number, b: number, share: number): number => a + (b - a) * share;

const turnAt = (occasion: number, time: number): number => Math.floor(time / TURN_OF_TALK_S + chance(occasion, 1));

/** Seconds since the present speaker's turn began. */
function intoTurn(occasion: number, time: number): number {
  return (time / TURN_OF_TALK_S + chance(occasion, 1) - turnAt(occasion, time)) * TURN_OF_TALK_S;
}

/** Who of a conversation speaks; -1 stands for somebody who is not of the plan, such as staff. */
export function speakerAt(circle: readonly number[], occasion: number, time: number): number {
  const lot = chance(occasion + 31, turnAt(occasion, time));
  if (circle.length < 2) return lot < 0.55 ? circle[0]! : -1;
  return circle[Math.floor(lot * circle.length)]!;
}

/** Who speaks; for the first moment it stays the same, so that nobody changes posture twice at once. */
function speakerOf({ start, circle, occasion }: Stretch, time: number): number {
  return speakerAt(circle, occasion, Math.max(time, start + CHANGE_S + TAKING_OVER_S));
}

function clipOf(stretch: Stretch, agent: number, time: number): ClipName {
  if (stretch.listening === null) return stretch.clip;
  return speakerOf(stretch, time) === agent ? stretch.clip : stretch.listening;
}

/** Listeners look at the speaker, the speaker at one of them. */
function watched(stretch: Stretch, agent: number, time: number): number {
  const { circle, occasion } = stretch;
  const speaker = speakerOf(stretch, time);
  if (speaker !== agent) return speaker < 0 ? agent : speaker;
  const at = circle.indexOf(agent);
  const step = 1 + Math.floor(chance(occasion, turnAt(occasion, time)) * (circle.length - 1));
  return circle[(at + step) % circle.length]!;
}

const LOOKS_ROUND: ReadonlySet<ClipName> = new Set<ClipName>(["stand", "fold", "clasp", "sit", "walk", "stroll"]);

/** Now and then a look to the side. */
function lookingRound(agent: number, time: number): number {
  const own = 40 * chance(agent, 9);
  const mood = Math.sin(time * 0.31 + own) * Math.sin(time * 0.19 + 2 * own);
  return Math.sign(mood) * 0.75 * smooth((Math.abs(mood) - 0.3) / 0.4);
}
