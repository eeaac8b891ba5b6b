"""What places offer to an occasion: slots for all its people, next to each other, and a turn at a service."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from genc.plan.arrivals import Cast
from genc.plan.life import Life
from genc.plan.occasion import Occasion
from genc.plan.plan import ROAMING, Slot
from genc.plan.seating import Seat, Seating, reach_m, towards
from genc.plan.services import Services
from genc.plan.slots import ABREAST_M, MOST_ABREAST
from genc.words.vocabulary import Action, Category

TO_EACH_OTHER = (Action.DISCUSS, Action.MEET, Action.WAVE_AT)
"""Doings in which people face each other."""


class Hosting:
    """Slots and turns, in order of time.

    Args:
        cast: the occasions and where they are.
        lives: how far everybody's row has come; grows while this is used.
        lasts_s: for each occasion, how long it lasts.
        seating: who has which slot.
        rng: decides at which point of an entrance people pass.
    """

    def __init__(
        self, cast: Cast, lives: Sequence[Life], lasts_s: Sequence[float], seating: Seating, rng: np.random.Generator
    ) -> None:
        self.occasions, self.location, self.lives, self.lasts_s = cast.occasions, cast.locations, lives, lasts_s
        self.seating, self.venue, self.rng = seating, seating.venue, rng
        self.services = Services(self.venue.places)

    def seats(self, occasion: Occasion, lives: Sequence[Life], ready_s: float) -> list[Seat]:
        """Where the people of an occasion are, in their order; they could be there at about `ready_s`."""
        location, action, n = self.location[occasion.number], occasion.action, len(lives)
        if action is Action.ENTER_EXIT:
            return self.passage(location, n)
        if action is Action.QUEUE:
            return [Seat(slot) for slot in self.services.line(location, n, ready_s)]
        from_s = min(life.end_s for life in lives)
        seats = self._kept(occasion, lives, ready_s)
        rest = iter(self._fresh(occasion, lives, seats, from_s))
        filled = [next(rest) if seat is None else seat for seat in seats]
        if n > 1 and action in TO_EACH_OTHER:
            slots = [seat.slot for seat in filled]
            for i, seat in enumerate(filled):
                seat.slot = towards(seat.slot, slots[:i] + slots[i + 1 :])
        return filled

    def passage(self, location: int, n: int) -> list[Seat]:
        """Where n people go through an entrance together, anywhere in its width, or by the door of anything else."""
        place = self.venue.places[location]
        if location not in self.venue.entrances:
            return self._abreast(place.door, n)
        spot = place.spots[int(self.rng.integers(len(place.spots)))]
        return self._abreast(Slot(spot.position_m, place.door.facing_rad), n)

    def _kept(self, occasion: Occasion, lives: Sequence[Life], ready_s: float) -> list[Seat | None]:
        """The service slot of the first who is served, and the seats of those who stay where they are."""
        location, served = self.location[occasion.number], list[Slot]()
        if self._is_service(occasion):
            self.services.turn(occasion.number, location, ready_s, self.lasts_s[occasion.number])
            served = [self.services.slot(occasion.number, location)]
        kept: list[Seat | None] = []
        for life in lives:
            if served and life.workplace != location:
                kept.append(Seat(served.pop()))
                continue
            seat = life.seat if self._stays(life, occasion.action, location) else None
            company = next((other for other in kept if other is not None), seat)
            is_far = seat is not None and company is not None and _apart_m(seat, company) > reach_m(len(lives))
            kept.append(None if is_far and life.workplace != location else seat)
        return kept

    def _fresh(
        self, occasion: Occasion, lives: Sequence[Life], seats: Sequence[Seat | None], from_s: float
    ) -> list[Seat]:
        """Seats for those who have none yet: beside those who have, or all in one place."""
        location, n = self.location[occasion.number], seats.count(None)
        company = next((seat for seat in seats if seat is not None), None)
        if n == 0:
            return []
        if company is not None:
            return self.seating.beside(location, company.slot, n, from_s)
        near_m = None
        if lives[0].workplace == location:
            near_m = self.venue.behind(location)
        elif occasion.action is Action.WAVE_AT and lives[0].seat is not None:
            near_m = lives[0].seat.slot.position_m
        if near_m is not None:
            first = self.seating.near(location, near_m, from_s)
            return [first, *self.seating.beside(location, first.slot, n - 1, from_s)]
        is_table = self.venue.environment.locations[location].category is Category.FURNITURE
        if n > 1 and occasion.action in (Action.DISCUSS, Action.MEET) and not is_table:
            return self.seating.around(location, n, from_s)
        return self.seating.together(location, n, from_s)

    def _abreast(self, slot: Slot, n: int) -> list[Seat]:
        """n places at a door, side by side; nobody stays there, so nobody holds them."""
        ahead = np.array([np.cos(slot.facing_rad), np.sin(slot.facing_rad)])
        aside = np.array([-ahead[1], ahead[0]])
        row, column = np.divmod(np.arange(n), MOST_ABREAST)
        offset = (column + 1) // 2 * np.where(column % 2, 1, -1)
        points_m = slot.position_m + ABREAST_M * (offset[:, None] * aside + row[:, None] * ahead)
        return [Seat(Slot((x_m, y_m), slot.facing_rad)) for x_m, y_m in self.venue.walkable.snap(points_m).tolist()]

    def _stays(self, life: Life, action: Action, location: int) -> bool:
        """Whether somebody goes on where they are."""
        if life.seat is None or life.location != location or action in ROAMING:
            return False
        last = life.activities[-1]
        return last.action not in (Action.QUEUE, Action.ENTER_EXIT) and not self.venue.is_service_slot(last)

    # Services.

    def span(
        self, occasion: Occasion, lives: Sequence[Life], seats: Sequence[Seat], arrive_s: float
    ) -> tuple[float, float]:
        """Begin and end of an occasion whose people are there at `arrive_s`."""
        number, location = occasion.number, self.location[occasion.number]
        end_s = arrive_s + self.lasts_s[number]
        if occasion.action is Action.QUEUE:
            service = self._queued_for(occasion)
            if service is not None:
                turn = self.services.turn(service.number, location, end_s, self.lasts_s[service.number])
                end_s = turn.start_s
                counter = self.services.slot(service.number, location)
                way_m = max(self.venue.way_m(seat.slot, counter) for seat in seats)
                end_of_service_s = end_s + way_m / lives[0].speed_mps + self.lasts_s[service.number]
                self.services.keep(service.number, location, end_of_service_s)
            else:
                end_s = max(end_s, self.services.head_s(location, arrive_s))
            self.services.stand(location, len(occasion.agents), arrive_s, end_s)
            return arrive_s, end_s
        if self._is_service(occasion):
            turn = self.services.turn(number, location, arrive_s, self.lasts_s[number])
            start_s = max(arrive_s, turn.start_s)
            self.services.keep(number, location, start_s + self.lasts_s[number])
            return start_s, start_s + self.lasts_s[number]
        return arrive_s, end_s

    def _is_service(self, occasion: Occasion) -> bool:
        """Whether customers use a service, or somebody alone talks to its staff."""
        alone = len(occasion.agents) == 1 and occasion.action is Action.DISCUSS
        used = alone or occasion.action is Action.OBJECT_INTERACT
        place = self.location[occasion.number]
        return used and self.venue.serves(place) and any(self.lives[a].workplace != place for a in occasion.agents)

    def _queued_for(self, queue: Occasion) -> Occasion | None:
        """The service that all who queue go on to, if there is one."""
        following = {self.lives[agent].next(skip=1) for agent in queue.agents}
        number = following.pop()
        if following or number is None:
            return None
        service = self.occasions[number]
        fits = self.location[number] == self.location[queue.number] and service.agents == queue.agents
        return service if fits and self._is_service(service) else None


def _apart_m(seat: Seat, other: Seat) -> float:
    return math.dist(seat.slot.position_m, other.slot.position_m)
