/** Small worlds for the tests of this folder. */

import type { Activity, Frames, Location, Person, World } from "../world/world";

/** Frames from what each person does: a path by frame, null while out of sight. */
export function framesOf(paths: readonly (readonly (readonly [number, number, number] | null)[])[], dt = 0.2): Frames {
  const nAgents = paths.length;
  const nFrames = paths[0]?.length ?? 0;
  const frames = {
    nFrames, nAgents, dt,
    positions: new Float32Array(2 * nFrames * nAgents),
    headings: new Float32Array(nFrames * nAgents),
    present: new Uint8Array(nFrames * nAgents),
  };
  paths.forEach((path, agent) => {
    let last: readonly [number, number, number] = [0, 0, 0];
    path.forEach((place, frame) => {
      const entry = frame * nAgents + agent;
      last = place ?? last;
      frames.positions.set([last[0], last[1]], 2 * entry);
      frames.headings[entry] = last[2];
      frames.present[entry] = place === null ? 0 : 1;
    });
  });
  return frames;
}

export function activity(given: Partial<Activity>): Activity {
  return {
    agent: 0, step: 0, action: "wait", location: 0, occasion: 0, partners: [], implied: false,
    planStart: 0, planEnd: 10, status: "done", leave: 0, arrive: 0, start: 0, end: 10, x: 0, y: 0, facing: 0, ...given,
  };
}

export function worldOf(
  locations: readonly Location[],
  activities: readonly (readonly Activity[])[],
  frames: Frames,
): World {
  const people = activities.map((own, id): Person => ({ id, group: 0, speed: 1.3, activities: own }));
  return {
    provenance: {}, duration: frames.nFrames * frames.dt, locations, people, notes: [], frames,
    groups: [{ id: 0, caption: "", members: people.map((person) => person.id) }],
  };
}

export const place = (
  category: Location["category"],
  x: number,
  y: number,
  width: number,
  depth: number,
  name = "",
): Location => ({
  name, category, x, y, width, depth,
});
