"""Counts over a whole world: who is there, what the places see, what is going on at each minute."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np

from genc.motion.motion import Executed, Status
from genc.plan.plan import Activity
from genc.scenario.scenario import Location
from genc.words.vocabulary import Action
from genc.world.phrases import Setting, clock, doing, is_social, passing, said_of, with_article
from genc.world.world import World

_MOST_LISTED = 5


def tell_people(world: World) -> str:
    """How many people there are, and how they come and go."""
    plan, motion = world.plan, world.motion
    n_first = int(np.count_nonzero(motion.present[0]))
    n_never = len(plan.people) - int(np.count_nonzero(np.any(motion.present, axis=0)))
    n_gone = sum(person.leaves and _is_done(last) for person, last in zip(plan.people, _last_done(world), strict=True))
    n_come = len(plan.people) - n_first - n_never
    n_groups = len({person.group for person in plan.people})
    late = f", {n_never} would come later" if n_never else ""
    return (
        f"{len(plan.people)} people in {n_groups} groups, {len(plan.environment.locations)} places,"
        f" {clock(plan.duration_s)} minutes: {n_first} are there from the beginning, {n_come} come in{late};"
        f" {n_gone} have left by the end."
    )


def tell_places(world: World) -> list[str]:
    """For each place that somebody comes to, how many do, and what they do there most; the busiest first."""
    comers: dict[int, set[int]] = {}
    doings: dict[int, Counter[Action]] = {}
    for done in world.motion.executed:
        activity = _activity(world, done)
        if not math.isnan(done.start_s):
            comers.setdefault(activity.location, set()).add(done.agent)
            doings.setdefault(activity.location, Counter())[activity.action] += 1
    busiest = sorted(comers, key=lambda place: (-len(comers[place]), place))
    counts = {i: f"{len(comers[i])} {'person' if len(comers[i]) == 1 else 'people'}" for i in busiest}
    return [f"{_name(world, i)}: {counts[i]} ({_listed(doings[i])})" for i in busiest]


def tell_minutes(world: World) -> list[str]:
    """What is going on at the beginning of each minute."""
    n_minutes = int(world.plan.duration_s // 60) + 1
    return [_moment(world, 60.0 * minute) for minute in range(n_minutes)]


def tell_status(world: World) -> str:
    """How much of what was set off for came to its end."""
    count = Counter(done.status for done in world.motion.executed)
    return (
        f"{count[Status.DONE]} doings were done, {count[Status.CUT]} were cut by the end of the world,"
        f" in {count[Status.TIMEOUT]} somebody or a free place was waited for in vain."
    )


def _moment(world: World, time_s: float) -> str:
    motion = world.motion
    frame = min(round(time_s / motion.dt_s), len(motion.present) - 1)
    there = set(np.flatnonzero(motion.present[frame]).tolist())
    going_on: Counter[tuple[Action, int]] = Counter()
    busy: set[int] = set()
    for done in motion.executed:
        if done.agent in there and done.start_s <= time_s and not done.end_s <= time_s:
            activity = _activity(world, done)
            going_on[activity.action, activity.location] += 1
            busy.add(done.agent)
    ordered = sorted(going_on.items(), key=lambda item: (-item[1], item[0]))
    told = [f"{n} {_told(action, world.plan.environment.locations[i], n)}" for (action, i), n in ordered[:_MOST_LISTED]]
    steps_m = np.abs(np.diff(motion.positions_m[[max(frame - 1, 0), frame]], axis=0)).sum(axis=(0, 2))
    idle = there - busy
    finished = {agent for agent, last in enumerate(_last_done(world)) if last is not None and last.end_s <= time_s}
    under_way = {agent for agent in idle - finished if steps_m[agent] > 0}
    counts = {
        "do something else": sum(n for _, n in ordered[_MOST_LISTED:]),
        "be on the way": len(under_way),
        "wait": len(idle - finished - under_way),
        "stay on": len(idle & finished),
    }
    told += [f"{n} {said_of(what, n > 1)}" for what, n in counts.items() if n]
    return f"{clock(time_s)} {len(there)} people are there" + (f": {', '.join(told)}." if told else ".")


def _told(action: Action, place: Location, n: int) -> str:
    if action is Action.ENTER_EXIT:
        return said_of(passing(place, "through"), n > 1)
    return said_of(
        doing(action, Setting(place, within=True), "each other" if is_social(action) and n > 1 else ""), n > 1
    )


def _listed(doings: Counter[Action]) -> str:
    ordered = sorted(doings.items(), key=lambda item: (-item[1], item[0]))
    return ", ".join(f"{action} {n}" for action, n in ordered[:_MOST_LISTED])


def _activity(world: World, done: Executed) -> Activity:
    return world.plan.people[done.agent].activities[done.step]


def _name(world: World, location: int) -> str:
    return with_article(world.plan.environment.locations[location].name)


def _last_done(world: World) -> list[Executed | None]:
    last: list[Executed | None] = [None] * len(world.plan.people)
    for done in world.motion.executed:
        if done.step == len(world.plan.people[done.agent].activities) - 1:
            last[done.agent] = done
    return last


def _is_done(last: Executed | None) -> bool:
    return last is not None and not math.isnan(last.end_s)
