"""Who has which slot from when to when: no two people within arm's length of each other at one time."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np

from genc.plan.plan import Slot
from genc.plan.slots import circle, more_spots
from genc.plan.venue import Venue

ELBOW_M = 0.6
_TRIES = 12
"""Spots looked at before the nearest to the company is taken."""
_MARGINS_M = (0.0, 0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0)
"""Where all spots of a place are taken, people stand round it, further and further out."""

_DIRECTIONS_RAD = np.arange(12) * (np.pi / 6)
_ROUND_M = np.concatenate(
    [ring_m * np.stack([np.cos(_DIRECTIONS_RAD), np.sin(_DIRECTIONS_RAD)], axis=1) for ring_m in (0.75, 1.1, 1.5, 1.9)]
)


@dataclass
class Seat:
    """A slot somebody holds until `until_s`; infinite while it is not known when they will go."""

    slot: Slot
    until_s: float = math.inf


class Seating:
    """Hands out free slots. Calls must come in order of time."""

    def __init__(self, venue: Venue, rng: np.random.Generator) -> None:
        self.venue, self.rng = venue, rng
        self._near: defaultdict[tuple[int, int], dict[tuple[float, float], Seat]] = defaultdict(dict)
        """For each square metre, who last took each point in it or next to it: they stay longest."""

    def is_free(self, position_m: tuple[float, float], from_s: float) -> bool:
        """Whether nobody holds a seat within arm's length at `from_s` or later."""
        x, y = position_m
        for at_m, seat in self._near.get((math.floor(x), math.floor(y)), {}).items():
            if seat.until_s > from_s and math.dist(position_m, at_m) < ELBOW_M:
                return False
        return True

    def hold(self, slot: Slot) -> Seat:
        """Takes a slot until further notice."""
        seat = Seat(slot)
        column, row = math.floor(slot.position_m[0]), math.floor(slot.position_m[1])
        for i in (column - 1, column, column + 1):
            for j in (row - 1, row, row + 1):
                self._near[i, j][slot.position_m] = seat
        return seat

    def any_spot(self, location: int, from_s: float) -> Seat:
        """A free spot at a location, at random."""
        spots = self.venue.places[location].spots
        for i in self.rng.integers(len(spots), size=_TRIES).tolist():
            if self.is_free(spots[i].position_m, from_s):
                return self.hold(spots[i])
        return self.near(location, spots[int(self.rng.integers(len(spots)))].position_m, from_s)

    def near(self, location: int, position_m: tuple[float, float], from_s: float) -> Seat:
        """The free spot of a location that is nearest to a point; new ground is found where all are taken."""
        for spot in self._free_near(location, position_m, math.inf, from_s):
            return self.hold(spot)
        for margin_m in _MARGINS_M:
            place = self.venue.environment.locations[location]
            for spot in more_spots(place, self.venue.walkable, margin_m, _TRIES, self.rng):
                if self.is_free(spot.position_m, from_s):
                    return self.hold(spot)
        return self.hold(spot)

    def around(self, location: int, n: int, from_s: float) -> list[Seat]:
        """n seats in a talking circle at a free place of a location, or as near to it as there is room."""
        spots = self.venue.places[location].spots
        centres = [spots[i] for i in self.rng.integers(len(spots), size=_TRIES).tolist()]
        return self._ring(location, centres, n, from_s) or self._outside(location, n, from_s)

    def together(self, location: int, n: int, from_s: float) -> list[Seat]:
        """n free spots of a location next to each other, or room for all as near to it as may be."""
        spots = self.venue.places[location].spots
        for i in self.rng.integers(len(spots), size=_TRIES).tolist():
            near = list(islice(self._free_near(location, spots[i].position_m, reach_m(n), from_s), n))
            if len(near) == n:
                return [self.hold(spot) for spot in near]
        return [self.any_spot(location, from_s)] if n == 1 else self._outside(location, n, from_s)

    def beside(self, location: int, company: Slot, n: int, from_s: float) -> list[Seat]:
        """n seats next to somebody who has one: spots of the location, else free ground round them."""
        found: list[Seat] = []
        for _ in range(n):
            near = chain(
                self._free_near(location, company.position_m, reach_m(n), from_s), self._ground(company, from_s)
            )
            spot = next(near, None)
            found.append(self.hold(spot) if spot else self.near(location, company.position_m, from_s))
        return found

    def _free_near(self, location: int, point_m: tuple[float, float], reach_m: float, from_s: float) -> Iterator[Slot]:
        """The free spots of a location within reach of a point, nearest first."""
        spots = self.venue.places[location].spots
        away_m = [math.dist(spot.position_m, point_m) for spot in spots]
        for i in sorted(range(len(spots)), key=away_m.__getitem__):
            if away_m[i] <= reach_m and self.is_free(spots[i].position_m, from_s):
                yield spots[i]

    def _ground(self, company: Slot, from_s: float) -> Iterator[Slot]:
        """Free points round somebody, nearest first, with the same outlook."""
        points_m = (np.array(company.position_m) + _ROUND_M).tolist()
        for (x, y), fits in zip(points_m, self.venue.walkable.free(points_m), strict=True):
            if fits and self.is_free((x, y), from_s):
                yield Slot((x, y), company.facing_rad)

    def _outside(self, location: int, n: int, from_s: float) -> list[Seat]:
        """n seats in a circle round a place where all spots are taken, further and further out."""
        place = self.venue.environment.locations[location]
        for margin_m in _MARGINS_M:
            centres = more_spots(place, self.venue.walkable, margin_m, _TRIES, self.rng)
            if seats := self._ring(location, centres, n, from_s):
                return seats
        return [self.any_spot(location, from_s) for _ in range(n)]

    def _ring(self, location: int, centres: Sequence[Slot], n: int, from_s: float) -> list[Seat]:
        """n seats in a circle round the first of these points where there is room; none if there is none."""
        place = self.venue.environment.locations[location]
        for centre in centres:
            ring = circle(place, self.venue.walkable, centre.position_m, n)
            if all(self.is_free(slot.position_m, from_s) for slot in ring) and _apart(ring):
                return [self.hold(slot) for slot in ring]
        return []


def reach_m(n: int) -> float:
    """How far apart n people are, at most, who do something together."""
    return 1.0 + 0.4 * n


def towards(slot: Slot, others: Iterable[Slot]) -> Slot:
    """The same slot, facing the middle of the others."""
    points = [other.position_m for other in others]
    if not points:
        return slot
    x = sum(p[0] for p in points) / len(points) - slot.position_m[0]
    y = sum(p[1] for p in points) / len(points) - slot.position_m[1]
    return slot if math.hypot(x, y) < 1e-6 else Slot(slot.position_m, math.atan2(y, x))


def _apart(ring: Sequence[Slot]) -> bool:
    return all(math.dist(a.position_m, b.position_m) >= ELBOW_M for i, a in enumerate(ring) for b in ring[i + 1 :])
