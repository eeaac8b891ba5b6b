/** What somebody is up to at a moment, from the times of the activity table. */

import type { Activity, Doing, Person, Phase } from "./world";

const IDLE: Doing = { phase: "idle", activity: null };

/**
 * What a person does at a time. Before the first setting off and after the last activity it is `idle`, without an
 * activity; a time that never came (NaN) is later than every moment.
 */
export function doingAt(person: Person, time: number): Doing {
  const at = lastSetOff(person.activities, time);
  const activity = person.activities[at];
  if (activity === undefined) return IDLE;
  const phase = phaseAt(activity, time);
  return phase === "idle" ? IDLE : { phase, activity };
}

/** The phase of one activity that was set off for before `time`; `idle` once it has ended. */
export function phaseAt(activity: Activity, time: number): Phase {
  if (!(time >= activity.arrive)) return "walk";
  if (!(time >= activity.start)) return "wait";
  return time >= activity.end ? "idle" : "do";
}

/** Index of the last activity whose `leave` is not after `time`, or -1. Those never set off for stand at the end. */
function lastSetOff(activities: readonly Activity[], time: number): number {
  let low = 0;
  let high = activities.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (activities[middle]!.leave <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
