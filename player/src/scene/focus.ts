/** Who is marked at a moment: the chosen person and the partners, or a group. */

import { doingAt } from "../world/doing";
import type { World } from "../world/world";
import { AT, STRIDE, type Cast } from "./cast";
import type { FloorMarks } from "./marks";
import { groupColour, type Skin } from "./palette";

const DIMMED = 0.52;
const RING_M = 0.42;

export class Focus {
  agent: number | null = null;
  group: number | null = null;
  private readonly world: World;

  constructor(world: World) {
    this.world = world;
  }

  /** Dims who is not meant. */
  dim(dimming: Float32Array, time: number): void {
    if (this.agent === null && this.group === null) {
      dimming.fill(0);
      return;
    }
    dimming.fill(DIMMED);
    if (this.agent !== null) {
      dimming[this.agent] = 0;
      for (const partner of this.partners(time)) dimming[partner] = 0;
    } else {
      for (const member of this.world.groups[this.group!]?.members ?? []) dimming[member] = 0;
    }
  }

  /** Rings and links; `least` is the smallest ring that can be seen, metres by metre of distance. */
  mark(marks: FloorMarks, cast: Cast, time: number, skin: Skin, reach: (x: number, y: number) => number): void {
    if (this.agent !== null) this.markPerson(marks, cast, time, skin, reach);
    else if (this.group !== null) {
      const colour = groupColour(this.group);
      for (const member of this.world.groups[this.group]?.members ?? []) {
        ringOf(marks, cast, member, colour, 0.9, reach);
      }
    }
  }

  private markPerson(
    marks: FloorMarks,
    cast: Cast,
    time: number,
    skin: Skin,
    reach: (x: number, y: number) => number,
  ): void {
    const { values } = cast;
    const own = STRIDE * this.agent!;
    for (const partner of this.partners(time)) {
      const base = STRIDE * partner;
      if (values[base + AT.presence]! <= 0) continue;
      if (values[own + AT.presence]! > 0) {
        const width = 0.05 * Math.max(1, 0.7 * reach(values[base]!, values[base + 1]!));
        marks.link(values[own]!, values[own + 1]!, values[base]!, values[base + 1]!, skin.partner, width);
      }
      ringOf(marks, cast, partner, skin.partner, 0.9, reach);
    }
    ringOf(marks, cast, this.agent!, skin.select, 1, reach);
  }

  private partners(time: number): readonly number[] {
    const person = this.world.people[this.agent!];
    return person === undefined ? [] : (doingAt(person, time).activity?.partners ?? []);
  }
}

function ringOf(
  marks: FloorMarks,
  cast: Cast,
  agent: number,
  colour: number,
  share: number,
  reach: (x: number, y: number) => number,
): void {
  const base = STRIDE * agent;
  const presence = cast.values[base + AT.presence]!;
  if (presence <= 0) return;
  const [x, y] = [cast.values[base]!, cast.values[base + 1]!];
  marks.ring(x, y, RING_M * Math.max(1, reach(x, y)), colour, share * presence);
}
