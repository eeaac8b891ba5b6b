"""When: a discrete-event run over occasions, in order of arrival.

An occasion begins when all its people have arrived and, at a service, when it is their turn. Who would be early at a
meeting stays longer at what they did before, so that expected arrivals agree; who is late is waited for.
"""

from __future__ import annotations

import heapq
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from genc.plan.arrivals import Cast, Outline
from genc.plan.hosting import TO_EACH_OTHER, Hosting
from genc.plan.life import Life
from genc.plan.occasion import Occasion, rows_of
from genc.plan.plan import ON_THE_WAY, Activity, Person, Slot
from genc.plan.seating import Seat, Seating
from genc.scenario.durations import sample_durations
from genc.words.vocabulary import ACTION_INDEX, CATEGORY_INDEX, Action

MOST_STRETCH_S = 240.0
"""Longest time by which a doing is drawn out to meet others on time."""
WORTH_A_MENTION_S = 20.0
"""Who stays behind for longer than this goes on with what they all did."""
PASSAGE_S = 2.0
"""Time to pass an entrance, where no step asked for it."""

_ELASTIC = (
    Action.WAIT,
    Action.SIT,
    Action.WANDER,
    Action.DISCUSS,
    Action.TALK_ON_PHONE,
    Action.READ,
    Action.LOOK_AT,
    Action.OBJECT_INTERACT,
)
"""Doings that last as long as there is time."""


def schedule(cast: Cast, seating: Seating, duration_s: float, rng: np.random.Generator) -> tuple[Person, ...]:
    """Everybody with a timed row of activities in a world of that length."""
    return _Run(cast, seating, duration_s, rng).people()


class _Run:
    def __init__(self, cast: Cast, seating: Seating, duration_s: float, rng: np.random.Generator) -> None:
        self.occasions, self.location, self.triggers = cast.occasions, cast.locations, cast.triggers
        self.seating, self.world_s, self.rng, self.awaited = seating, duration_s, rng, cast.awaited
        self.venue = seating.venue
        actions = np.array([ACTION_INDEX[o.action] for o in self.occasions])
        categories = np.array([CATEGORY_INDEX[o.category] for o in self.occasions])
        self.lasts_s: list[float] = sample_durations(actions, categories, rng).tolist()
        self.lives = self._lives()
        self.hosting = Hosting(cast, self.lives, self.lasts_s, seating, rng)
        self.event_end_s: dict[int, float] = {}
        self.on_hold: dict[int, list[int]] = {}
        """For an event that has not ended, the occasions that wait for it."""
        self.heap: list[tuple[float, int]] = []
        self.n_occasions = len(self.occasions)

    def people(self) -> tuple[Person, ...]:
        for number in dict.fromkeys(life.row[0] for life in self.lives):
            self._offer(number)
        while self.heap:
            ready_s, number = heapq.heappop(self.heap)
            self._hold(self.occasions[number], ready_s)
        self._close()
        return tuple(Person(life.group, life.speed_mps, tuple(life.activities), life.leaves) for life in self.lives)

    def _lives(self) -> list[Life]:
        rows = rows_of(self.occasions)
        stretch_s = [MOST_STRETCH_S * self._is_elastic(o.action, o.number) for o in self.occasions]
        cast = Cast(self.occasions, self.location, self.triggers)
        outline = Outline(cast, self.lasts_s, stretch_s, self.venue.ways_m)
        staff = self._staff(rows)
        timetable = outline.timetable(self.world_s, staff, self.rng)
        self.lasts_s = list(timetable.lasts_s)
        groups = [self.occasions[rows[agent][0]].group for agent in range(len(rows))]
        speeds_mps = np.clip(self.rng.normal(1.3, 0.2, size=groups[-1] + 1), 0.8, 1.8).tolist()
        return [
            Life(group, comes_s, speeds_mps[group], rows[agent], staff.get(agent))
            for agent, (group, comes_s) in enumerate(zip(groups, timetable.comes_s, strict=True))
        ]

    def _is_elastic(self, action: Action, number: int) -> bool:
        """Whether a doing lasts as long as there is time; nobody takes a counter for longer than they need it."""
        return action in _ELASTIC and not (
            action is Action.OBJECT_INTERACT and self.venue.serves(self.location[number])
        )

    def _staff(self, rows: Mapping[int, Sequence[int]]) -> dict[int, int]:
        """Who works at which service: from the beginning, for at least half of their doings; no more than it holds."""
        staff: dict[int, int] = {}
        n_at_work: Counter[int] = Counter()
        for agent in range(len(rows)):
            first = self.occasions[rows[agent][0]]
            place = self.location[first.number]
            n_there = sum(self.location[number] == place for number in rows[agent])
            begins_at_work = self.venue.serves(place) and first.action not in (Action.QUEUE, Action.ENTER_EXIT)
            n_wanted = max(2, len(self.venue.places[place].service))
            if begins_at_work and 2 * n_there >= len(rows[agent]) and n_at_work[place] < n_wanted:
                staff[agent] = place
                n_at_work[place] += 1
        return staff

    # From offered to held.

    def _offer(self, number: int | None) -> None:
        """Puts an occasion on the heap once it is next for all its people and its trigger has ended."""
        if number is None:
            return
        occasion = self.occasions[number]
        if any(self.lives[agent].next() != number for agent in occasion.agents):
            return
        trigger = self._trigger(occasion)
        if trigger is not None and trigger not in self.event_end_s:
            self.on_hold.setdefault(trigger, []).append(number)
            return
        door = self.venue.places[self.location[number]].door
        ready_s = max(self._ready_s(self.lives[agent], occasion, door) for agent in occasion.agents)
        heapq.heappush(self.heap, (max(ready_s, self._trigger_s(occasion)), number))

    def _trigger(self, occasion: Occasion) -> int | None:
        return self.triggers.get(occasion.event) if occasion.is_first else None

    def _trigger_s(self, occasion: Occasion) -> float:
        trigger = self._trigger(occasion)
        return 0.0 if trigger is None else self.event_end_s[trigger]

    def _ready_s(self, life: Life, occasion: Occasion, door: Slot) -> float:
        """About when somebody can be there; which slot they will have is not known yet."""
        if life.location == self.location[occasion.number]:
            return life.end_s
        return self._arrive_s(life, occasion, door, self.venue.gate(door)[1])

    def _arrive_s(self, life: Life, occasion: Occasion, slot: Slot, gate: Slot) -> float:
        """When somebody can be at a slot; by way of the gate, if they have to come in first."""
        if life.seat is not None:
            return life.end_s + self._walk_s(life, life.seat.slot, slot)
        if self._must_come(life, occasion):
            return life.end_s + PASSAGE_S + self._walk_s(life, gate, slot)
        return life.end_s

    def _walk_s(self, life: Life, start: Slot, end: Slot) -> float:
        return self.venue.way_m(start, end) / life.speed_mps

    def _hold(self, occasion: Occasion, ready_s: float) -> None:
        """Finds slots and times of an occasion, and adds it to the rows of its people."""
        lives = [self.lives[agent] for agent in occasion.agents]
        seats = self.hosting.seats(occasion, lives, ready_s)
        entrance, door = self.venue.gate(seats[0].slot)
        coming = [i for i, life in enumerate(lives) if self._must_come(life, occasion)]
        doors = dict(zip(coming, self.hosting.passage(entrance, len(coming)), strict=True))
        arrive_s = max(
            self._arrive_s(life, occasion, seat.slot, doors[i].slot if i in doors else door)
            for i, (life, seat) in enumerate(zip(lives, seats, strict=True))
        )
        if self._is_on_the_way(occasion, lives):
            start_s = lives[0].end_s
            end_s = max(start_s + self.lasts_s[occasion.number], arrive_s)
        else:
            start_s, end_s = self.hosting.span(occasion, lives, seats, max(arrive_s, self._trigger_s(occasion)))
        self._draw_out(occasion, seats, start_s)
        if doors:
            slots = [seats[i].slot for i in doors]
            self._come([occasion.agents[i] for i in doors], (entrance, list(doors.values())), slots, start_s)
        for agent, life, seat in zip(occasion.agents, lives, seats, strict=True):
            partners = tuple(other for other in occasion.agents if other != agent)
            self._add(life, occasion, seat, start_s, end_s, partners)
        if occasion.is_last:
            self.event_end_s[occasion.event] = end_s
            for number in self.on_hold.pop(occasion.event, ()):
                self._offer(number)
        for following in dict.fromkeys(life.next() for life in lives):
            self._offer(following)

    def _is_on_the_way(self, occasion: Occasion, lives: Sequence[Life]) -> bool:
        """Whether people can begin as soon as they set off: all come from one doing, and nothing else is waited for."""
        before = {life.activities[-1].occasion if life.seat is not None and life.activities else None for life in lives}
        return (
            occasion.action in ON_THE_WAY
            and len(before) == 1
            and None not in before
            and lives[0].location != self.location[occasion.number]
            and lives[0].end_s >= self._trigger_s(occasion)
        )

    def _add(
        self, life: Life, occasion: Occasion, seat: Seat, start_s: float, end_s: float, partners: tuple[int, ...]
    ) -> None:
        appears = not life.activities
        # who comes in is not seen before; who is there from the beginning waits in sight
        leave_s = (0.0 if life.comes_s is None else start_s) if appears else life.end_s
        location = self.location[occasion.number]
        times_s = leave_s, start_s, end_s
        life.add(Activity(occasion.action, location, seat.slot, *times_s, occasion.number, partners), seat)
        life.n_done += 1

    # Coming, going, and the time between.

    def _must_come(self, life: Life, occasion: Occasion) -> bool:
        """Whether somebody has to come in first, though no step of theirs says so."""
        return (
            life.seat is None
            and life.comes_s is not None
            and not self.venue.is_passage(occasion.action, self.location[occasion.number])
        )

    def _come(
        self, agents: Sequence[int], where: tuple[int, Sequence[Seat]], slots: Sequence[Slot], start_s: float
    ) -> None:
        """Lets people come in together, just in time for their first doing."""
        ways = zip(agents, where[1], slots, strict=True)
        walk_s = max(self._walk_s(self.lives[agent], door.slot, slot) for agent, door, slot in ways)
        self._imply(agents, Action.ENTER_EXIT, where, max(0.0, start_s - walk_s - PASSAGE_S), PASSAGE_S)

    def _imply(
        self,
        agents: Sequence[int],
        action: Action,
        where: tuple[int, Sequence[Seat]],
        start_s: float,
        lasts_s: float,
    ) -> None:
        """Adds an activity that no step asked for."""
        location, seats = where
        for agent, seat in zip(agents, seats, strict=True):
            life, partners = self.lives[agent], tuple(sorted(other for other in agents if other != agent))
            times_s = life.end_s if life.activities else start_s, start_s, start_s + lasts_s
            life.add(Activity(action, location, seat.slot, *times_s, self.n_occasions, partners, implied=True), seat)
        self.n_occasions += 1

    def _draw_out(self, occasion: Occasion, seats: Sequence[Seat], start_s: float) -> None:
        """Draws out what people did before, where it lasts as long as there is time, until they need to go."""
        must_go_s: dict[int, dict[int, float]] = {}
        for agent, seat in zip(occasion.agents, seats, strict=True):
            life = self.lives[agent]
            if life.activities and life.seat is not None:
                go_s = start_s - self._walk_s(life, life.seat.slot, seat.slot)
                must_go_s.setdefault(life.activities[-1].occasion, {})[agent] = go_s
        for together in must_go_s.values():
            last = self.lives[min(together)].activities[-1]
            end_s = min(last.end_s + MOST_STRETCH_S, *together.values(), math.inf)
            if end_s <= last.end_s or not self._is_stretchable(last):
                continue
            if len(together) == 1 + len(last.partners) and last.occasion not in self.awaited:
                for agent in together:
                    self.lives[agent].activities[-1] = replace(self.lives[agent].activities[-1], end_s=end_s)
            elif end_s > last.end_s + WORTH_A_MENTION_S:
                self._stay_on(sorted(together), end_s)

    def _stay_on(self, agents: Sequence[int], end_s: float) -> None:
        """Lets people go on for a while with what they did, without those who have gone."""
        for agent in agents:
            row = self.lives[agent].activities
            last, others = row[-1], tuple(other for other in agents if other != agent)
            action = Action.WAIT if last.action in TO_EACH_OTHER and not others else last.action
            row.append(
                Activity(
                    action, last.location, last.slot, last.end_s, last.end_s, end_s, self.n_occasions, others, True
                )
            )
        self.n_occasions += 1

    def _close(self) -> None:
        """Lets people stay at what they do last, if the world ends soon, or work on; sends the others home."""
        together: dict[int, list[int]] = {}
        for agent, life in enumerate(self.lives):
            last = life.activities[-1]
            if self.venue.is_passage(last.action, last.location):
                life.leaves = True
            elif last.end_s < self.world_s and life.workplace is not None:
                self._work_on(agent, life.workplace)
            elif last.end_s < self.world_s:
                together.setdefault(last.occasion, []).append(agent)
        lingering = [agents for agents in together.values() if self._lingers(agents)]
        for agents in lingering:
            for agent in agents:
                row = self.lives[agent].activities
                row[-1] = replace(row[-1], end_s=self.world_s)
        for agents in together.values():
            if agents not in lingering:
                self._go_home(agents)

    def _go_home(self, agents: Sequence[int]) -> None:
        """Lets people who did the last thing together leave together, if there is time."""
        lasts = [self.lives[agent].activities[-1] for agent in agents]
        entrance, _ = self.venue.gate(lasts[0].slot)
        seats = self.hosting.passage(entrance, len(agents))
        lives = [self.lives[agent] for agent in agents]
        ways = zip(lives, lasts, seats, strict=True)
        there_s = lasts[0].end_s + max(self._walk_s(life, last.slot, seat.slot) for life, last, seat in ways)
        if there_s < self.world_s:
            self._imply(agents, Action.ENTER_EXIT, (entrance, seats), there_s, PASSAGE_S)
            for life in lives:
                life.leaves = True

    def _work_on(self, agent: int, workplace: int) -> None:
        """Lets staff who have done what was asked of them go on with their work to the end."""
        life = self.lives[agent]
        end_s, seat = life.end_s, life.seat
        if seat is None or life.location != workplace:
            seat = self.seating.near(workplace, self.venue.behind(workplace), end_s)
        back_s = end_s + self._walk_s(life, life.activities[-1].slot, seat.slot)
        if back_s < self.world_s:
            self._imply([agent], Action.OBJECT_INTERACT, (workplace, [seat]), back_s, self.world_s - back_s)

    def _lingers(self, agents: Sequence[int]) -> bool:
        """Whether the world ends soon enough to stay at the last thing to the end, and all who share it do."""
        last = self.lives[agents[0]].activities[-1]
        soon = self.world_s - last.end_s <= MOST_STRETCH_S and last.occasion not in self.awaited
        return soon and len(agents) == 1 + len(last.partners) and self._is_stretchable(last)

    def _is_stretchable(self, activity: Activity) -> bool:
        return activity.action in _ELASTIC and not self.venue.is_service_slot(activity)
