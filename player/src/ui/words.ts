/** English for clock times, and for what people do. */

import { doingAt } from "../world/doing";
import type { Action, Activity, Category, Doing, Location, World } from "../world/world";

const GROUND: readonly Category[] = ["room", "building", "outdoor area"];
const ENCLOSED: readonly Category[] = ["room", "building"];
const READABLE: readonly Category[] = ["item", "entrance", "exhibit"];

/** A moment as minutes and seconds, "02:45"; "--:--" for one that never came. */
export function clock(time: number): string {
  if (Number.isNaN(time)) return "--:--";
  const seconds = Math.floor(time + 1e-6);
  return `${pad(Math.floor(seconds / 60))}:${pad(seconds % 60)}`;
}

/** A length of time, "40 s" or "2:05 min". */
export function span(seconds: number): string {
  const whole = Math.round(seconds);
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)}:${pad(whole % 60)} min`;
}

/** "1 person", "1,000 people". */
export function counted(n: number, one: string, many: string): string {
  return `${n.toLocaleString("en")} ${n === 1 ? one : many}`;
}

/** "Person 3", "Persons 3 and 4", "Persons 3, 4 and 6 others". */
export function persons(agents: readonly number[]): string {
  if (agents.length === 1) return `Person ${agents[0]}`;
  const shown =
    agents.length <= 3 ? agents.map(String) : [...agents.slice(0, 2).map(String), `${agents.length - 2} others`];
  return `Persons ${shown.slice(0, -1).join(", ")} and ${shown.at(-1)}`;
}

/** "the pizza van", but "platform 2" and "Hall B". */
export function withArticle(name: string): string {
  const last = name.split(" ").at(-1) ?? "";
  const proper = /^\p{Lu}/u.test(name) || /\d/.test(last) || (last.length === 1 && name.includes(" "));
  return proper || /^(the|a|an) /.test(name) ? name : `the ${name}`;
}

/** What a person is doing, as the rest of a sentence that begins with the person: "waits at the kiosk for Person 4". */
export function tellDoing(world: World, agent: number, doing: Doing, time: number): string {
  const { phase, activity } = doing;
  if (phase === "idle" || activity === null) return tellIdle(world, agent, time);
  const place = world.locations[activity.location]!;
  if (phase === "walk") return `walks to ${withArticle(place.name)}`;
  if (phase === "wait") return tellWait(world, activity, place, time);
  if (!isPresent(world, agent, time)) return `is inside ${withArticle(place.name)}`;
  return tellAction(activity, place);
}

/** Whether a person is in sight at a time. */
export function isPresent(world: World, agent: number, time: number): boolean {
  const { dt, nFrames, nAgents, present } = world.frames;
  const frame = Math.max(0, Math.min(Math.round(time / dt), nFrames - 1));
  return present[frame * nAgents + agent] === 1;
}

/** The same where the place is known already: "waits for Person 4", "sits with Person 2". */
export function tellThere(world: World, doing: Doing, time: number): string {
  const { phase, activity } = doing;
  if (activity === null || phase === "idle" || phase === "walk") return "";
  if (phase === "do")
    return activity.action + (activity.partners.length > 0 ? ` with ${persons(activity.partners)}` : "");
  const missing = activity.partners.filter((partner) => !hasCome(world, partner, activity.occasion, time));
  return missing.length > 0 ? `waits for ${persons(missing)}` : "waits";
}

function tellIdle(world: World, agent: number, time: number): string {
  const first = world.people[agent]?.activities[0];
  if (first === undefined) return "has no plan";
  if (!(time >= first.leave)) return Number.isNaN(first.leave) ? "does not come" : `comes at ${clock(first.leave)}`;
  return isPresent(world, agent, time) ? "stays, the plan being done" : "has left";
}

function tellWait(world: World, activity: Activity, place: Location, time: number): string {
  const missing = activity.partners.filter((partner) => !hasCome(world, partner, activity.occasion, time));
  const where = `waits ${at(place)}`;
  if (missing.length > 0) return `${where} for ${persons(missing)}`;
  return place.category === "service area" && activity.partners.length === 0 ? `waits in line ${at(place)}` : where;
}

function hasCome(world: World, agent: number, occasion: number, time: number): boolean {
  const own = world.people[agent]?.activities.find((activity) => activity.occasion === occasion);
  return own === undefined || own.arrive <= time;
}

function tellAction(activity: Activity, place: Location): string {
  const told = SOCIAL[activity.action]?.(activity.partners) ?? null;
  if (told !== null) return `${told} ${at(place)}`;
  const plain = PLAIN[activity.action as keyof typeof PLAIN](place);
  return activity.partners.length > 0 ? `${plain} with ${persons(activity.partners)}` : plain;
}

const SOCIAL: Partial<Record<Action, (partners: readonly number[]) => string>> = {
  discuss: (partners) => `talks ${partners.length > 0 ? `with ${persons(partners)}` : "to somebody"}`,
  meet: (partners) => `meets ${partners.length > 0 ? persons(partners) : "somebody"}`,
  "wave at": (partners) => `waves to ${partners.length > 0 ? persons(partners) : "somebody"}`,
};

const PLAIN: Record<Exclude<Action, "discuss" | "meet" | "wave at">, (place: Location) => string> = {
  wait: (place) => `waits ${at(place)}`,
  sit: (place) => `sits ${at(place)}`,
  wander: (place) => `wanders ${isGround(place) ? "about" : "around"} ${withArticle(place.name)}`,
  queue: (place) => `stands in line ${at(place)}`,
  "enter/exit": (place) => `goes ${isGround(place) ? "into" : "through"} ${withArticle(place.name)}`,
  "object interact": (place) => (isGround(place) ? `is busy ${at(place)}` : `uses ${withArticle(place.name)}`),
  "talk on phone": (place) => `talks on the phone ${at(place)}`,
  read: (place) => (READABLE.includes(place.category) ? `reads ${withArticle(place.name)}` : `reads ${at(place)}`),
  "look at": (place) => (isGround(place) ? `looks around ${at(place)}` : `looks at ${withArticle(place.name)}`),
  carry: (place) => `carries something ${isGround(place) ? "about" : "to"} ${withArticle(place.name)}`,
};

function at(place: Location): string {
  return `${ENCLOSED.includes(place.category) ? "in" : "at"} ${withArticle(place.name)}`;
}

function isGround(place: Location): boolean {
  return GROUND.includes(place.category);
}

/** What a person does at a time, in words. */
export function tellNow(world: World, agent: number, time: number): string {
  return tellDoing(world, agent, doingAt(world.people[agent]!, time), time);
}

function pad(n: number): string {
  return String(n).padStart(2, "0");
}
