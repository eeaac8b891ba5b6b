/** A small world made by genc: five people, one minute; and what becomes of it when its members are changed. */

import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { strToU8, unzipSync, zipSync } from "fflate";
import type { Activity, Person } from "../src/world/world";

export const SMALL: Uint8Array = readFileSync(resolve(import.meta.dirname, "small.genc"));

type Members = Record<string, Uint8Array>;

export function rezipped(change: (members: Members) => void): Uint8Array {
  const members = unzipSync(SMALL);
  change(members);
  return zipSync(members);
}

/** The small world with another head. */
export function withHead(change: (head: Record<string, any>) => void): Uint8Array {
  return rezipped((members) => {
    const head = JSON.parse(new TextDecoder().decode(members["world.json"]));
    change(head);
    members["world.json"] = strToU8(JSON.stringify(head));
  });
}

/** The small world with another activity table. */
export function withTable(change: (table: string) => string): Uint8Array {
  return rezipped((members) => {
    members["activities.csv"] = strToU8(change(new TextDecoder().decode(members["activities.csv"])));
  });
}

export function activity(change: Partial<Activity>): Activity {
  return {
    ...{ agent: 0, step: 0, action: "wait", location: 0, occasion: 0, partners: [], implied: false },
    ...{ planStart: 0, planEnd: 0, status: "done", leave: 0, arrive: 0, start: 0, end: 0, x: 0, y: 0, facing: 0 },
    ...change,
  };
}

export function person(id: number, activities: readonly Activity[]): Person {
  return { id, group: 0, speed: 1.3, activities };
}
