"""Happenings: what people did, occasion by occasion, in order of time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from genc.motion.motion import Executed, Status
from genc.plan.plan import Activity
from genc.words.vocabulary import Category
from genc.world.world import World

_AT_ONCE_S = 1.0


@dataclass(frozen=True)
class Happening:
    """One occasion, as far as it happened to some people.

    Attributes:
        activity: what was planned, as of the first of them.
        step: which of the first person's activities it is.
        done: one entry for each of them, ascending by agent.
        way: if it is a coming or going, which; see `phrases.passing`.
        within: whether the first of them was in the place, as opposed to beside it.
        expected: the partners who came last, so that the others had to wait for them.
    """

    activity: Activity
    step: int
    done: tuple[Executed, ...]
    way: str
    within: bool
    expected: tuple[int, ...]

    @property
    def agents(self) -> list[int]:
        """Whose happening it is."""
        return [one.agent for one in self.done]

    @property
    def arrive_s(self) -> float:
        """When the first of them got there; NaN if nobody has."""
        return min((one.arrive_s for one in self.done if not math.isnan(one.arrive_s)), default=math.nan)

    @property
    def start_s(self) -> float:
        """When it began; NaN if it did not."""
        return min((one.start_s for one in self.done if not math.isnan(one.start_s)), default=math.nan)

    @property
    def end_s(self) -> float:
        """When it ended; NaN if the end of the world came first."""
        return self.done[0].end_s

    @property
    def time_s(self) -> float:
        """When it has to be told: when it began, or else when they came, or set off."""
        moments = (self.start_s, self.arrive_s, min(one.leave_s for one in self.done))
        return next(moment_s for moment_s in moments if not math.isnan(moment_s))

    @property
    def in_vain(self) -> bool:
        """Whether somebody was waited for who did not come in time."""
        return any(one.status is Status.TIMEOUT for one in self.done)

    def waited_s(self, agent: int) -> float:
        """How long one of them stood there before it began."""
        return next(one.start_s - one.arrive_s for one in self.done if one.agent == agent)


def happenings(world: World, agents: Sequence[int]) -> list[Happening]:
    """What happened to these people, in order of time; what they did together is one."""
    people = world.plan.people
    wanted = set(agents)
    together: dict[int, list[Executed]] = {}
    arrivals_s: dict[int, dict[int, float]] = {}
    for done in world.motion.executed:
        occasion = people[done.agent].activities[done.step].occasion
        arrivals_s.setdefault(occasion, {})[done.agent] = done.arrive_s
        if done.agent in wanted:
            together.setdefault(occasion, []).append(done)
    found = []
    for occasion, rows in together.items():
        first = rows[0]
        activity = people[first.agent].activities[first.step]
        expected = _last_to_come(arrivals_s[occasion], first.start_s)
        way, within = _way(world, first), _is_within(world, first)
        found.append(Happening(activity, first.step, tuple(rows), way, within, expected))
    return sorted(found, key=lambda happening: (happening.time_s, happening.done[0].leave_s, happening.agents))


def _last_to_come(arrivals_s: dict[int, float], start_s: float) -> tuple[int, ...]:
    """Whose arrival let the occasion begin; nobody, if it began later than that."""
    return tuple(agent for agent, arrive_s in arrivals_s.items() if 0 <= start_s - arrive_s <= _AT_ONCE_S)


def _way(world: World, done: Executed) -> str:
    person = world.plan.people[done.agent]
    here = [activity.location for activity in person.activities]
    at_entrance = world.plan.environment.locations[here[done.step]].category is Category.ENTRANCE
    if _is_hidden(world, done):
        return "in"
    if done.step == 0:
        return "first" if at_entrance or here[:2] != here[:1] * 2 else "in"
    if done.step == len(here) - 1 and person.leaves:
        return "last"
    return "out" if here[done.step - 1] == here[done.step] else "through"


def _is_within(world: World, done: Executed) -> bool:
    location = world.plan.environment.locations[world.plan.people[done.agent].activities[done.step].location]
    sides = zip(done.position_m, location.position_m, location.size_m, strict=True)
    return _is_hidden(world, done) or all(abs(at_m - centre_m) <= size_m / 2 for at_m, centre_m, size_m in sides)


def _is_hidden(world: World, done: Executed) -> bool:
    """Whether somebody is out of sight, in a building, when a doing begins."""
    if math.isnan(done.start_s):
        return False
    frame = min(math.ceil(done.start_s / world.motion.dt_s - 1e-6), len(world.motion.present) - 1)
    return not world.motion.present[frame, done.agent]
