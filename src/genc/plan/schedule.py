"""When: a discrete-event run over occasions, in order of arrival.

An occasion begins when all its people have arrived and, at a service, when it is their turn. Who would be early at a
meeting stays longer at what they did before, so that expected arrivals agree; who is late is waited for.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from genc.plan.life import Life
from genc.plan.occasion import Occasion, rows_of
from genc.plan.plan import Activity, Person, Slot
from genc.plan.seating import Seat, Seating, towards
from genc.plan.services import Services
from genc.plan.walkable import is_solid
from genc.scenario.durations import sample_durations
from genc.words.vocabulary import ACTION_INDEX, CATEGORY_INDEX, Action, Category

ARRIVALS = 0.6
"""The part of the world's length over which groups come in."""
MOST_STRETCH_S = 240.0
"""Longest time by which a doing is drawn out to meet others on time."""
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


@dataclass(frozen=True)
class Cast:
    """What is to be scheduled: occasions, the location index of each, and for an event the one it waits for."""

    occasions: Sequence[Occasion]
    locations: Sequence[int]
    triggers: Mapping[int, int]


def schedule(cast: Cast, seating: Seating, duration_s: float, rng: np.random.Generator) -> tuple[Person, ...]:
    """Everybody with a timed row of activities in a world of that length."""
    return _Run(cast, seating, duration_s, rng).people()


class _Run:
    def __init__(self, cast: Cast, seating: Seating, duration_s: float, rng: np.random.Generator) -> None:
        self.occasions, self.location, self.triggers = cast.occasions, cast.locations, cast.triggers
        self.seating, self.world_s, self.rng = seating, duration_s, rng
        self.services = Services(seating.places)
        places = seating.environment.locations
        self.entrances = [i for i, place in enumerate(places) if place.category is Category.ENTRANCE]
        solid = is_solid(seating.environment)
        self.ways_out = {
            i for i, p in enumerate(places) if i in self.entrances or (p.category is Category.BUILDING and solid[i])
        }
        """Where people come into sight and go out of it; a room is only walked into."""
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
        return tuple(self._close(life) for life in self.lives)

    def _lives(self) -> list[Life]:
        rows = rows_of(self.occasions)
        n_groups = self.occasions[-1].group + 1
        speeds_mps = np.clip(self.rng.normal(1.3, 0.2, size=n_groups), 0.8, 1.8).tolist()
        spread_s = self.rng.uniform(0, ARRIVALS * self.world_s, size=n_groups).tolist()
        firsts = {agent: self.occasions[row[0]] for agent, row in rows.items()}
        comes_in = {first.group for first in firsts.values() if first.action is Action.ENTER_EXIT}
        lives = []
        for agent in range(len(rows)):
            group = firsts[agent].group
            begin_s = spread_s[group] if group in comes_in else 0.0
            life = Life(group, begin_s, speeds_mps[group], rows[agent])
            life.workplace = self._workplace(life)
            lives.append(life)
        return lives

    def _workplace(self, life: Life) -> int | None:
        """The service where somebody works: there from the beginning, and for at least half of their doings."""
        first = self.occasions[life.row[0]]
        place = self.location[first.number]
        if life.begin_s > 0 or first.action in (Action.QUEUE, Action.ENTER_EXIT) or not self._serves(place):
            return None
        n_there = sum(self.location[number] == place for number in life.row)
        return place if 2 * n_there >= len(life.row) else None

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
        door = self.seating.places[self.location[number]].door
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
        return self._arrive_s(life, occasion, door)

    def _arrive_s(self, life: Life, occasion: Occasion, slot: Slot) -> float:
        """When somebody can be at a slot."""
        if life.seat is not None:
            return life.end_s + self._walk_s(life, life.seat.slot, slot)
        if self._must_come(life, occasion):
            return life.begin_s + PASSAGE_S + self._walk_s(life, self._gate(slot)[1], slot)
        return life.begin_s

    def _walk_s(self, life: Life, start: Slot, end: Slot) -> float:
        if start.position_m == end.position_m:
            return 0.0
        way_m = self.seating.walkable.distances([start.position_m], [end.position_m])[0, 0]
        return float(way_m) / life.speed_mps

    def _hold(self, occasion: Occasion, ready_s: float) -> None:
        """Finds slots and times of an occasion, and adds it to the rows of its people."""
        lives = [self.lives[agent] for agent in occasion.agents]
        seats = self._seats(occasion, lives, ready_s)
        arrive_s = max(self._arrive_s(life, occasion, seat.slot) for life, seat in zip(lives, seats, strict=True))
        start_s, end_s = self._span(occasion, lives, seats, max(arrive_s, self._trigger_s(occasion)))
        self._draw_out(lives, seats, start_s)
        for agent, life, seat in zip(occasion.agents, lives, seats, strict=True):
            if self._must_come(life, occasion):
                self._come(life, seat.slot, start_s)
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
        leave_s = (start_s if life.begin_s > 0 or self._passes(occasion) else 0.0) if appears else life.end_s
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
        """Whether somebody's group comes in, and so they do too, though no step of theirs says so."""
        return life.seat is None and life.begin_s > 0 and not self._passes(occasion)

    def _passes(self, occasion: Occasion) -> bool:
        """Whether people come into sight or go out of it."""
        return occasion.action is Action.ENTER_EXIT and self.location[occasion.number] in self.ways_out

    def _gate(self, near: Slot) -> tuple[int, Slot]:
        """The entrance nearest to a slot."""
        doors = [(i, self.seating.places[i].door) for i in self.entrances]
        return min(doors, key=lambda door: math.dist(door[1].position_m, near.position_m))

    def _come(self, life: Life, slot: Slot, start_s: float) -> None:
        """Lets somebody come in just in time for their first doing."""
        entrance, door = self._gate(slot)
        pass_s = max(0.0, start_s - self._walk_s(life, door, slot) - PASSAGE_S)
        self._imply(life, Action.ENTER_EXIT, (entrance, Seat(door)), pass_s, pass_s + PASSAGE_S)

    def _imply(self, life: Life, action: Action, where: tuple[int, Seat], start_s: float, end_s: float) -> None:
        """Adds an activity that no step asked for."""
        location, seat = where
        leave_s = life.end_s if life.activities else start_s
        if life.seat is not None:
            life.seat.until_s = life.end_s
        life.activities.append(
            Activity(action, location, seat.slot, leave_s, start_s, end_s, self.n_occasions, implied=True)
        )
        self.n_occasions += 1
        life.seat, life.location = seat, location

    def _draw_out(self, lives: Sequence[Life], seats: Sequence[Seat], start_s: float) -> None:
        """Draws out what people did before, where it lasts as long as there is time, until they need to go."""
        must_go_s: dict[int, list[tuple[Life, float]]] = {}
        for life, seat in zip(lives, seats, strict=True):
            if life.activities and life.seat is not None:
                go_s = start_s - self._walk_s(life, life.seat.slot, seat.slot)
                must_go_s.setdefault(life.activities[-1].occasion, []).append((life, go_s))
        for together in must_go_s.values():
            last = together[0][0].activities[-1]
            everybody = len(together) == 1 + len(last.partners)
            end_s = min(last.end_s + MOST_STRETCH_S, *(go_s for _, go_s in together), math.inf)
            if everybody and last.action in _ELASTIC and end_s > last.end_s and not self._is_service_slot(last):
                for life, _ in together:
                    life.activities[-1] = replace(life.activities[-1], end_s=end_s)

    def _close(self, life: Life) -> Person:
        """Lets people stay at what they do last, if the world ends soon or they work there; sends the others home."""
        last = life.activities[-1]
        leaves = last.action is Action.ENTER_EXIT and last.location in self.ways_out
        if not leaves and self._lingers(life, last):
            life.activities[-1] = replace(last, end_s=max(last.end_s, self.world_s))
        elif not leaves:
            entrance, door = self._gate(last.slot)
            there_s = last.end_s + self._walk_s(life, last.slot, door)
            leaves = there_s < self.world_s
            if leaves:
                self._imply(life, Action.ENTER_EXIT, (entrance, Seat(door)), there_s, there_s + PASSAGE_S)
        return Person(life.group, life.speed_mps, tuple(life.activities), leaves)

    def _lingers(self, life: Life, last: Activity) -> bool:
        if life.workplace is None and self.world_s - last.end_s > MOST_STRETCH_S:
            return False
        if last.action not in _ELASTIC or self._is_service_slot(last):
            return False
        others = [self.lives[agent] for agent in last.partners]
        return all(o.activities[-1].occasion == last.occasion and o.workplace == life.workplace for o in others)

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
            return [self.seating.near(location, self._behind(location), from_s) for _ in range(n)]
        is_table = self.seating.environment.locations[location].category is Category.FURNITURE
        if n > 1 and occasion.action in (Action.DISCUSS, Action.MEET) and not is_table:
            return self.seating.around(location, n, from_s)
        return self.seating.together(location, n, from_s)

    def _passages(self, location: int, n: int) -> list[Seat]:
        """Points of an entrance, or the door of anything else; nobody stays there, so nobody holds them."""
        place = self.seating.places[location]
        if location not in self.entrances:
            return [Seat(place.door)] * n
        spots = [place.spots[i] for i in self.rng.integers(len(place.spots), size=n).tolist()]
        return [Seat(Slot(spot.position_m, place.door.facing_rad)) for spot in spots]

    def _stays(self, life: Life, action: Action, location: int) -> bool:
        """Whether somebody goes on where they are."""
        if life.seat is None or life.location != location or action in _ROAMING:
            return False
        last = life.activities[-1]
        return last.action not in (Action.QUEUE, Action.ENTER_EXIT) and not self._is_service_slot(last)

    def _behind(self, location: int) -> tuple[float, float]:
        """The far side of a counter, where staff stand."""
        x, y = self.seating.environment.locations[location].position_m
        service = self.seating.places[location].service
        at_x, at_y = service[len(service) // 2].position_m
        return 2 * x - at_x, 2 * y - at_y

    # Services.

    def _serves(self, location: int) -> bool:
        category = self.seating.environment.locations[location].category
        return category in (Category.SERVICE_AREA, Category.ITEM) and bool(self.seating.places[location].service)

    def _is_service(self, occasion: Occasion) -> bool:
        """Whether customers use a service, or somebody alone talks to its staff."""
        alone = len(occasion.agents) == 1 and occasion.action is Action.DISCUSS
        used = alone or occasion.action is Action.OBJECT_INTERACT
        return used and self._serves(self.location[occasion.number]) and bool(self._customers(occasion))

    def _customers(self, occasion: Occasion) -> list[int]:
        place = self.location[occasion.number]
        return [agent for agent in occasion.agents if self.lives[agent].workplace != place]

    def _is_service_slot(self, activity: Activity) -> bool:
        return any(activity.slot is slot for slot in self.seating.places[activity.location].service)

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
                front = self.services.slots(service.number, location)[0]
                way_s = max(self._walk_s(life, seat.slot, front) for life, seat in zip(lives, seats, strict=True))
                self.services.keep(service.number, location, end_s + way_s + self.lasts_s[service.number])
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
