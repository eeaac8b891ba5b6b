import { describe, expect, test } from "vitest";
import { readWorld } from "../src/world/read";
import { countsAt, seen, takeCensus } from "../src/world/census";
import { nextSpeed } from "../src/ui/commands";
import { find } from "../src/ui/find";
import { commandOf } from "../src/ui/keyboard";
import { planPieces } from "../src/ui/plan_strip";
import { Store } from "../src/ui/store";
import { activity, SMALL, withHead } from "./fixture";

const world = readWorld(SMALL);

describe("find", () => {
  const titles = (query: string): string[] => find(world, query).map((hit) => hit.title);

  test("people and groups by number", () => {
    expect(titles("person 3")).toEqual(["Person 3"]);
    expect(titles("3")).toEqual(["Person 3"]);
    expect(titles("1")).toEqual(["Person 1", "Group 1"]);
    expect(titles("g2")).toEqual(["Group 2"]);
    expect(titles("group")).toEqual(["Group 0", "Group 1", "Group 2"]);
  });

  test("places by name and category, actions by name", () => {
    expect(titles("Fountain")).toEqual(["walk-in fountain"]);
    expect(titles("queue")[0]).toBe("queue");
    expect(titles("exhibit")).toContain("general's statue");
  });

  test("groups by a caption of their own, not by the sentence that all share", () => {
    expect(titles("friends meet")).toEqual([]);
    const own = readWorld(withHead((head) => (head["groups"][1].caption = "Two old friends")));
    expect(find(own, "old friend").map((hit) => hit.title)).toEqual(["Group 1"]);
  });

  test("nothing finds nothing", () => {
    expect([titles(""), titles("  "), titles("zebra")]).toEqual([[], [], []]);
  });
});

describe("the census", () => {
  const census = takeCensus(world, 60);

  test("counts everybody in sight, in each bin", () => {
    const total = (time: number): number => countsAt(census, time).reduce((sum, { count }) => sum + count, 0);
    expect([total(5), total(50), census.most]).toEqual([3, 5, 5]);
    expect(countsAt(census, 60)).toEqual(countsAt(census, 59.5));
  });

  test("tells walking and waiting from doing", () => {
    expect(countsAt(census, 30.5)).toContainEqual({ kind: "walk", count: 2 });
    expect(seen({ phase: "wait", activity: activity({ action: "discuss" }) })).toBe("wait");
    expect(seen({ phase: "wait", activity: activity({ action: "queue" }) })).toBe("queue");
    expect(seen({ phase: "idle", activity: null })).toBe("stand");
  });
});

describe("the plan strip", () => {
  test("has a piece for every phase that takes time, to the end of the world", () => {
    const pieces = planPieces(
      [
        activity({ leave: 0, arrive: 4, start: 4, end: 10 }),
        activity({ leave: 10, arrive: 15, start: 20, end: Number.NaN, status: "cut" }),
        activity({ leave: Number.NaN, status: null }),
      ],
      60,
    );
    expect(pieces.map(({ phase, from, to }) => [phase, from, to])).toEqual([
      ["walk", 0, 4],
      ["do", 4, 10],
      ["walk", 10, 15],
      ["wait", 15, 20],
      ["do", 20, 60],
    ]);
  });
});

describe("keys and speeds", () => {
  test("keys stand for commands", () => {
    const command = (key: string, shiftKey = false) => commandOf({ key, shiftKey });
    expect(command(" ")).toEqual({ kind: "play" });
    expect(command("ArrowLeft")).toEqual({ kind: "step", seconds: -5 });
    expect(command("ArrowRight", true)).toEqual({ kind: "step", seconds: 30 });
    expect(command("F")).toEqual({ kind: "follow" });
    expect(command("?", true)).toEqual({ kind: "help" });
    expect([command("x"), command("F5"), command("Tab")]).toEqual([null, null, null]);
  });

  test("speeds go up and down their list and stop at its ends", () => {
    expect([nextSpeed(1, 1), nextSpeed(1, -1), nextSpeed(16, 1), nextSpeed(0.5, -1), nextSpeed(3, 1)]).toEqual([
      2, 0.5, 16, 0.5, 4,
    ]);
  });
});

describe("the store", () => {
  test("tells at once, and of true changes only", () => {
    const store = new Store({ a: 1, b: 1 });
    const told: number[] = [];
    store.watch(["a"], ({ a }) => told.push(a));
    store.set({ a: 1 });
    store.set({ b: 2 });
    store.set({ a: 2, b: 3 });
    expect(told).toEqual([1, 2]);
  });
});
