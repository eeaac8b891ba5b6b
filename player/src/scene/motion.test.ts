import { describe, expect, it } from "vitest";
import { AT, Cast, speakerAt, STRIDE } from "./cast";
import { buildPoseTable } from "./pose_table";
import { CLIPS } from "./poses";
import { buildStretches, movesOf, seatOn, stretchAt } from "./postures";
import { activity, framesOf, place, worldOf } from "./samples";
import { buildTrack, fadeAt, newSpot, sample, wrapped } from "./track";

const table = buildPoseTable();
const still = (
  x: number,
  y: number,
  heading = 0,
  n = 60,
): [number, number, number][] => Array.from({ length: n }, () => [x, y, heading]);
const walk = (speed: number, n = 60): [number, number, number][] => Array.from(
  { length: n },
  (_, f) => [speed * f * 0.2, 0, 0],
);

describe("between frames", () => {
  it("goes straight and evenly", () => {
    const track = buildTrack(framesOf([walk(1.5)]));
    const spot = newSpot();
    sample(track, 0, 1.3, spot);
    expect(spot.x).toBeCloseTo(1.95, 5);
    expect(spot.walked).toBeCloseTo(1.95, 5);
  });

  it("stands still where a step is under two millimetres", () => {
    const track = buildTrack(framesOf([[[0, 0, 0], [0.0015, 0, 0], [0, 0, 0]]]));
    const spot = newSpot();
    sample(track, 0, 0.1, spot);
    expect([spot.x, spot.walked]).toEqual([0, 0]);
  });

  it("turns the short way round", () => {
    const path = [...still(0, 0, 3.1, 5), ...still(0, 0, -3.1, 5)] as [number, number, number][];
    const track = buildTrack(framesOf([path]));
    const spot = newSpot();
    for (let time = 0; time < 1.8; time += 0.05) {
      sample(track, 0, time, spot);
      expect(Math.abs(wrapped(spot.heading - Math.PI))).toBeLessThan(0.05);
    }
  });

  it("keeps a steady heading to the first and the last frame", () => {
    const track = buildTrack(framesOf([still(0, 0, 1.25)]));
    for (const heading of track.headings) expect(heading).toBeCloseTo(1.25, 5);
  });

  it("comes into sight and goes softly, but is there from the beginning", () => {
    const track = buildTrack(
      framesOf([[null, [1, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0], null, null], still(0, 0, 0, 7)])
    );
    expect(track.sights[0]).toEqual(Float64Array.of(0.2, 1));
    expect([0.1, 0.35, 0.6, 0.85, 1.2].map((time) => fadeAt(track.sights[0]!, time))).toEqual([
      0, expect.closeTo(0.5, 5), 1, expect.closeTo(0.5, 5), 0,
    ]);
    expect(fadeAt(track.sights[1]!, 0)).toBe(1);
  });

  it("does not fly from where somebody vanished to where they appear", () => {
    const track = buildTrack(framesOf([[[0, 0, 0], null, [9, 0, 0], [9, 0, 0]]]));
    const spot = newSpot();
    sample(track, 0, 0.1, spot);
    expect(spot.x).toBe(0);
    sample(track, 0, 0.3, spot);
    expect(spot.x).toBe(9);
    expect(track.walked[3]).toBe(0);
  });

  it("brings angles into one turn", () => {
    expect(wrapped(3 * Math.PI)).toBeCloseTo(Math.PI, 9);
    expect(wrapped(-Math.PI)).toBeCloseTo(Math.PI, 9);
    expect(wrapped(-7)).toBeCloseTo(2 * Math.PI - 7, 9);
  });
});

describe("postures", () => {
  const bench = place("furniture", 10, 5, 4, 1, "bench");
  const room = place("room", 0, 0, 30, 30);

  function clips(...own: Parameters<typeof activity>[0][]): string[] {
    const world = worldOf([room, bench], [own.map(activity)], framesOf([still(own[0]?.x ?? 0, own[0]?.y ?? 0)]));
    return buildStretches(world, buildTrack(world.frames))[0]!.map((stretch) => stretch.clip);
  }

  it("tell the action", () => {
    expect(clips({ action: "read", start: 2, end: 8 })).toContain("read");
    expect(clips({ action: "talk on phone" })).toContain("phone");
    expect(clips({ action: "carry" })).toContain("carry");
    expect(clips({ action: "sit" })).toContain("sit");
    expect(clips({ action: "queue" })).toContain("clasp");
  });

  it("are seated on a bench where one can do it sitting", () => {
    expect(clips({ action: "read", location: 1, x: 10, y: 4.15 })).toContain("sitRead");
    expect(clips({ action: "wave at", location: 1, x: 10, y: 4.15 })).toContain("wave");
  });

  it("walk while the frames move", () => {
    const world = worldOf(
      [room],
      [[activity({ action: "carry", arrive: 8, start: 8, end: 12 })]],
      framesOf([[...walk(1.2, 40), ...still(9.36, 0, 0, 20)]]),
    );
    const track = buildTrack(world.frames);
    const own = buildStretches(world, track)[0]!;
    expect(own.map((stretch) => stretch.clip)).toEqual(["walkCarry", "carry", "stand"]);
    const [move] = movesOf(track, 0);
    expect(move!.speed).toBeCloseTo(1.2, 2);
    expect(move!.end).toBeCloseTo(7.8, 5);
  });

  it("are found by time from any guess", () => {
    const world = worldOf(
      [room],
      [
        [
          activity({ action: "read", start: 2, end: 4 }),
          activity({ step: 1, action: "wave at", leave: 4, arrive: 4, start: 4, end: 9 }),
        ],
      ],
      framesOf([still(0, 0)]),
    );
    const own = buildStretches(world, buildTrack(world.frames))[0]!;
    for (const guess of [0, own.length - 1]) {
      expect(own[stretchAt(own, 3, guess)]!.clip).toBe("read");
      expect(own[stretchAt(own, 5, guess)]!.clip).toBe("wave");
      expect(stretchAt(own, -5, guess)).toBe(0);
    }
  });

  it("put who sits on a bench on it, looking outward", () => {
    const seat = seatOn(bench, { x: 9, y: 4.15 })!;
    expect([seat.x, seat.y]).toEqual([9, expect.closeTo(4.72, 5)]);
    expect(seat.heading).toBeCloseTo(-Math.PI / 2, 5);
    expect(seatOn(bench, { x: 9, y: 0 })).toBeNull();
  });
});

describe("the cast", () => {
  const meeting = { action: "discuss", occasion: 4, start: 1, end: 10 } as const;
  const world = worldOf(
    [place("room", 0, 0, 30, 30)],
    [[activity({ ...meeting, partners: [1] })], [activity({ ...meeting, agent: 1, partners: [0] })], []],
    framesOf([still(0, 0), still(1, 0, Math.PI), walk(1.3)]),
  );
  const cast = new Cast(world, buildTrack(world.frames), table, [1, 1.05, 0.95]);
  const at = (time: number): number[] => {
    cast.update(time);
    return [...cast.values];
  };

  it("depends on the time alone, whichever way it runs", () => {
    const times = [0, 0.5, 1.1, 3.33, 4.7, 8, 10.2];
    const forward = times.map(at);
    const backward = [...times].reverse().map(at).reverse();
    const settled = (values: number[]): number[] => values.map(
      (v, i) => (i % STRIDE >= AT.poseB && i % STRIDE < AT.share && values[i - (i % STRIDE) + AT.share] === 1 ? 0 : v)
    );
    expect(backward.map(settled)).toEqual(forward.map(settled));
  });

  it("lets the phase of the walk go with the way", () => {
    const cycle = CLIPS.stride.cycle * 0.95;
    const phase = (time: number): number => {
      const values = at(time);
      const base = 2 * STRIDE + AT.poseA;
      return (values[base]! - table.firstRow.stride + values[base + 2]!) / CLIPS.stride.frames;
    };
    const once = cycle / 1.3;
    const apart = phase(3 + once) - phase(3);
    expect(Math.abs(apart - Math.round(apart))).toBeLessThan(1e-3);
    const half = phase(3 + once / 2) - phase(3);
    expect(Math.abs(Math.abs(half - Math.round(half)) - 0.5)).toBeLessThan(1e-3);
  });

  it("changes nothing by a leap", () => {
    let before = at(0.9);
    for (let time = 0.91; time < 6; time += 0.01) {
      const now = at(time);
      for (const agent of [0, 1]) {
        const base = STRIDE * agent;
        expect(Math.abs(now[base + AT.headYaw]! - before[base + AT.headYaw]!)).toBeLessThan(0.1);
        expect(Math.abs(now[base]! - before[base]!)).toBeLessThan(1e-6);
      }
      before = now;
    }
  });

  it("gives everybody of a circle the word, one at a time", () => {
    const circle = [3, 5, 9];
    const said = new Set(Array.from({ length: 200 }, (_, i) => speakerAt(circle, 7, i)));
    expect([...said].sort()).toEqual(circle);
  });
});
