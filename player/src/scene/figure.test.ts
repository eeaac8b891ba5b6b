import { describe, expect, it } from "vitest";
import { ACTIONS } from "../world/world";
import { buildFigure } from "./figure";
import { footAt, smooth, walking } from "./gait";
import { PAINTS, PARTS } from "./loft";
import { buildPoseTable, TEXELS_PER_JOINT } from "./pose_table";
import { CLIP_NAMES, CLIPS } from "./poses";
import { STANDING } from "./postures";
import { BIND, FORE_ARM, HIP_OVER_SEAT, JOINTS, SEAT_Z, solve, UPPER_ARM, type Joint } from "./skeleton";
import { length, rotate, sub } from "./vector";

const phases = Array.from({ length: 48 }, (_, i) => i / 48);
/** The ball of the foot and the heel, as against the ankle in the bind pose. */
const SOLE = [[0.12, 0, -0.085], [-0.055, 0, -0.085]] as const;

function lowestSole(solved: ReturnType<typeof solve>, foot: Joint): number {
  return Math.min(...SOLE.map((point) => solved[foot].at[2] + rotate(solved[foot].turn, point)[2]));
}

describe("poses", () => {
  it("has one for every action", () => {
    for (const action of ACTIONS) expect(CLIPS[STANDING[action]]).toBeDefined();
  });

  it.each(CLIP_NAMES)("%s keeps bones at their length, and comes back to where it began", (name) => {
    const clip = CLIPS[name];
    for (const phase of phases) {
      const s = solve(clip.at(phase));
      for (const side of ["L", "R"] as const) {
        expect(length(sub(s[`foreArm${side}`].at, s[`upperArm${side}`].at))).toBeCloseTo(UPPER_ARM, 6);
        expect(length(sub(s[`shin${side}`].at, s[`thigh${side}`].at))).toBeCloseTo(0.42, 6);
        expect(length(sub(s[`foot${side}`].at, s[`shin${side}`].at))).toBeCloseTo(0.405, 6);
      }
      for (const joint of JOINTS) expect(
        s[joint].at.every(Number.isFinite) && Math.hypot(...s[joint].turn)
      ).toBeCloseTo(1, 6);
    }
    const [first, last] = [solve(clip.at(0)), solve(clip.at(1))];
    for (const joint of JOINTS) expect(length(sub(first[joint].at, last[joint].at))).toBeLessThan(1e-6);
  });

  it.each(CLIP_NAMES)("%s has no foot under the floor, and one on it", (name) => {
    for (const phase of phases) {
      const s = solve(CLIPS[name].at(phase));
      const lowest = Math.min(lowestSole(s, "footL"), lowestSole(s, "footR"));
      expect(lowest).toBeGreaterThan(-0.012);
      expect(lowest).toBeLessThan(0.02);
    }
  });

  it("sits on the seat with level thighs", () => {
    for (const name of CLIP_NAMES.filter((clip) => clip.startsWith("sit"))) {
      const s = solve(CLIPS[name].at(0.3));
      expect(s.thighL.at[2]).toBeCloseTo(SEAT_Z + HIP_OVER_SEAT, 2);
      expect(Math.abs(s.thighL.at[2] - s.shinL.at[2])).toBeLessThan(0.12);
      expect(s.stool.size).toBe(1);
    }
    expect(solve(CLIPS.stand.at(0)).stool.size).toBe(0);
  });

  it("shows the action by the hands", () => {
    const hand = (name: keyof typeof CLIPS): readonly number[] => {
      const { at, turn } = solve(CLIPS[name].at(0)).foreArmR;
      return at.map((c, i) => c + rotate(turn, [0, 0, -FORE_ARM])[i]!);
    };
    expect(hand("stand")[2]).toBeLessThan(0.95);
    expect(hand("wave")[2]).toBeGreaterThan(1.55);
    expect(length(sub([hand("phone")[0]!, hand("phone")[1]!, hand("phone")[2]!], BIND.head))).toBeLessThan(0.25);
    expect(hand("use")[0]).toBeGreaterThan(0.2);
    expect(hand("look")[0]).toBeLessThan(-0.1);
    for (
      const [clip, prop] of [
        ["read", "book"], ["sitRead", "book"], ["phone", "phone"], ["carry", "box"], ["walkCarry", "box"],
      ] as const
    ) {
      expect(solve(CLIPS[clip].at(0.2))[prop].size).toBe(1);
    }
  });
});

describe("the walk", () => {
  it.each([0.95, 1.25, 1.5])("lets no planted foot slide at a cycle of %f m", (cycle) => {
    const d = 0.01;
    for (let phase = 0.12; phase < 0.34; phase += d) {
      const moved = footAt(cycle, phase + d, 1).at[0] - footAt(cycle, phase, 1).at[0];
      expect(moved).toBeCloseTo(-cycle * d, 6);
      expect(footAt(cycle, phase, 1).at[2]).toBeCloseTo(0.085, 6);
    }
  });

  it("reaches every foothold with its legs", () => {
    for (const phase of phases) {
      const pose = walking({ cycle: 1.5 }, phase);
      const s = solve(pose);
      expect(length(sub(s.footL.at, pose.feet[0].at))).toBeLessThan(0.02);
    }
  });

  it("is the same half a cycle later, left for right", () => {
    const [a, b] = [solve(CLIPS.walk.at(0.1)), solve(CLIPS.walk.at(0.6))];
    expect(a.footL.at[0]).toBeCloseTo(b.footR.at[0], 6);
    expect(a.footL.at[1]).toBeCloseTo(-b.footR.at[1], 6);
  });

  it("changes over without a jerk", () => {
    expect([smooth(-1), smooth(0.5), smooth(2)]).toEqual([0, 0.5, 1]);
  });
});

describe("the pose table", () => {
  const table = buildPoseTable();

  it("has the rows of every clip", () => {
    expect(table.width).toBe(JOINTS.length * TEXELS_PER_JOINT);
    for (const name of CLIP_NAMES) expect(table.firstRow[name] + CLIPS[name].frames).toBeLessThanOrEqual(table.height);
    expect(table.texels.every(Number.isFinite)).toBe(true);
  });

  it("holds what was solved", () => {
    const at = 4 * (table.firstRow.sit * table.width + TEXELS_PER_JOINT * JOINTS.indexOf("head") + 1);
    solve(CLIPS.sit.at(0)).head.at.forEach((c, i) => expect(table.texels[at + i]).toBeCloseTo(c, 5));
  });
});

describe.each([0, 1, 2] as const)("the mesh of detail %i", (detail) => {
  const mesh = buildFigure(detail);
  const n = mesh.positions.length / 3;

  it("is small and sound", () => {
    expect(n).toBeLessThan([260, 840, 1700][detail]!);
    expect(Math.max(...mesh.index)).toBeLessThan(n);
    expect([mesh.normals.length, mesh.skins.length, mesh.extras.length]).toEqual([3 * n, 4 * n, 2 * n]);
    for (let v = 0; v < n; v += 1) {
      expect(Math.hypot(...mesh.normals.slice(3 * v, 3 * v + 3))).toBeCloseTo(1, 5);
      const [joint, other, share, paint] = mesh.skins.slice(4 * v, 4 * v + 4);
      expect(
        joint! < JOINTS.length && other! < JOINTS.length && share! >= 0 && share! <= 1 && paint! < PAINTS.length
      ).toBe(true);
      expect(mesh.extras[2 * v]!).toBeLessThan(PARTS.length);
    }
  });

  it("stands on the floor and is 1.75 to 1.8 m tall", () => {
    const body = Array.from({ length: n }, (_, v) => v).filter((v) => mesh.skins[4 * v]! < JOINTS.indexOf("book"));
    const heights = body.map((v) => mesh.positions[3 * v + 2]!);
    expect(Math.min(...heights)).toBeGreaterThan(-0.005);
    expect(Math.min(...heights)).toBeLessThan(0.02);
    expect(Math.max(...heights)).toBeGreaterThan(1.74);
    expect(Math.max(...heights)).toBeLessThan(1.8);
  });

  it("turns its triangles outward", () => {
    let agree = 0;
    for (let t = 0; t < mesh.index.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map(
        (k) => mesh.positions.slice(3 * mesh.index[t + k]!, 3 * mesh.index[t + k]! + 3)
      ) as [number[], number[], number[]];
      const [u, v] = [b.map((x, i) => x - a[i]!), c.map((x, i) => x - a[i]!)];
      const face = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
      const normal = mesh.normals.slice(3 * mesh.index[t]!, 3 * mesh.index[t]! + 3);
      if (face.reduce((sum, x, i) => sum + x * normal[i]!, 0) > -1e-9) agree += 1;
    }
    expect(agree / (mesh.index.length / 3)).toBeGreaterThan(0.97);
  });
});
