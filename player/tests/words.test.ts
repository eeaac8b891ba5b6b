import { describe, expect, test } from "vitest";
import { readWorld } from "../src/world/read";
import { clock, counted, persons, span, tellNow, withArticle } from "../src/ui/words";
import { SMALL, withTable } from "./fixture";

describe("clock and span", () => {
  test.each([
    [0, "00:00"],
    [59.99, "00:59"],
    [60, "01:00"],
    [599.9999999, "10:00"],
    [6000, "100:00"],
    [Number.NaN, "--:--"],
  ])("clock of %d", (time, said) => expect(clock(time)).toBe(said));

  test("a span has its unit", () => {
    expect([span(8.4), span(59.6), span(125)]).toEqual(["8 s", "1:00 min", "2:05 min"]);
  });
});

describe("words", () => {
  test("counts and names", () => {
    expect([counted(1, "person", "people"), counted(1000, "person", "people")]).toEqual(["1 person", "1,000 people"]);
    expect([persons([4]), persons([1, 2]), persons([1, 2, 3]), persons([1, 2, 3, 4])]).toEqual([
      "Person 4",
      "Persons 1 and 2",
      "Persons 1, 2 and 3",
      "Persons 1, 2 and 2 others",
    ]);
  });

  test("articles", () => {
    expect(["pizza van", "platform 2", "Hall B", "the gate", "gate A"].map(withArticle)).toEqual([
      "the pizza van",
      "platform 2",
      "Hall B",
      "the gate",
      "gate A",
    ]);
  });

  const world = readWorld(SMALL);
  test.each([
    [2, 0, "comes at 00:11"],
    [2, 12, "goes through the embassy street corner with Person 3"],
    [2, 20, "walks to the stone rim"],
    [3, 42.5, "waits at the stone rim for Person 2"],
    [3, 50, "sits at the stone rim with Person 2"],
    [0, 5, "sits at the walk-in fountain"],
  ])("person %d at %d s", (agent, time, said) => expect(tellNow(world, agent, time)).toBe(said));

  test("who has no plan, and who never comes", () => {
    const empty = readWorld(withTable((table) => table.slice(0, table.indexOf("\n") + 1)));
    expect(tellNow(empty, 0, 5)).toBe("has no plan");
  });
});
