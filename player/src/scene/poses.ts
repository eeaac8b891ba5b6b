/** What bodies do: one cycle of poses for every posture. */

import { walking, type Gait } from "./gait";
import { handAt, hang } from "./hands";
import { ANKLE_Z, BIND, HIP_OVER_SEAT, SEAT_Z } from "./skeleton";
import type { Foot, Hand, Held, Pose } from "./skeleton";
import { euler, NO_TURN } from "./vector";
import type { Vec3 } from "./vector";

/** A posture in motion: `at` gives the pose at a phase, 0 to 1, and comes back to where it began. */
export interface Clip {
  readonly frames: number;
  /** Length of the cycle in seconds; for a walk in metres. */
  readonly cycle: number;
  readonly walks: boolean;
  readonly at: (phase: number) => Pose;
}

const TAU = 2 * Math.PI;
const sin = (phase: number, times = 1, shift = 0): number => Math.sin(TAU * (times * phase + shift));
/** Mostly zero, with one soft swell between two phases. */
const swell = (phase: number, from: number, to: number): number =>
  phase <= from || phase >= to ? 0 : Math.sin((Math.PI * (phase - from)) / (to - from)) ** 2;

interface Body {
  readonly hands: readonly [Hand, Hand];
  /** Pitch, then yaw of the head. */
  readonly head?: readonly [number, number];
  readonly chest?: readonly [number, number];
  readonly props?: Pose["props"];
  /** How far the weight goes to one side, metres. */
  readonly shift?: number;
}

function standing(phase: number, body: Body): Pose {
  const side = (body.shift ?? 0.012) * sin(phase);
  const breath = 0.012 * sin(phase, 3);
  return {
    hips: [0, side, -0.006 - Math.abs(side) * 0.25],
    hipsTurn: euler(0, 0.02, side * 1.6),
    chest: euler(body.chest?.[1] ?? 0, (body.chest?.[0] ?? 0.02) - breath, -side * 2.6),
    head: euler(body.head?.[1] ?? 0, (body.head?.[0] ?? 0) + breath, side),
    hands: body.hands,
    feet: [flat(0.01, 0.1, 1), flat(-0.015, 0.1, -1)],
    knees: [[1, 0.15, 0], [1, -0.15, 0]],
    props: body.props ?? {},
  };
}

const STOOL: Held = { at: [0, 0, 0], turn: NO_TURN, by: "ground" };
const SEATED_HIPS: Vec3 = [0, 0, SEAT_Z + HIP_OVER_SEAT - BIND.thighL[2]];

function sitting(phase: number, body: Body): Pose {
  const breath = 0.012 * sin(phase, 3);
  const side = 0.02 * sin(phase);
  return {
    hips: SEATED_HIPS,
    hipsTurn: euler(0, -0.06, 0),
    chest: euler(body.chest?.[1] ?? 0, (body.chest?.[0] ?? 0.09) - breath, -side),
    head: euler(body.head?.[1] ?? 0, (body.head?.[0] ?? 0) + breath, side),
    hands: body.hands,
    feet: [flat(0.4, 0.115, 1), flat(0.35, 0.115, -1)],
    knees: [[0.35, 0.12, 1], [0.35, -0.12, 1]],
    props: { ...body.props, stool: STOOL },
  };
}

const flat = (x: number, outward: number, side: number): Foot => ({
  at: [x, side * outward, ANKLE_Z], pitch: 0, out: 0.16,
});

const BOOK: Held = { at: [0.315, 0, 1.185], turn: euler(0, -0.65, 0), by: "chest" };
const PHONE: Held = { at: [0.014, -0.168, 0.79], turn: NO_TURN, by: "foreArmR" };
const BOX: Held = { at: [0.335, 0, 1.07], turn: NO_TURN, by: "chest" };

const relaxed = (phase: number): [Hand, Hand] => [
  hang(1, 0.02 + 0.02 * sin(phase), 0.24, 0.11),
  hang(-1, 0.02 - 0.02 * sin(phase), 0.26, 0.11),
];
const folded: [Hand, Hand] = [
  handAt(1, 0.2, -0.075, 1.2, [-0.2, 1, -0.75]),
  handAt(-1, 0.175, -0.085, 1.165, [-0.2, 1, -0.75]),
];
const behind: [Hand, Hand] = [
  handAt(1, -0.15, -0.005, 0.95, [-0.5, 1, 0]), handAt(-1, -0.165, 0.0, 0.93, [-0.5, 1, 0]),
];
const clasped: [Hand, Hand] = [
  handAt(1, 0.175, 0.082, 0.99, [-0.4, 1, -0.1]),
  handAt(-1, 0.185, 0.076, 0.985, [-0.4, 1, -0.1]),
];
const reading = (phase: number): [Hand, Hand] => [
  handAt(1, 0.235, 0.115, 1.12),
  handAt(
    -1,
    0.235 - 0.03 * swell(phase, 0.5, 0.62),
    0.115 - 0.16 * swell(phase, 0.5, 0.62),
    1.12 + 0.07 * swell(phase, 0.5, 0.62),
  ),
];
const atEar: Hand = handAt(-1, 0.075, 0.155, 1.475, [0.1, 0.75, -1]);
const carrying: [Hand, Hand] = [
  handAt(1, 0.25, 0.185, 1.02, [-0.8, 0.45, -0.3]), handAt(-1, 0.25, 0.185, 1.02, [-0.8, 0.45, -0.3]),
];
const onLap = (phase: number): [Hand, Hand] => [
  handAt(1, 0.235, 0.125, 1.045, [-0.9, 0.5, -0.3]),
  handAt(-1, 0.225 + 0.01 * sin(phase), 0.115, 1.045, [-0.9, 0.5, -0.3]),
];

/** Both hands tell something, one after the other and together. */
function telling(phase: number, lap: boolean): [Hand, Hand] {
  const left = 0.35 + 0.65 * swell(phase, 0.02, 0.42) + 0.5 * swell(phase, 0.55, 0.95);
  const right = 0.35 + 0.65 * swell(phase, 0.2, 0.6) + 0.65 * swell(phase, 0.62, 0.98);
  const low = lap ? 1.06 : 1.0;
  return [
    handAt(
      1,
      0.2 + 0.1 * left,
      0.16 + 0.07 * left + 0.03 * sin(phase, 3),
      low + 0.2 * left + 0.025 * sin(phase, 5),
      [-0.5, 0.8, -0.8],
    ),
    handAt(
      -1,
      0.2 + 0.1 * right,
      0.16 + 0.07 * right + 0.03 * sin(phase, 4),
      low + 0.2 * right + 0.025 * sin(phase, 4, 0.3),
      [-0.5, 0.8, -0.8],
    ),
  ];
}

/** At a counter, a screen, a thing: both hands before one, the right one reaching. */
function using(phase: number, height: number): [Hand, Hand] {
  const reach = swell(phase, 0.05, 0.4) + 0.7 * swell(phase, 0.5, 0.8);
  return [
    handAt(1, 0.29 + 0.04 * swell(phase, 0.6, 1), 0.13, height + 0.012 * sin(phase, 4)),
    handAt(-1, 0.28 + 0.1 * reach, 0.13 - 0.05 * reach, height + 0.1 * reach, [-0.5, 0.6, -0.7]),
  ];
}

const nod = (phase: number): number => 0.05 + 0.07 * (
  swell(phase, 0.2, 0.3) + swell(phase, 0.28, 0.38) + swell(phase, 0.7, 0.82)
);

const walk = (gait: Gait, props: Pose["props"] = {}, head?: Pose["head"]): Clip => ({
  frames: 24,
  cycle: gait.cycle,
  walks: true,
  at: (phase) => {
    const pose = walking(gait, phase);
    return { ...pose, props, head: head ?? pose.head };
  },
});

const still = (frames: number, cycle: number, at: Clip["at"]): Clip => ({ frames, cycle, walks: false, at });

const phoneHands: [Hand, Hand] = [hang(1, 0.05, 0.3, 0.1), atEar];

export const CLIPS = {
  stroll: walk({ cycle: 0.95 }),
  walk: walk({ cycle: 1.25 }),
  stride: walk({ cycle: 1.5 }),
  walkCarry: walk({ cycle: 1.15, hands: carrying, lean: -0.07 }, { box: BOX }),
  walkPhone: walk({ cycle: 1.15, hands: phoneHands }, { phone: PHONE }, euler(0.05, 0.03, 0.1)),
  stand: still(16, 11, (p) => standing(p, { hands: relaxed(p), shift: 0.022 })),
  fold: still(16, 13, (p) => standing(p, { hands: folded, chest: [-0.02, 0], shift: 0.02 })),
  clasp: still(16, 12, (p) => standing(p, { hands: clasped, shift: 0.024 })),
  look: still(
    24,
    12,
    (p) => standing(p, { hands: behind, head: [-0.16 - 0.05 * sin(p, 1, 0.2), 0.22 * sin(p)], chest: [-0.03, 0] }),
  ),
  wave: still(16, 0.95, (p) =>
    standing(
      p,
      {
        hands: [
          hang(1, 0.02, 0.25, 0.11),
          handAt(-1, 0.08, 0.41 + 0.1 * sin(p), 1.665 - 0.02 * Math.abs(sin(p)), [-0.1, 1, -0.9]),
        ],
        head: [-0.05, 0],
        shift: 0,
      },
    )),
  phone: still(
    16,
    10,
    (p) => standing(p, { hands: [clasped[0], atEar], head: [0.02, -0.05], props: { phone: PHONE }, shift: 0.024 }),
  ),
  read: still(
    24,
    12,
    (p) => standing(p, { hands: reading(p), head: [0.42, 0.04 * sin(p, 2)], props: { book: BOOK }, chest: [0.03, 0] }),
  ),
  carry: still(16, 9, (p) => standing(p, { hands: carrying, chest: [-0.06, 0], props: { box: BOX } })),
  use: still(24, 4.6, (p) => standing(p, { hands: using(p, 1.13), chest: [0.12, 0], head: [0.2, 0], shift: 0.006 })),
  talk: still(
    32,
    5.2,
    (p) => standing(
      p,
      { hands: telling(p, false), head: [0.04 * sin(p, 3), 0.1 * sin(p, 2)], chest: [0.03, 0.06 * sin(p)] },
    ),
  ),
  listen: still(24, 8, (p) => standing(p, { hands: relaxed(p), head: [nod(p), 0.03 * sin(p)], shift: 0.018 })),
  listenFold: still(24, 9, (p) => standing(p, { hands: folded, head: [nod(p), 0.03 * sin(p)], shift: 0.016 })),
  greet: still(12, 0.6, (p) =>
    standing(
      p,
      {
        hands: [hang(1, 0.02, 0.25, 0.1), handAt(-1, 0.36, 0.05, 1.11 + 0.025 * sin(p))],
        chest: [0.1, 0.1],
        head: [0.02, -0.05],
        shift: 0,
      },
    )),
  sit: still(16, 11, (p) => sitting(p, { hands: onLap(p), head: [0.04, 0.05 * sin(p)] })),
  sitRead: still(
    24,
    12,
    (p) => sitting(p, { hands: reading(p), head: [0.42, 0.04 * sin(p, 2)], props: { book: BOOK } }),
  ),
  sitPhone: still(
    16,
    10,
    (p) => sitting(p, { hands: [onLap(p)[0], atEar], head: [0.03, -0.05], props: { phone: PHONE } }),
  ),
  sitTalk: still(32, 5.2, (p) => sitting(p, { hands: telling(p, true), head: [0.04 * sin(p, 3), 0.08 * sin(p, 2)] })),
  sitListen: still(24, 8, (p) => sitting(p, { hands: onLap(p), head: [nod(p), 0.03 * sin(p)] })),
  sitUse: still(24, 4.6, (p) => sitting(p, { hands: using(p, 1.17), chest: [0.16, 0], head: [0.2, 0] })),
} as const satisfies Readonly<Record<string, Clip>>;

export type ClipName = keyof typeof CLIPS;
export const CLIP_NAMES = Object.keys(CLIPS) as ClipName[];
