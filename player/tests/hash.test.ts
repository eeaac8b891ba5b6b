import { describe, expect, test } from "vitest";
import { parseHash } from "../src/ui/hash";

describe("parseHash", () => {
  test("reads what is asked for", () => {
    const hash = "#t=120.5&ui=0&agent=12&group=3&view=top&theme=dark&play=1&speed=4&heat=1&names=0&follow=1&graph=0";
    expect(parseHash(hash)).toEqual({
      ...{ t: 120.5, ui: false, agent: 12, group: 3, view: "top", theme: "dark", play: true, speed: 4 },
      ...{ heat: true, names: false, follow: true, graph: false },
    });
  });

  test("what cannot be understood is as if it were not there", () => {
    const odd = "#t=soon&agent=-1&group=1.5&view=__proto__&theme=pink&play=yes&speed=&x=1&toString=1&constructor=2";
    expect(parseHash(odd)).toEqual({});
    expect(parseHash("")).toEqual({});
    expect(parseHash("#t=-5")).toEqual({});
  });

  test("speeds have bounds", () => {
    expect([parseHash("#speed=1000").speed, parseHash("#speed=0").speed]).toEqual([64, 0.1]);
  });
});
