import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { STRIDE, AT } from "./cast";
import { isSolid, kindOf } from "./kinds";
import { placeLabels, type Box } from "./label_layout";
import { SUN } from "./light";
import { boundsOf, buildHeatMap, buildOccupancy, CELL_M, inferno, useOf, wasNear } from "./occupancy";
import { groupColour, lookOf, SKINS } from "./palette";
import { entryOf, gapToPost, pickLocation, pickPerson, type Ray } from "./picking";
import { activity, framesOf, place, worldOf } from "./samples";
import { buildShadeMap } from "./shade";
import { disc, inset, rounded, SolidMesh } from "./solid";
import { buildPlace } from "./structure";
import { runs } from "./walls";

const room = place("room", 0, 0, 10, 10, "room");
const through = Array.from({ length: 80 }, (_, f): [number, number, number] => [-8 + f * 0.2, 0, 0]);

describe("what a location is", () => {
  it("is solid as the conventions say", () => {
    const [hall, inside, gate] = [
      place("building", 0, 0, 20, 20), place("room", 3, 3, 4, 4), place("entrance", 0, 0, 2, 2),
    ];
    expect(isSolid(hall, [hall])).toBe(true);
    expect(isSolid(hall, [hall, gate])).toBe(true);
    expect(isSolid(hall, [hall, inside])).toBe(false);
    expect(isSolid(place("furniture", 0, 0, 5, 8), [])).toBe(true);
    expect(isSolid(place("furniture", 0, 0, 5, 8.1), [])).toBe(false);
    expect(isSolid(place("outdoor area", 0, 0, 1, 1), [])).toBe(false);
  });

  it("takes its form from size and name", () => {
    expect(kindOf(place("furniture", 0, 0, 4, 0.6, "gallery seat"), true)).toBe("bench");
    expect(kindOf(place("furniture", 0, 0, 2, 2, "cafe table"), true)).toBe("table");
    expect(kindOf(place("furniture", 0, 0, 9, 9, "stalls"), false)).toBe("market");
    expect(kindOf(place("outdoor area", 0, 0, 9, 9, "Old Quad Lawn"), false)).toBe("lawn");
    expect(kindOf(place("exhibit", 0, 0, 5, 5, "dry fountain"), true)).toBe("fountain");
  });
});

describe("occupancy", () => {
  const frames = framesOf([through, Array.from({ length: 80 }, () => [3.1, 3.1, 0] as const)]);
  const occupancy = buildOccupancy(frames, [room]);

  it("counts every second once", () => {
    expect(occupancy.seconds.reduce((a, b) => a + b, 0)).toBeCloseTo(2 * 80 * 0.2, 2);
    expect(useOf(occupancy, place("item", 3.1, 3.1, 0.4, 0.4), 0)).toBeCloseTo(16, 3);
  });

  it("knows where anybody ever was", () => {
    expect(wasNear(occupancy, -5, 0.3, 0.5)).toBe(true);
    expect(wasNear(occupancy, -5, 2, 0.5)).toBe(false);
  });

  it("opens walls where people go through and nowhere else", () => {
    const side = { x: -5, y: -5, along: "y", length: 10 } as const;
    const walls = runs(side, [], occupancy);
    expect(walls).toHaveLength(2);
    expect(walls[0]![1]).toBeGreaterThan(3.8);
    expect(walls[0]![1]).toBeLessThan(4.6);
    expect(walls[1]![1]).toBe(10);
    expect(runs({ x: -5, y: 5, along: "x", length: 10 }, [], occupancy)).toEqual([[0, 10]]);
  });

  it("colours much used ground brighter", () => {
    const heat = buildHeatMap(occupancy);
    const light = (x: number, y: number): number => {
      const i = Math.floor(
        (y - occupancy.bounds.y0) / CELL_M
      ) * heat.nx + Math.floor((x - occupancy.bounds.x0) / CELL_M);
      return heat.pixels[4 * i]! + heat.pixels[4 * i + 1]!;
    };
    expect(light(3.1, 3.1)).toBeGreaterThan(light(-2, 0));
    expect(heat.legend.map((stop) => stop.value)).toEqual(
      [...heat.legend.map((stop) => stop.value)].sort((a, b) => a - b)
    );
    expect(inferno(0)).toEqual([0, 0, 4]);
    expect(inferno(1)).toEqual([252, 255, 164]);
  });

  it("does without any locations", () => {
    expect(boundsOf([])).toEqual({ x0: -10, y0: -10, x1: 10, y1: 10 });
  });
});

describe("picking", () => {
  const values = new Float32Array(2 * STRIDE);
  [[0, 5], [1, 12]].forEach(([agent, y]) => values.set([0.1 * agent!, y!, 0, 1], STRIDE * agent!));
  values[AT.presence] = values[STRIDE + AT.presence] = 1;
  const level: Ray = { x: 0, y: 0, z: 1.2, dx: 0, dy: 1, dz: 0 };

  it("takes the nearest person on the line", () => {
    expect(pickPerson(level, values, 2, 0)).toBe(0);
    expect(pickPerson({ ...level, y: 20, dy: -1 }, values, 2, 0)).toBe(1);
  });

  it("misses beside, over and behind", () => {
    expect(pickPerson({ ...level, x: 0.6 }, values, 2, 0)).toBeNull();
    expect(pickPerson({ ...level, z: 2.2 }, values, 2, 0)).toBeNull();
    expect(pickPerson({ ...level, y: 20 }, values, 2, 0)).toBeNull();
    expect(pickPerson({ ...level, x: 0.35 }, values, 2, 0.05)).toBe(0);
  });

  it("leaves out who is not in sight", () => {
    const hidden = values.slice();
    hidden[AT.presence] = 0;
    expect(pickPerson(level, hidden, 2, 0)).toBe(1);
  });

  it("measures from straight above, too", () => {
    const [gap, along] = gapToPost({ x: 0.3, y: 0, z: 10, dx: 0, dy: 0, dz: -1 }, 0, 0, 0.1, 1.6);
    expect(gap).toBeCloseTo(0.3, 9);
    expect(along).toBeCloseTo(8.4, 9);
  });

  it("takes the smallest floor, and a box before the floor", () => {
    const down: Ray = { x: 1, y: 1, z: 10, dx: 0, dy: 0, dz: -1 };
    const small = place("entrance", 1, 1, 2, 2);
    expect(pickLocation(down, [room, small], [0.01, 0.01])).toBe(1);
    expect(pickLocation(down, [room, place("building", 0, 0, 4, 4)], [0.01, 3])).toBe(1);
    expect(pickLocation({ ...down, x: 9 }, [room, small], [0.01, 0.01])).toBeNull();
    expect(entryOf({ ...down, z: 10 }, room, 3)).toBeCloseTo(7, 9);
  });
});

describe("colours", () => {
  const lab = (colour: number): [number, number, number] => {
    const [r, g, b] = [16, 8, 0].map((shift) => (((colour >> shift) & 255) / 255) ** 2.2) as [number, number, number];
    const [l, m, s] = [
      0.412 * r + 0.536 * g + 0.051 * b, 0.212 * r + 0.681 * g + 0.107 * b, 0.088 * r + 0.282 * g + 0.63 * b,
    ].map(Math.cbrt) as [number, number, number];
    return [0.21 * l + 0.794 * m - 0.004 * s, 1.978 * l - 2.429 * m + 0.451 * s, 0.026 * l + 0.783 * m - 0.809 * s];
  };
  const apart = (a: number, b: number): number => Math.hypot(...lab(a).map((c, i) => c - lab(b)[i]!));

  it("tell the first sixteen groups apart", () => {
    for (let a = 0; a < 16; a += 1) for (let b = 0; b < a; b += 1) expect(
      apart(groupColour(a), groupColour(b))
    ).toBeGreaterThan(0.07);
  });

  it("differ for sixty-four groups, and show on both grounds", () => {
    const colours = Array.from({ length: 64 }, (_, group) => groupColour(group));
    expect(new Set(colours).size).toBe(64);
    for (const colour of colours.slice(0, 16)) {
      for (const skin of Object.values(SKINS)) expect(apart(colour, skin.ground)).toBeGreaterThan(0.12);
    }
  });

  it("give the same person the same look, of natural height", () => {
    for (let person = 0; person < 500; person += 1) {
      const look = lookOf(person, 3);
      expect(look).toEqual(lookOf(person, 3));
      expect(1.75 * look.height).toBeGreaterThan(1.5);
      expect(1.75 * look.height).toBeLessThan(1.9);
    }
  });
});

describe("shadows", () => {
  const bounds = { x0: -10, y0: -10, x1: 10, y1: 10 };
  const map = buildShadeMap(bounds, [{ x: 0, y: 0, width: 2, depth: 2, from: 0, to: 3 }], SUN);
  const cell = (v: number, n: number): number => Math.floor(((v + 10) / 20) * n);
  const sunAt = (x: number, y: number): number => map.texels[2 * (cell(y, map.ny) * map.nx + cell(x, map.nx))]!;

  it("fall away from the sun, as long as they should be", () => {
    const far = (3 / SUN.z) * Math.hypot(SUN.x, SUN.y);
    const way = [-SUN.x, -SUN.y].map((c) => c / Math.hypot(SUN.x, SUN.y)) as [number, number];
    expect(sunAt(way[0] * (far - 0.2), way[1] * (far - 0.2))).toBeLessThan(20);
    expect(sunAt(way[0] * (far + 2.2), way[1] * (far + 2.2))).toBeGreaterThan(235);
    expect(sunAt(-way[0] * 2.2, -way[1] * 2.2)).toBeGreaterThan(235);
  });
});

describe("building", () => {
  it("has every category stand on the ground, with faces that look outward", () => {
    const names = [
      "hall",
      "open",
      "gate",
      "desk",
      "seat",
      "map board",
      "fountain",
      "kiosk",
      "lawn",
      "statue",
      "car",
      "clock",
      "bin",
      "cart",
      "flag",
    ];
    const categories = [
      "building",
      "building",
      "entrance",
      "furniture",
      "furniture",
      "item",
      "exhibit",
      "service area",
      "outdoor area",
      "exhibit",
      "exhibit",
      "exhibit",
      "item",
      "item",
      "item",
    ] as const;
    const places = names.map((name, i) => place(categories[i]!, 12 * i, 0, i === 4 ? 4 : 5, i === 4 ? 0.6 : 5, name));
    const world = worldOf(places, [[activity({})]], framesOf([through]));
    const { site, patches } = buildPlace(world, buildOccupancy(world.frames, places), SKINS.light);
    const geometry = site.mesh.geometry();
    const z = geometry.getAttribute("position");
    for (let i = 0; i < z.count; i += 1) expect(z.getZ(i)).toBeGreaterThanOrEqual(0);
    expect(patches.length).toBe(2);
    expect(site.casters.length).toBeGreaterThan(10);
  });

  it("draws outlines in evenly", () => {
    for (const [x, y] of inset(rounded(0, 0, 4, 2, 0.1, 2), 0.3)) {
      expect(Math.abs(x)).toBeLessThanOrEqual(1.7 + 1e-6);
      expect(Math.abs(y)).toBeLessThanOrEqual(0.7 + 1e-6);
    }
    for (const [x, y] of inset(disc(0, 0, 1), 0.2)) expect(Math.hypot(x, y)).toBeCloseTo(0.8, 1);
  });

  it("turns the faces of a prism outward", () => {
    const mesh = new SolidMesh();
    mesh.prism(disc(0, 0, 1), 0, 2, 0xffffff, { bevel: 0.1 });
    const geometry = mesh.geometry();
    const [at, index] = [geometry.getAttribute("position"), geometry.getIndex()!];
    const corner = (k: number): Vector3 => new Vector3().fromBufferAttribute(at, index.getX(k));
    for (let t = 0; t < index.count; t += 3) {
      const [a, b, c] = [corner(t), corner(t + 1), corner(t + 2)];
      const face = b.clone().sub(a).cross(c.clone().sub(a));
      expect(face.dot(a.clone().sub(new Vector3(0, 0, 1)))).toBeGreaterThan(-1e-6);
    }
  });
});

describe("labels", () => {
  it("keep clear of each other, the more important ones first", () => {
    const box = (x: number): Box => ({ x, y: 0, width: 50, height: 20 });
    const shown = placeLabels([
      { label: 0, rank: 2, box: box(0) }, { label: 1, rank: 1, box: box(40) }, { label: 2, rank: 3, box: box(100) },
    ]);
    expect(shown).toEqual([1, 2]);
  });
});
