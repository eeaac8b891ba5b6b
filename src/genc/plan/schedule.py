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
from genc.plan.life import Life
from genc.plan.occasion import Occasion, rows_of
from genc.plan.plan import Activity, Person, Slot
from genc.plan.seating import Seat, Seating, towards
from genc.plan.services import Services
from genc.scenario.durations import sample_durations
from genc.words.vocabulary import ACTION_INDEX, CATEGORY_INDEX, Action, Category

MOST_STRETCH_S = 240.0
"""Longest time by which a doing is drawn out to meet others on time."""
WORTH_A_MENTION_S = 20.0
"""Who stays behind for longer than this goes on with what they all did."""
PASSAGE_S = 2.0
"""Time to pass an entrance, where no step asked for it."""

_ROAMING = (Action.WANDER, Action.CARRY)
_TO_EACH_OTHER = (Action.DISCUSS, Action.MEET, Action.WAVE_AT)
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
        self.services = Services(self.venue.places)
        actions = np.array([ACTION_INDEX[o.action] for o in self.occasions])
        categories = np.array([CATEGORY_INDEX[o.category] for o in self.occasions])
        self.lasts_s: list[float] = sample_durations(actions, categories, rng).tolist()
        self.lives = self._lives()
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
        return tuple(self._close(agent) for agent in range(len(self.lives)))

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
        seats = self._seats(occasion, lives, ready_s)
        gate = self.venue.gate(seats[0].slot)
        arrive_s = max(
            self._arrive_s(life, occasion, seat.slot, gate[1]) for life, seat in zip(lives, seats, strict=True)
        )
        start_s, end_s = self._span(occasion, lives, seats, max(arrive_s, self._trigger_s(occasion)))
        self._draw_out(occasion, seats, start_s)
        for agent, life, seat in zip(occasion.agents, lives, seats, strict=True):
            if self._must_come(life, occasion):
                self._come(life, gate, seat.slot, start_s)
            partners = tuple(other for other in occasion.agents if other != agent)
            self._add(life, occasion, seat, start_s, end_s, partners)
        if occasion.is_last:
            self.event_end_s[occasion.event] = end_s
            for number in self.on_hold.pop(occasion.event, ()):
                self._offer(number)
        for following in dict.fromkeys(life.next() for life in lives):
            self._offer(following)

    def _add(
        self, life: Life, occasion: Occasion, seat: Seat, start_s: float, end_s: float, partners: tuple[int, ...]
    ) -> None:
        appears = not life.activities
        # who comes in is not seen before; who is there from the beginning waits in sight
        leave_s = (0.0 if life.comes_s is None else start_s) if appears else life.end_s
        if life.seat is not None and life.seat is not seat:
            life.seat.until_s = life.end_s
        location = self.location[occasion.number]
        life.activities.append(
            Activity(occasion.action, location, seat.slot, leave_s, start_s, end_s, occasion.number, partners)
        )
        life.seat, life.location = seat, location
        life.n_done += 1

    # Coming, going, and the time between.

    def _must_come(self, life: Life, occasion: Occasion) -> bool:
        """Whether somebody has to come in first, though no step of theirs says so."""
        return (
            life.seat is None
            and life.comes_s is not None
            and not self.venue.is_passage(occasion.action, self.location[occasion.number])
        )

    def _come(self, life: Life, gate: tuple[int, Slot], slot: Slot, start_s: float) -> None:
        """Lets somebody come in just in time for their first doing."""
        entrance, door = gate
        pass_s = max(0.0, start_s - self._walk_s(life, door, slot) - PASSAGE_S)
        self._imply(life, Action.ENTER_EXIT, (entrance, Seat(door)), pass_s, pass_s + PASSAGE_S)

    def _imply(self, life: Life, action: Action, where: tuple[int, Seat], start_s: float, end_s: float) -> None:
        """Adds an activity that no step asked for."""
        location, seat = where
        leave_s = life.end_s if life.activities else start_s
        if life.seat is not None and life.seat is not seat:
            life.seat.until_s = life.end_s
        life.activities.append(
            Activity(action, location, seat.slot, leave_s, start_s, end_s, self.n_occasions, implied=True)
        )
        self.n_occasions += 1
        life.seat, life.location = seat, location

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
            if last.action not in _ELASTIC or end_s <= last.end_s or self.venue.is_service_slot(last):
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
            action = Action.WAIT if last.action in _TO_EACH_OTHER and not others else last.action
            row.append(
                Activity(
                    action, last.location, last.slot, last.end_s, last.end_s, end_s, self.n_occasions, others, True
                )
            )
        self.n_occasions += 1

    def _close(self, agent: int) -> Person:
        """Lets people stay at what they do last, if the world ends soon, or work on; sends the others home."""
        life = self.lives[agent]
        last = life.activities[-1]
        leaves = self.venue.is_passage(last.action, last.location)
        if leaves or last.end_s >= self.world_s:
            pass
        elif life.workplace is not None:
            self._work_on(life, life.workplace)
        elif self._lingers(last):
            life.activities[-1] = replace(last, end_s=self.world_s)
        else:
            # who did the last thing together leaves by one door
            leader = self.lives[min((agent, *last.partners))].activities
            together = next(a.slot for a in leader if a.occasion == last.occasion)
            entrance, door = self.venue.gate(together)
            there_s = last.end_s + self._walk_s(life, last.slot, door)
            if leaves := there_s < self.world_s:
                self._imply(life, Action.ENTER_EXIT, (entrance, Seat(door)), there_s, there_s + PASSAGE_S)
        return Person(life.group, life.speed_mps, tuple(life.activities), leaves)

    def _work_on(self, life: Life, workplace: int) -> None:
        """Lets staff who have done what was asked of them go on with their work to the end."""
        end_s, seat = life.end_s, life.seat
        if seat is None or life.location != workplace:
            seat = self.seating.near(workplace, self.venue.behind(workplace), end_s)
        back_s = end_s + self._walk_s(life, life.activities[-1].slot, seat.slot)
        if back_s < self.world_s:
            self._imply(life, Action.OBJECT_INTERACT, (workplace, seat), back_s, self.world_s)

    def _lingers(self, last: Activity) -> bool:
        """Whether the world ends soon enough to stay at the last thing to the end, and all who share it do."""
        soon = self.world_s - last.end_s <= MOST_STRETCH_S and last.occasion not in self.awaited
        if not soon or last.action not in _ELASTIC or self.venue.is_service_slot(last):
            return False
        others = [self.lives[agent] for agent in last.partners]
        return all(o.activities[-1].occasion == last.occasion and o.workplace is None for o in others)

    # Slots.

    def _seats(self, occasion: Occasion, lives: Sequence[Life], ready_s: float) -> list[Seat]:
        location, action, n = self.location[occasion.number], occasion.action, len(lives)
        if action is Action.ENTER_EXIT:
            return self._passages(location, n)
        if action is Action.QUEUE:
            return [Seat(slot) for slot in self.services.line(location, n, ready_s)]
        from_s = min(life.end_s for life in lives)
        served: list[Slot] = []
        if self._is_service(occasion):
            n_customers = len(self._customers(occasion))
            self.services.turn(occasion.number, location, n_customers, ready_s, self.lasts_s[occasion.number])
            served = self.services.slots(occasion.number, location)
        seats: list[Seat | None] = []
        for life in lives:
            if served and life.workplace != location:
                seats.append(Seat(served.pop(0)))
            else:
                seats.append(life.seat if self._stays(life, action, location) else None)
        rest = iter(self._fresh(occasion, lives, seats, from_s))
        filled = [next(rest) if seat is None else seat for seat in seats]
        if n > 1 and action in _TO_EACH_OTHER:
            slots = [seat.slot for seat in filled]
            for i, seat in enumerate(filled):
                seat.slot = towards(seat.slot, slots[:i] + slots[i + 1 :])
        return filled

    def _fresh(
        self, occasion: Occasion, lives: Sequence[Life], seats: Sequence[Seat | None], from_s: float
    ) -> list[Seat]:
        """Seats for those who have none yet: beside those who have, or all in one place."""
        location, n = self.location[occasion.number], seats.count(None)
        there = [seat for seat in seats if seat is not None]
        if n == 0:
            return []
        if there:
            return [self.seating.near(location, there[0].slot.position_m, from_s) for _ in range(n)]
        if lives[0].workplace == location:
            return [self.seating.near(location, self.venue.behind(location), from_s) for _ in range(n)]
        is_table = self.venue.environment.locations[location].category is Category.FURNITURE
        if n > 1 and occasion.action in (Action.DISCUSS, Action.MEET) and not is_table:
            return self.seating.around(location, n, from_s)
        return self.seating.together(location, n, from_s)

    def _passages(self, location: int, n: int) -> list[Seat]:
        """Points of an entrance, or the door of anything else; nobody stays there, so nobody holds them."""
        place = self.venue.places[location]
        if location not in self.venue.entrances:
            return [Seat(place.door)] * n
        spots = [place.spots[i] for i in self.rng.integers(len(place.spots), size=n).tolist()]
        return [Seat(Slot(spot.position_m, place.door.facing_rad)) for spot in spots]

    def _stays(self, life: Life, action: Action, location: int) -> bool:
        """Whether somebody goes on where they are."""
        if life.seat is None or life.location != location or action in _ROAMING:
            return False
        last = life.activities[-1]
        return last.action not in (Action.QUEUE, Action.ENTER_EXIT) and not self.venue.is_service_slot(last)

    # Services.

    def _is_service(self, occasion: Occasion) -> bool:
        """Whether customers use a service, or somebody alone talks to its staff."""
        alone = len(occasion.agents) == 1 and occasion.action is Action.DISCUSS
        used = alone or occasion.action is Action.OBJECT_INTERACT
        return used and self.venue.serves(self.location[occasion.number]) and bool(self._customers(occasion))

    def _customers(self, occasion: Occasion) -> list[int]:
        place = self.location[occasion.number]
        return [agent for agent in occasion.agents if self.lives[agent].workplace != place]

    def _span(
        self, occasion: Occasion, lives: Sequence[Life], seats: Sequence[Seat], arrive_s: float
    ) -> tuple[float, float]:
        """Begin and end of an occasion whose people are there at `arrive_s`."""
        number, location = occasion.number, self.location[occasion.number]
        end_s = arrive_s + self.lasts_s[number]
        if occasion.action is Action.QUEUE:
            service = self._queued_for(occasion)
            if service is not None:
                n_customers = len(self._customers(service))
                turn = self.services.turn(service.number, location, n_customers, end_s, self.lasts_s[service.number])
                end_s = turn.start_s
                counter = self.services.slots(service.number, location)
                way_s = max(self._walk_s(lives[0], seat.slot, slot) for seat in seats for slot in counter)
                self.services.keep(service.number, location, end_s + way_s + self.lasts_s[service.number])
            else:
                end_s = max(end_s, self.services.head_s(location, arrive_s))
            self.services.stand(location, len(occasion.agents), arrive_s, end_s)
            return arrive_s, end_s
        if self._is_service(occasion):
            n_customers = len(self._customers(occasion))
            turn = self.services.turn(number, location, n_customers, arrive_s, self.lasts_s[number])
            start_s = max(arrive_s, turn.start_s)
            self.services.keep(number, location, start_s + self.lasts_s[number])
            return start_s, start_s + self.lasts_s[number]
        return arrive_s, end_s

    def _queued_for(self, queue: Occasion) -> Occasion | None:
        """The service that all who queue go on to, if there is one."""
        following = {self.lives[agent].next(skip=1) for agent in queue.agents}
        number = following.pop()
        if following or number is None:
            return None
        service = self.occasions[number]
        fits = self.location[number] == self.location[queue.number] and service.agents == queue.agents
        return service if fits and self._is_service(service) else None
