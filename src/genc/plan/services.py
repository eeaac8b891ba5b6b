"""Whose turn it is: each service has as many servers as slots, and whoever comes first is served first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from genc.plan.plan import Slot
from genc.plan.slots import Places


@dataclass(frozen=True)
class Turn:
    """A turn at a service: when it comes, and which server is kept for it."""

    start_s: float
    server: int


class Services:
    """The servers and lines of all locations. Calls must come in order of time."""

    def __init__(self, places: Sequence[Places]) -> None:
        self._places = places
        self._free_s = [[0.0] * len(place.service) for place in places]
        self._in_line_until_s: list[list[float]] = [[] for _ in places]
        self._turns: dict[int, Turn] = {}

    def turn(self, occasion: int, location: int, from_s: float, lasts_s: float) -> Turn:
        """The turn of an occasion whose people come at `from_s`, one server for all; asked again, the same turn."""
        if occasion not in self._turns:
            free_s = self._free_s[location]
            # who is free by then comes first, in order; of the busy, who is free soonest
            server = min(range(len(free_s)), key=lambda i: (max(free_s[i] - from_s, 0.0), i))
            start_s = max(from_s, free_s[server])
            self._turns[occasion] = Turn(start_s, server)
            self.keep(occasion, location, start_s + lasts_s)
        return self._turns[occasion]

    def keep(self, occasion: int, location: int, until_s: float) -> None:
        """Keeps the server of an occasion busy until then."""
        server = self._turns[occasion].server
        self._free_s[location][server] = max(self._free_s[location][server], until_s)

    def slot(self, occasion: int, location: int) -> Slot:
        """The service slot of an occasion whose turn is known."""
        return self._places[location].service[self._turns[occasion].server]

    def line(self, location: int, n: int, from_s: float) -> list[Slot]:
        """Where n people stand who come to the end of a line."""
        positions = self._places[location].line
        ahead = sum(until_s > from_s for until_s in self._in_line_until_s[location])
        return [positions[min(ahead + i, len(positions) - 1)] for i in range(n)]

    def head_s(self, location: int, from_s: float) -> float:
        """When somebody who comes to the end of a line is at its head."""
        return max(self._in_line_until_s[location], default=from_s)

    def stand(self, location: int, n: int, from_s: float, until_s: float) -> None:
        """Lets n people stand in line."""
        still = [s for s in self._in_line_until_s[location] if s > from_s]
        self._in_line_until_s[location] = still + [until_s] * n
