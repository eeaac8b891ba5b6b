/** World files (docs/formats.md): the bytes of one become a `World`, or an error that says in one line why not. */

import { readActivities } from "./activities";
import { entry, index, list, number, pair, text, type Json } from "./checked";
import { unpackFrames, type FrameHead } from "./frames";
import { unzip } from "./zip";
import { CATEGORIES, type Category, type Group, type Location, type Person, type World } from "./world";

export const FORMAT = "genc world";
export const SCHEMA = 1;

/** No layout needs more people; a head that claims more is damaged. */
const MOST_AGENTS = 1_000_000;

/** A world file that cannot be played; the message is meant for the user. */
export class WorldFileError extends Error {}

/** The world that a file holds. Throws `WorldFileError`. */
export function readWorld(bytes: Uint8Array): World {
  if (bytes.length === 0) throw new WorldFileError("This world file is empty. Write it again with genc populate.");
  if (String.fromCharCode(...bytes.subarray(0, 4)) !== "PK\x03\x04") {
    throw new WorldFileError("This is not a world file: a world file is a ZIP archive, written by genc populate.");
  }
  const members = unpacked(bytes);
  const head = parsed(members);
  checkKind(head);
  try {
    return build(head, (name) => member(members, name));
  } catch (error) {
    throw new WorldFileError(`This world file is not sound (${reason(error)}). Write it again with genc populate.`);
  }
}

function unpacked(bytes: Uint8Array): Map<string, Uint8Array> {
  try {
    return unzip(bytes);
  } catch (error) {
    const why = error instanceof RangeError ? "its end is missing" : reason(error);
    throw new WorldFileError(`This world file is cut short or damaged (${why}). Write it again with genc populate.`);
  }
}

function parsed(members: ReadonlyMap<string, Uint8Array>): Json {
  const head = members.get("world.json");
  if (head === undefined) throw new WorldFileError("This ZIP archive is not a world file: it has no world.json.");
  try {
    return JSON.parse(new TextDecoder().decode(head)) as Json;
  } catch {
    throw new WorldFileError(
      "This world file is not sound (world.json is no JSON). Write it again with genc populate.",
    );
  }
}

function checkKind(head: Json): void {
  const { format, schema } = (typeof head === "object" && head !== null ? head : {}) as Record<string, unknown>;
  if (format !== FORMAT) throw new WorldFileError(`This is not a world file: its format is not "${FORMAT}".`);
  if (!(typeof schema === "number" && schema <= SCHEMA)) {
    throw new WorldFileError(
      `This world was written by a newer genc (schema ${String(schema)}; this player reads ${SCHEMA}). ` +
        "Open the page that was written with it.",
    );
  }
}

function build(head: Json, file: (name: string) => Uint8Array): World {
  const locations = list(entry(head, "locations", "world.json"), "locations").map(readLocation);
  const captions = list(entry(head, "groups", "world.json"), "groups").map((group, i) =>
    text(entry(group, "caption", `group ${i}`), `the caption of group ${i}`),
  );
  const frameHead = readFrameHead(entry(head, "frames", "world.json"));
  const places = new Map(locations.map((location, i) => [location.name, i]));
  const table = new TextDecoder().decode(file("activities.csv"));
  const activities = readActivities(table, places, frameHead.nAgents);
  const people = readPeople(entry(head, "people", "world.json"), activities);
  return {
    provenance: readProvenance(entry(head, "provenance", "world.json")),
    duration: number(entry(head, "duration_s", "world.json"), "duration_s"),
    locations,
    groups: gather(captions, people),
    people,
    notes: list(entry(head, "notes", "world.json"), "notes").map((note) => text(note, "a note")),
    frames: unpackFrames(frameHead, {
      positions: file("positions.npy"),
      headings: file("headings.npy"),
      present: file("present.npy"),
    }),
  };
}

function readLocation(place: Json, i: number): Location {
  const where = `location ${i}`;
  const [x, y] = pair(entry(place, "position_m", where), where);
  const [width, depth] = pair(entry(place, "size_m", where), where);
  const category = CATEGORIES.find((known) => known === entry(place, "category", where));
  if (category === undefined) throw new Error(`${where} is of no known category`);
  return { name: text(entry(place, "name", where), where), category: category satisfies Category, x, y, width, depth };
}

function readFrameHead(frames: Json): FrameHead {
  return {
    nFrames: index(entry(frames, "n_frames", "frames"), Number.MAX_SAFE_INTEGER, "n_frames"),
    nAgents: index(entry(frames, "n_agents", "frames"), MOST_AGENTS, "n_agents"),
    dt: number(entry(frames, "dt_s", "frames"), "dt_s"),
    origin: pair(entry(frames, "origin_m", "frames"), "origin_m"),
    quantum: number(entry(frames, "quantum_m", "frames"), "quantum_m"),
  };
}

function readPeople(columns: Json, activities: readonly Person["activities"][]): Person[] {
  const groups = list(entry(columns, "group", "people"), "people");
  const speeds = list(entry(columns, "speed_mps", "people"), "people");
  if (groups.length !== activities.length || speeds.length !== activities.length) {
    throw new Error(`${groups.length} people where the frames have ${activities.length}`);
  }
  return activities.map((own, id) => ({
    id,
    group: index(groups[id], MOST_AGENTS, `the group of person ${id}`),
    speed: number(speeds[id], `the speed of person ${id}`),
    activities: own,
  }));
}

/** The groups with their people; one that the captions do not reach has none. */
function gather(captions: readonly string[], people: readonly Person[]): Group[] {
  const members: number[][] = captions.map(() => []);
  for (const person of people) {
    while (members.length <= person.group) members.push([]);
    members[person.group]!.push(person.id);
  }
  return members.map((own, id) => ({ id, caption: captions[id] ?? "", members: own }));
}

function readProvenance(value: Json): World["provenance"] {
  const entries = Object.entries(value ?? {}).map(([key, said]) => {
    if (said === null || typeof said === "string" || typeof said === "number") return [key, said] as const;
    throw new Error(`the provenance has a ${key} that is neither text nor number`);
  });
  return Object.fromEntries(entries);
}

function member(members: ReadonlyMap<string, Uint8Array>, name: string): Uint8Array {
  const content = members.get(name);
  if (content === undefined) throw new Error(`it has no ${name}`);
  return content;
}

function reason(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
