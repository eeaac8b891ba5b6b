"""When people come, and how they take their time: an outline of the day, before seats and queues are known.

A world is a stretch of time in the life of a place, so some are in the middle of things when it begins: the longer a
group's life is beside the world's, the likelier. Nobody is sent in, or hurries, just to wait for the others.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from genc.plan.occasion import Occasion
from genc.words.vocabulary import Action

SPEED_MPS = 1.3
LEAST_SPREAD = 0.2
"""The part of the world's length over which people come in at least, however long they stay."""
_SOON_S = 30.0
"""Who is there from the beginning has something to do by then; all others come in when it is time."""


@dataclass(frozen=True)
class Cast:
    """What is to be scheduled: occasions, the location index of each, and for an event the one it waits for."""

    occasions: Sequence[Occasion]
    locations: Sequence[int]
    triggers: Mapping[int, int]

    @cached_property
    def awaited(self) -> frozenset[int]:
        """The occasions with which an event ends that another waits for: they must not be drawn out later."""
        events = set(self.triggers.values())
        return frozenset(o.number for o in self.occasions if o.is_last and o.event in events)


@dataclass(frozen=True)
class Timetable:
    """What an outline settles.

    Attributes:
        comes_s: for each person, when they come in; None for who is there from the beginning.
        lasts_s: how long each occasion takes; drawn out where people would only wait for others afterwards.
    """

    comes_s: Sequence[float | None]
    lasts_s: Sequence[float]


@dataclass(frozen=True, eq=False)
class Outline:
    """About what happens when.

    Attributes:
        cast: what happens.
        lasts_s: how long each occasion takes by itself.
        stretch_s: by how much each may be drawn out.
        way_m: `[n_locations, n_locations]` metres from door to door.
    """

    cast: Cast
    lasts_s: Sequence[float]
    stretch_s: Sequence[float]
    way_m: NDArray[np.float64]

    def timetable(self, duration_s: float, staff: Collection[int], rng: np.random.Generator) -> Timetable:
        """Who comes when, and how long everything takes.

        Args:
            duration_s: length of the world.
            staff: people who work there, and are there from the beginning.
            rng: draws which groups are there already, and when the others come.
        """
        comes_s, is_there = self._groups(duration_s, staff, rng)
        begins_s, ends_s = self._latest(self._earliest(comes_s, self.cast.triggers))
        arrivals_s = [
            None if agent in staff or (is_there[first.group] and begins_s[first.number] < _SOON_S) else begins_s[number]
            for agent, first in self._firsts.items()
            for number in [first.number]
        ]
        return Timetable(arrivals_s, self._drawn_out(begins_s, ends_s))

    def _groups(
        self, duration_s: float, staff: Collection[int], rng: np.random.Generator
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """When each group comes, and whether it is there from the beginning."""
        life_s = np.zeros(self.cast.occasions[-1].group + 1)
        for occasion, begin_s in zip(self.cast.occasions, self._earliest(life_s.copy(), {}), strict=True):
            life_s[occasion.group] = max(life_s[occasion.group], begin_s + self.lasts_s[occasion.number])
        is_there = rng.random(len(life_s)) * duration_s < life_s
        is_there[[first.group for first in self._firsts.values() if first.action is Action.ENTER_EXIT]] = False
        is_there[[self._firsts[agent].group for agent in staff]] = True
        latest_s = np.maximum(duration_s - life_s, LEAST_SPREAD * duration_s)
        comes_s = np.where(is_there, 0.0, rng.random(len(life_s)) * latest_s)
        return (comes_s if is_there.any() else comes_s - comes_s.min()), is_there

    def _earliest(self, comes_s: NDArray[np.float64], triggers: Mapping[int, int]) -> list[float]:
        """When each occasion can begin, if groups come then and nobody has to queue."""
        begins_s, ends_s = [0.0] * len(self.lasts_s), [0.0] * len(self.lasts_s)
        before: dict[int, int] = {}
        event_end_s: dict[int, float] = {}
        for occasion in self._in_order:
            number = occasion.number
            last = [before[agent] for agent in occasion.agents if agent in before]
            ready_s = [ends_s[n] + self._walk_s(n, number) for n in last]
            if occasion.is_first and occasion.event in triggers:
                ready_s.append(event_end_s.get(triggers[occasion.event], 0.0))
            begins_s[number] = max([float(comes_s[occasion.group]), *ready_s])
            ends_s[number] = event_end_s[occasion.event] = begins_s[number] + self.lasts_s[number]
            before.update(dict.fromkeys(occasion.agents, number))
        return begins_s

    def _latest(self, earliest_s: Sequence[float]) -> tuple[list[float], list[float]]:
        """When each occasion can begin, and has to end, so that nothing that follows is later than it has to be."""
        begins_s = list(earliest_s)
        ends_s = [begin_s + lasts_s for begin_s, lasts_s in zip(earliest_s, self.lasts_s, strict=True)]
        after: dict[int, int] = {}
        awaited_s: dict[int, float] = {}
        for occasion in reversed(self._in_order):
            number = occasion.number
            following = [after[agent] for agent in occasion.agents if agent in after]
            must_end_s = [begins_s[n] - self._walk_s(number, n) for n in following]
            if occasion.is_last and occasion.event in awaited_s:
                must_end_s.append(awaited_s[occasion.event])
            if must_end_s:
                ends_s[number] = max(min(must_end_s), ends_s[number])
                begins_s[number] = ends_s[number] - self.lasts_s[number]
            after.update(dict.fromkeys(occasion.agents, number))
            trigger = self.cast.triggers.get(occasion.event)
            if occasion.is_first and trigger is not None:
                awaited_s[trigger] = min(awaited_s.get(trigger, begins_s[number]), begins_s[number])
        return begins_s, ends_s

    def _drawn_out(self, latest_s: Sequence[float], must_end_s: Sequence[float]) -> list[float]:
        """How long each occasion takes, if those of its people who have time take it at the first opportunity."""
        lasts_s = list(self.lasts_s)
        ends_s: list[float] = [0.0] * len(lasts_s)
        before: dict[int, int] = {}
        for occasion in self._in_order:
            number = occasion.number
            last = [before[agent] for agent in occasion.agents if agent in before]
            # who begins here comes as late as may be; so does everybody whom a trigger holds back
            begin_s = max((ends_s[n] + self._walk_s(n, number) for n in last), default=latest_s[number])
            spare_s = max(0.0, must_end_s[number] - begin_s - lasts_s[number])
            if not (occasion.is_first and occasion.event in self.cast.triggers):
                lasts_s[number] += min(spare_s, self.stretch_s[number])
            ends_s[number] = begin_s + lasts_s[number]
            before.update(dict.fromkeys(occasion.agents, number))
        return lasts_s

    @cached_property
    def _firsts(self) -> dict[int, Occasion]:
        """The first occasion of each person."""
        firsts: dict[int, Occasion] = {}
        for occasion in self._in_order:
            for agent in occasion.agents:
                firsts.setdefault(agent, occasion)
        return dict(sorted(firsts.items()))

    @cached_property
    def _in_order(self) -> list[Occasion]:
        """Every occasion after those of the same people, and after the event that its own event waits for."""
        return sorted(self.cast.occasions, key=lambda occasion: (occasion.event, occasion.number))

    def _walk_s(self, number: int, following: int) -> float:
        return float(self.way_m[self.cast.locations[number], self.cast.locations[following]]) / SPEED_MPS
