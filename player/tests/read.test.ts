import { describe, expect, test } from "vitest";
import { readWorld, WorldFileError } from "../src/world/read";
import { rezipped, SMALL, withHead, withTable } from "./fixture";

describe("readWorld", () => {
  const world = readWorld(SMALL);

  test("reads place, people and groups", () => {
    expect(world.provenance["text"]).toBe("Friends meet at the fountain in the park and talk");
    expect(world.duration).toBe(60);
    expect(world.people.map((person) => person.group)).toEqual([0, 0, 1, 1, 2]);
    expect(world.groups.map((group) => group.members)).toEqual([[0, 1], [2, 3], [4]]);
    expect(world.locations.find((place) => place.name === "walk-in fountain")?.category).toBe("item");
  });

  test("reads the activity table; what did not come is NaN", () => {
    const [first, second] = world.people[2]!.activities;
    expect(first).toMatchObject({ action: "enter/exit", partners: [3], status: "done", leave: 11.4, end: 14.7 });
    expect(world.locations[second!.location]!.name).toBe("stone rim");
    expect(second).toMatchObject({ status: "cut", start: 42.9, end: Number.NaN });
    expect(world.people[0]!.activities[1]).toMatchObject({ status: null, leave: Number.NaN });
  });

  test("unpacks the frames: people are where the table says when they do it", () => {
    const { dt, nAgents, nFrames, positions, present, headings } = world.frames;
    expect([nFrames, nAgents, dt]).toEqual([301, 5, 0.2]);
    const at = (45 / dt) * nAgents + 2;
    const { x, y } = world.people[2]!.activities[1]!;
    expect(Math.hypot(positions[2 * at]! - x, positions[2 * at + 1]! - y)).toBeLessThan(0.02);
    expect([present[2], present[at]]).toEqual([0, 1]);
    expect(headings.every((heading) => heading >= -Math.PI && heading <= Math.PI)).toBe(true);
  });

  test("nobody runs: steps between frames are short", () => {
    const { nAgents, positions, present } = world.frames;
    for (let i = 2 * nAgents; i < positions.length; i += 2) {
      if (present[i / 2] !== 1 || present[i / 2 - nAgents] !== 1) continue;
      const [dx, dy] = [
        positions[i]! - positions[i - 2 * nAgents]!,
        positions[i + 1]! - positions[i + 1 - 2 * nAgents]!,
      ];
      expect(Math.hypot(dx, dy)).toBeLessThan(0.6);
    }
  });

  test("takes names with commas and quotes", () => {
    const name = 'the "old", long bench';
    const renamed = rezipped((members) => {
      const text = new TextDecoder().decode(members["world.json"]).replace('"long bench"', JSON.stringify(name));
      members["world.json"] = new TextEncoder().encode(text);
      const table = new TextDecoder().decode(members["activities.csv"]);
      members["activities.csv"] = new TextEncoder().encode(
        table.replaceAll(",long bench,", ',"the ""old"", long bench",'),
      );
    });
    const { locations, people } = readWorld(renamed);
    expect(locations[people[4]!.activities[0]!.location]!.name).toBe(name);
  });

  test.each<[string, Uint8Array, string]>([
    ["nothing", new Uint8Array(), "is empty"],
    ["another file", new TextEncoder().encode("hello"), "ZIP archive"],
    ["a file cut short", SMALL.subarray(0, SMALL.length / 2), "cut short or damaged"],
    ["an archive without a head", rezipped((members) => delete members["world.json"]), "no world.json"],
    ["an archive without frames", rezipped((members) => delete members["present.npy"]), "no present.npy"],
    ["a head that is no JSON", rezipped((members) => (members["world.json"] = new Uint8Array([123]))), "no JSON"],
    ["another format", withHead((head) => (head["format"] = "other")), "its format is not"],
    ["a newer schema", withHead((head) => (head["schema"] = 2)), "schema 2"],
    ["a head without a length", withHead((head) => delete head["duration_s"]), "no duration_s"],
    ["an unknown category", withHead((head) => (head["locations"][0].category = "moat")), "no known category"],
    ["frames of another shape", withHead((head) => (head["frames"].n_frames = 300)), "301 x 5"],
    ["more people than frames", withHead((head) => head["people"].group.push(0)), "6 people"],
    ["an unknown action", withTable((table) => table.replace(",sit,", ",dance,")), "action 'dance'"],
    ["an unknown location", withTable((table) => table.replace(",lawn,", ",moon,")), "location 'moon'"],
    ["an unknown person", withTable((table) => `${table}9,0,sit,lawn,99,,0,0,0,0,0,0,0,,,,,,,,\n`), "person '9'"],
    ["a step too many", withTable((table) => table.replace("0,1,read", "0,2,read")), "out of order"],
    ["a time that is none", withTable((table) => table.replace(",11.4,", ",soon,")), "time 'soon'"],
    ["a table with other columns", withTable((table) => table.replace("occasion", "event")), "no column occasion"],
  ])("refuses %s in one line", (_, bytes, said) => {
    expect(() => readWorld(bytes)).toThrow(WorldFileError);
    expect(() => readWorld(bytes)).toThrow(said);
    expect(() => readWorld(bytes)).not.toThrow(/\n/);
  });

  test("never takes a file with one byte changed for a sound one", () => {
    const untouched = JSON.stringify(readWorld(SMALL).people);
    for (let at = 0; at < SMALL.length; at += 7) {
      const bytes = SMALL.slice();
      bytes[at]! ^= 0x55;
      try {
        expect(JSON.stringify(readWorld(bytes).people)).toBe(untouched);
      } catch (error) {
        if (!(error instanceof WorldFileError)) throw error;
      }
    }
  });
});
