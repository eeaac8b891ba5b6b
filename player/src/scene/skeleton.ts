/**
 * The body's joints, and poses solved to where each joint is.
 *
 * The figure stands at the origin and looks along +x, left is +y, up is +z; it is 1.75 m tall. In the bind pose it
 * stands upright with its arms straight down, and every limb hangs along -z from its joint.
 */

import { add, cross, euler, frameOf, NO_TURN, rotate, scaled, sub, turned, unit, length, dot } from "./vector";
import type { Quat, Vec3 } from "./vector";

export const JOINTS = [
  "hips", "chest", "head",
  "upperArmL", "foreArmL", "upperArmR", "foreArmR",
  "thighL", "shinL", "footL", "thighR", "shinR", "footR",
  "book", "phone", "box", "stool",
] as const;
export type Joint = (typeof JOINTS)[number];
export type Prop = "book" | "phone" | "box" | "stool";

export const ANKLE_Z = 0.085;
export const SEAT_Z = 0.45;
/** From the seat up to the hip joint of who sits on it. */
export const HIP_OVER_SEAT = 0.088;
export const UPPER_ARM = 0.28;
export const FORE_ARM = 0.25;
const THIGH = 0.42;
const SHIN = 0.405;

export const BIND: Readonly<Record<Joint, Vec3>> = {
  hips: [0, 0, 0.93],
  chest: [0, 0, 1.06],
  head: [-0.005, 0, 1.475],
  upperArmL: [0, 0.182, 1.395],
  foreArmL: [0, 0.182, 1.395 - UPPER_ARM],
  upperArmR: [0, -0.182, 1.395],
  foreArmR: [0, -0.182, 1.395 - UPPER_ARM],
  thighL: [0, 0.088, 0.91],
  shinL: [0, 0.088, 0.49],
  footL: [0, 0.088, ANKLE_Z],
  thighR: [0, -0.088, 0.91],
  shinR: [0, -0.088, 0.49],
  footR: [0, -0.088, ANKLE_Z],
  book: [0, 0, 0],
  phone: [0, 0, 0],
  box: [0, 0, 0],
  stool: [0, 0, 0],
};

/** Where a hand is, and which way the elbow points. */
export interface Hand {
  /** The wrist, in the bind pose's coordinates of the chest: it goes along when the chest moves. */
  readonly at: Vec3;
  readonly elbow: Vec3;
}

export interface Foot {
  /** The ankle. */
  readonly at: Vec3;
  /** Toes down, radians. */
  readonly pitch: number;
  /** Toes outward, radians. */
  readonly out: number;
}

export interface Held {
  /** In the bind pose's coordinates of what it goes along with. */
  readonly at: Vec3;
  readonly turn: Quat;
  readonly by: "chest" | "foreArmR" | "ground";
}

export interface Pose {
  /** How far the hips are from where they are in the bind pose. */
  readonly hips: Vec3;
  readonly hipsTurn: Quat;
  /** The chest as against the hips, the head as against the chest. */
  readonly chest: Quat;
  readonly head: Quat;
  /** Left, right. */
  readonly hands: readonly [Hand, Hand];
  readonly feet: readonly [Foot, Foot];
  /** Which way the knees point. */
  readonly knees: readonly [Vec3, Vec3];
  readonly props: Readonly<Partial<Record<Prop, Held>>>;
}

/** Where a joint is, how it is turned, and how large what hangs on it is (0: not there). */
export interface Placed {
  readonly at: Vec3;
  readonly turn: Quat;
  readonly size: number;
}
export type Solved = Readonly<Record<Joint, Placed>>;

/** Where every joint is in a pose. Hands and feet out of reach are reached for as far as the limb goes. */
export function solve(pose: Pose): Solved {
  const hips: Placed = { at: add(BIND.hips, pose.hips), turn: pose.hipsTurn, size: 1 };
  const chest = joined(hips, "hips", "chest", pose.chest);
  const head = joined(chest, "chest", "head", pose.head);
  const [upperArmL, foreArmL] = arm(chest, "upperArmL", pose.hands[0]);
  const [upperArmR, foreArmR] = arm(chest, "upperArmR", pose.hands[1]);
  const [thighL, shinL, footL] = leg(hips, "thighL", pose.feet[0], pose.knees[0], 1);
  const [thighR, shinR, footR] = leg(hips, "thighR", pose.feet[1], pose.knees[1], -1);
  const carriers = { chest, foreArmR, ground: { at: [0, 0, 0], turn: NO_TURN, size: 1 } } as const;
  const held = (prop: Prop): Placed => {
    const it = pose.props[prop];
    if (it === undefined) return { at: carried(chest, BIND.chest, RESTING[prop]), turn: NO_TURN, size: 0 };
    const by: Placed = carriers[it.by];
    const bind: Vec3 = it.by === "ground" ? [0, 0, 0] : BIND[it.by];
    return { at: carried(by, bind, it.at), turn: turned(by.turn, it.turn), size: 1 };
  };
  return {
    hips, chest, head, upperArmL, foreArmL, upperArmR, foreArmR, thighL, shinL, footL, thighR, shinR, footR,
    book: held("book"), phone: held("phone"), box: held("box"), stool: held("stool"),
  };
}

/** Where a thing is while nobody holds it: small, before the chest, so that it comes out of the hands. */
const RESTING: Readonly<Record<Prop, Vec3>> = {
  book: [0.25, 0, 1.15], phone: [0.05, -0.2, 1.0], box: [0.3, 0, 1.05], stool: [-0.1, 0, 0.2],
};

/** Where a point of the bind pose is once its joint has moved. */
function carried(joint: Placed, bind: Vec3, point: Vec3): Vec3 {
  return add(joint.at, rotate(joint.turn, sub(point, bind)));
}

function joined(parent: Placed, parentName: Joint, name: Joint, turn: Quat): Placed {
  return { at: carried(parent, BIND[parentName], BIND[name]), turn: turned(parent.turn, turn), size: 1 };
}

function arm(chest: Placed, shoulder: "upperArmL" | "upperArmR", hand: Hand): [Placed, Placed] {
  const from = carried(chest, BIND.chest, BIND[shoulder]);
  const to = carried(chest, BIND.chest, hand.at);
  const pole = rotate(chest.turn, hand.elbow);
  const elbow = bent(from, to, pole, UPPER_ARM, FORE_ARM);
  // The back of the elbow looks to the pole: -x of the limb.
  const back = scaled(pole, -1);
  return [limb(from, elbow, back), limb(elbow, beyond(elbow, to, FORE_ARM), back)];
}

function leg(hips: Placed, hip: "thighL" | "thighR", foot: Foot, pole: Vec3, side: number): [Placed, Placed, Placed] {
  const from = carried(hips, BIND.hips, BIND[hip]);
  const knee = bent(from, foot.at, pole, THIGH, SHIN);
  const ankle = beyond(knee, foot.at, SHIN);
  const turn = euler(side * foot.out, foot.pitch, 0);
  return [limb(from, knee, pole), limb(knee, ankle, pole), { at: ankle, turn, size: 1 }];
}

/** The middle joint of a limb of two bones from one point towards another, bent towards the pole. */
function bent(from: Vec3, to: Vec3, pole: Vec3, upper: number, lower: number): Vec3 {
  const way = sub(to, from);
  const reach = Math.min(Math.max(length(way), 0.05), (upper + lower) * 0.9995);
  const along = unit(way, [0, 0, -1]);
  const aside = unit(sub(pole, scaled(along, dot(pole, along))), unit(cross(along, [0, 1, 0])));
  const near = (upper * upper - lower * lower + reach * reach) / (2 * reach);
  const off = Math.sqrt(Math.max(upper * upper - near * near, 0));
  return add(from, add(scaled(along, near), scaled(aside, off)));
}

const beyond = (from: Vec3, towards: Vec3, far: number): Vec3 =>
  add(from, scaled(unit(sub(towards, from), [0, 0, -1]), far));

/** A limb that hangs from one point to another, its front towards a direction. */
function limb(from: Vec3, to: Vec3, front: Vec3): Placed {
  return { at: from, turn: frameOf(front, sub(from, to)), size: 1 };
}
