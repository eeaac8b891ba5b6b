"""A person's walk along a route, among others: where to head for, how fast, and what to do if there is no way past."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from genc.motion.routes import Route

_BEND_M = 0.45
"""How near to a bend the next leg is taken."""
_ASIDE_M = 0.03
"""Everybody aims a little to the right: in the model nobody passes who is exactly ahead."""
_STRAIGHT_M = 1.0
"""From so near one goes straight to the end."""

_NEARER_M = 0.15
"""Who has come so much nearer makes progress."""
_FREE_AGAIN_M = 1.2
"""Who has come so far since they squeezed through is broad again."""
_PATIENCE_S = 2.0
"""After so long without progress one squeezes through, and more so after as long again."""


class Build(NamedTuple):
    """How broad a body makes itself, and how it keeps away from others."""

    radius_m: float
    time_gap_s: float
    repulsion: float


BROAD = Build(0.2, 0.5, 8.0)
"""Time gap: the library's 1 s is for dense streams; here people come close to where they want to stand."""
_BUILDS = (BROAD, Build(0.15, 0.3, 1.0), Build(0.1, 0.1, 1.0), Build(0.01, 0.1, 1.0))
"""As always, sideways, edging past, pushing through."""

_CATCH_UP = 1.25
"""By how much one walks faster, at most, to catch up with one's company."""
_LINGER = 0.5
"""By how much one walks slower, at most, to be caught up with."""

Point = tuple[float, float]


@dataclass(eq=False)
class Company:
    """People who walk together: for each, how much of the route's time is behind them, in seconds."""

    done_s: dict[int, float] = field(default_factory=dict)

    def pace(self, agent: int, done_s: float) -> float:
        """The share of their speed at which somebody keeps with the others."""
        self.done_s[agent] = done_s
        mean_s = sum(self.done_s.values()) / len(self.done_s)
        return min(max(1.0 + 0.5 * (mean_s - done_s), _LINGER), _CATCH_UP)

    def leave(self, agent: int) -> None:
        """Lets the others go on without waiting for this one."""
        self.done_s.pop(agent, None)


class Way(NamedTuple):
    """What a body does next."""

    target_m: Point
    speed_mps: float
    build: Build

    @property
    def pushes_through(self) -> bool:
        """Whether there was no way past the others, however narrow one made oneself."""
        return self.build is _BUILDS[-1]


class Walk:
    """A walk along a route.

    Args:
        agent: who walks.
        route: which way.
        company: who walks along; None for nobody.
        near_m: how near to the end one is there.
    """

    def __init__(self, agent: int, route: Route, company: Company | None, near_m: float) -> None:
        self._agent, self._company, self._near_m = agent, company, near_m
        points_m: list[list[float]] = route.points_m.tolist()
        self._ends_m = points_m[1:]
        self._directions = [_direction(start, end) for start, end in zip(points_m, self._ends_m, strict=False)]
        self._speeds_mps: list[float] = route.speeds_mps.tolist()
        durations_s = route.durations_s.tolist()
        self._until_s = [sum(durations_s[: leg + 1]) for leg in range(len(durations_s))]
        self._beyond_m = [
            sum(math.dist(a, b) for a, b in zip(self._ends_m[leg:], self._ends_m[leg + 1 :], strict=False))
            for leg in range(len(self._ends_m))
        ]
        self._leg = 0
        self._nearest_m = self._broad_at_m = math.inf
        self._stuck_s = 0.0
        self._squeeze = 0

    def way(self, here_m: Point, dt_s: float) -> Way:
        """Where to head for from here, and how fast, in the next `dt_s`."""
        while self._leg < len(self._ends_m) - 1 and self._passes(here_m):
            self._leg += 1
        end_m = self._ends_m[self._leg]
        ahead_m = math.dist(here_m, end_m)
        self._notice(ahead_m + self._beyond_m[self._leg], dt_s)
        speed_mps = self._speeds_mps[self._leg]
        if self._company is not None:
            speed_mps *= self._company.pace(self._agent, self._until_s[self._leg] - ahead_m / speed_mps)
        (x, y), aside_m = self._directions[self._leg], _ASIDE_M
        if self._leg == len(self._ends_m) - 1:
            speed_mps = min(speed_mps, ahead_m / dt_s)
            aside_m = _ASIDE_M if ahead_m > _STRAIGHT_M else 0.0
        target_m = (end_m[0] + aside_m * y, end_m[1] - aside_m * x)
        return Way(target_m, speed_mps, _BUILDS[self._squeeze])

    def is_over(self, here_m: Point) -> bool:
        """Whether the end is reached; then the others wait no longer."""
        over = self._leg == len(self._ends_m) - 1 and math.dist(here_m, self._ends_m[-1]) < self._near_m
        if over and self._company is not None:
            self._company.leave(self._agent)
        return over

    def takes_over(self, before: Walk) -> None:
        """Goes on squeezing through, if one who is sent elsewhere did so before."""
        self._squeeze, self._stuck_s = before._squeeze, before._stuck_s

    def _passes(self, here_m: Point) -> bool:
        """Whether the end of a leg that is not the last is near, or behind."""
        end_m, (x, y) = self._ends_m[self._leg], self._directions[self._leg]
        ahead_m = (end_m[0] - here_m[0]) * x + (end_m[1] - here_m[1]) * y
        return ahead_m < 0.0 or math.dist(here_m, end_m) < _BEND_M

    def _notice(self, left_m: float, dt_s: float) -> None:
        """Keeps account of progress, and squeezes through where there is none."""
        if left_m < self._nearest_m - _NEARER_M:
            self._nearest_m, self._stuck_s = left_m, 0.0
            if left_m < self._broad_at_m:
                self._squeeze = 0
            return
        self._stuck_s += dt_s
        if self._stuck_s > _PATIENCE_S and self._squeeze < len(_BUILDS) - 1:
            self._squeeze += 1
            self._stuck_s = 0.0
            self._broad_at_m = left_m - _FREE_AGAIN_M


def _direction(start_m: list[float], end_m: list[float]) -> Point:
    length_m = max(math.dist(start_m, end_m), 1e-9)
    return (end_m[0] - start_m[0]) / length_m, (end_m[1] - start_m[1]) / length_m
