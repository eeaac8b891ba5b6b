import { describe, expect, test } from "vitest";
import { doingAt } from "../src/world/doing";
import { readWorld } from "../src/world/read";
import { activity, person, SMALL } from "./fixture";

const NEVER = Number.NaN;

describe("doingAt", () => {
  const life = person(0, [
    activity({ step: 0, leave: 10, arrive: 20, start: 30, end: 40 }),
    activity({ step: 1, leave: 40, arrive: 40, start: 40, end: 50 }),
    activity({ step: 2, leave: 50, arrive: 60, start: NEVER, end: NEVER, status: "cut" }),
    activity({ step: 3, leave: NEVER, arrive: NEVER, start: NEVER, end: NEVER, status: null }),
  ]);

  test.each([
    [0, "idle", undefined],
    [9.99, "idle", undefined],
    [10, "walk", 0],
    [20, "wait", 0],
    [30, "do", 0],
    [39.9, "do", 0],
    [40, "do", 1],
    [50, "walk", 2],
    [60, "wait", 2],
    [1e9, "wait", 2],
  ])("at %d s: %s", (time, phase, step) => {
    const doing = doingAt(life, time);
    expect([doing.phase, doing.activity?.step]).toEqual([phase, step]);
  });

  test("is idle after the last activity, and without any", () => {
    const done = person(0, [activity({ leave: 0, arrive: 1, start: 2, end: 3 })]);
    expect(doingAt(done, 3)).toEqual({ phase: "idle", activity: null });
    expect(doingAt(person(0, []), 5)).toEqual({ phase: "idle", activity: null });
  });

  test("walks for ever where the arrival did not come", () => {
    const late = person(0, [activity({ leave: 5, arrive: NEVER, start: NEVER, end: NEVER, status: "cut" })]);
    expect(doingAt(late, 600).phase).toBe("walk");
  });

  test("an activity without length is passed over", () => {
    const quick = person(0, [
      activity({ step: 0, leave: 0, arrive: 5, start: 5, end: 5 }),
      activity({ step: 1, leave: 5, arrive: 5, start: 5, end: 9 }),
    ]);
    expect(doingAt(quick, 5).activity?.step).toBe(1);
  });

  test("agrees with a plain search, at every quarter of a second of a real world", () => {
    for (const one of readWorld(SMALL).people) {
      for (let time = 0; time <= 60; time += 0.25) {
        const begun = one.activities.filter((a) => a.leave <= time).at(-1);
        const over = begun === undefined || begun.end <= time;
        expect(doingAt(one, time).activity).toBe(over ? null : begun);
      }
    }
  });
});
