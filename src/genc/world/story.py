"""The story of a person or a group: what they really did, in plain sentences with clock times."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby

from genc.errors import BriefError
from genc.words.vocabulary import Action
from genc.world.happenings import Happening, happenings
from genc.world.phrases import Setting, clock, doing, is_social, names, passing, said_of, span
from genc.world.world import World

_WORTH_TELLING_S = 8.0
"""Shorter waits are not told, and shorter doings are told without their length."""


def tell_agent(world: World, agent: int) -> list[str]:
    """One sentence, headed by its clock time, for each stay of a person at a place.

    Raises:
        BriefError: if the world has no such person.
    """
    _check(agent, len(world.plan.people), "person")
    lines = []
    for k, chapter in enumerate(_chapters(happenings(world, [agent]))):
        clauses = [_clause(world, happening, [agent], opening=j == 0) for j, happening in enumerate(chapter)]
        subject = f"Person {agent} " if k == 0 else ""
        lines.append(f"{clock(_told_s(chapter[0]))} {subject}{', then '.join(clauses)}.")
    return [*lines, *_ending(world, agent)]


def tell_group(world: World, group: int) -> list[str]:
    """The caption and the people of a group, then a sentence for each thing that some of them did together.

    Raises:
        BriefError: if the world has no such group.
    """
    _check(group, 1 + max((person.group for person in world.plan.people), default=-1), "group")
    members, caption = world.plan.members()[group], world.plan.caption(group)
    lines = [f"Group {group}, {names(members, most=15)}" + (f": {caption}" if caption else "")]
    for happening in sorted(happenings(world, members), key=_told_s):
        agents = happening.agents
        told = _clause(world, happening, agents, opening=True)
        lines.append(f"{clock(_told_s(happening))} {names(agents, most=15)} {told}.")
    absent = set(members) - {done.agent for done in world.motion.executed}
    return lines + [_absence(agent) for agent in sorted(absent)]


def _chapters(told: Sequence[Happening]) -> list[list[Happening]]:
    """Runs of doings at one place with the same people, none of them waited for: one sentence each."""

    def chapter(happening: Happening) -> tuple[object, ...]:
        activity = happening.activity
        own = activity.action in (Action.QUEUE, Action.ENTER_EXIT) or _wait(happening) or math.isnan(happening.start_s)
        return activity.location, activity.partners, happening.step if own else None

    return [list(run) for _, run in groupby(told, chapter)]


def _told_s(happening: Happening) -> float:
    """The clock time of a sentence: when the people came, where they waited together; else when it began."""
    return happening.arrive_s if _wait(happening) == "all" else happening.time_s


def _clause(world: World, happening: Happening, subject: Sequence[int], opening: bool) -> str:
    """What happened, said of `subject`; an `opening` names the place."""
    activity = happening.activity
    place = world.plan.environment.locations[activity.location]
    setting = Setting(place, happening.within, named=not opening)
    plural = len(subject) > 1
    if math.isnan(happening.start_s):
        return _unbegun(happening, setting, plural)
    others = [agent for agent in activity.partners if agent not in subject]
    whom = names(others) if others else "each other" if plural else ""
    if activity.action is Action.ENTER_EXIT:
        phrase = passing(place, happening.way)
    else:
        phrase = doing(activity.action, setting, whom)
    text = said_of(phrase, plural)
    if opening and others and not is_social(activity.action):
        text += f" with {names(others)}"
    return _before(happening, setting, plural, others) + text + _length(happening) + _after(happening)


def _unbegun(happening: Happening, setting: Setting, plural: bool) -> str:
    if math.isnan(happening.arrive_s):
        return said_of(f"be on the way to {setting.the} when the world ends", plural)
    return said_of(f"wait {setting.at} until the world ends", plural)


def _wait(happening: Happening) -> str:
    """Who waited for long before it began: "all", "some", or nobody: ""."""
    if happening.activity.action in (Action.QUEUE, Action.WAIT):
        return ""
    waits = [happening.waited_s(agent) >= _WORTH_TELLING_S for agent in happening.agents]
    return "all" if all(waits) else "some" if any(waits) else ""


def _before(happening: Happening, setting: Setting, plural: bool, others: Sequence[int]) -> str:
    """What is to be said of the time between coming and beginning."""
    if _wait(happening) != "all":
        return ""
    waited = f"wait {setting.at} for {span(happening.start_s - happening.arrive_s)}"
    expected = [agent for agent in happening.expected if agent in others]
    if happening.in_vain and others:
        waited = f"{waited} in vain for {names(others)}"
    elif expected:
        waited = f"wait {setting.at} for {names(expected)} ({span(happening.start_s - happening.arrive_s)})"
    return said_of(f"{waited}, then ", plural)


def _after(happening: Happening) -> str:
    """Who had been waiting for the others, where only some had."""
    if _wait(happening) != "some":
        return ""
    early = [agent for agent in happening.agents if happening.waited_s(agent) >= _WORTH_TELLING_S]
    longest_s = max(happening.waited_s(agent) for agent in early)
    return f"; {names(early, most=15)} had waited {span(longest_s)}"


def _length(happening: Happening) -> str:
    action = happening.activity.action
    if action is Action.ENTER_EXIT:
        return ""
    if math.isnan(happening.end_s):
        return " until the world ends"
    since_s = happening.arrive_s if action in (Action.QUEUE, Action.WAIT) else happening.start_s
    length_s = happening.end_s - since_s
    in_vain = " and gives up" if happening.in_vain and action is Action.QUEUE else ""
    return ("" if length_s < _WORTH_TELLING_S else f" for {span(length_s)}") + in_vain


def _ending(world: World, agent: int) -> list[str]:
    """What becomes of a person after the last thing."""
    person = world.plan.people[agent]
    mine = [done for done in world.motion.executed if done.agent == agent]
    if not mine:
        return [_absence(agent)]
    last = mine[-1]
    if person.leaves or last.step < len(person.activities) - 1 or math.isnan(last.end_s):
        return []
    return [f"{clock(last.end_s)} stays there to the end."]


def _absence(agent: int) -> str:
    return f"Person {agent} has not come when the world ends."


def _check(number: int, n: int, what: str) -> None:
    if not 0 <= number < n:
        raise BriefError(f"there is no {what} {number} in this world; they are numbered 0 to {n - 1}")
