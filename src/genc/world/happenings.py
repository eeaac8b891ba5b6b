"""Happenings: what people did, occasion by occasion, in order of time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from genc.motion.motion import Executed, Status
from genc.plan.plan import Activity
from genc.world.world import World


@dataclass(frozen=True)
class Happening:
    """One occasion, as far as it happened to some people.

    Attributes:
        activity: what was planned, as of the first of them.
        step: which of the first person's activities it is.
        done: one entry for each of them, ascending by agent.
        stay: where in a stay it comes; see `phrases.passing`.
        expected: the partners who came last, so that the others had to wait for them.
    """

    activity: Activity
    step: int
    done: tuple[Executed, ...]
    stay: str
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
        found.append(Happening(activity, first.step, tuple(rows), _stay(world, first), expected))
    return sorted(found, key=lambda happening: (happening.time_s, happening.done[0].leave_s, happening.agents))


_AT_ONCE_S = 1.0


def _last_to_come(arrivals_s: dict[int, float], start_s: float) -> tuple[int, ...]:
    """Whose arrival let the occasion begin; nobody, if it began later than that."""
    return tuple(agent for agent, arrive_s in arrivals_s.items() if 0 <= start_s - arrive_s <= _AT_ONCE_S)


def _stay(world: World, done: Executed) -> str:
    person = world.plan.people[done.agent]
    if done.step == 0:
        return "first"
    if done.step == len(person.activities) - 1 and person.leaves:
        return "last"
    here = person.activities[done.step].location
    return "again" if person.activities[done.step - 1].location == here else "between"
