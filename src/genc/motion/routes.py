"""Routes: the ways that people take, alone or side by side.

People who set off together keep their formation: two or three abreast along one shortest way, everyone so fast that
all come to each bend of it together.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from genc.motion.steering import Target
from genc.plan.slots import ABREAST_M, MOST_ABREAST
from genc.plan.walkable import Walkable

Floats = NDArray[np.float64]

_ROW_M = 1.2
"""Between the rows of a formation."""
_FORM_UP_M = 1.5
"""From where people set off to where they walk in formation, and from there to where they arrive."""
_SHORTEST_M = 6.0
"""Over less than this everybody just walks."""
_SLOWEST_SHARE = 0.5
"""Nobody walks slower than this share of their speed to let others catch up: one waits a moment at the slot instead."""


@dataclass(frozen=True)
class Order:
    """Somebody is to walk from a point to a target, at this speed."""

    agent: int
    start_m: tuple[float, float]
    target: Target
    speed_mps: float


@dataclass(frozen=True, eq=False)
class Route:
    """A way in straight legs.

    Attributes:
        points_m: `[k, 2]`, both ends included.
        speeds_mps: `[k - 1]`, for each leg.
    """

    points_m: Floats
    speeds_mps: Floats

    @cached_property
    def durations_s(self) -> Floats:
        """`[k - 1]`, for each leg."""
        lengths_m: Floats = np.linalg.norm(np.diff(self.points_m, axis=0), axis=1)
        return np.asarray(lengths_m / self.speeds_mps)

    @property
    def velocities_mps(self) -> Floats:
        """`[k - 1, 2]`, for each leg."""
        return np.asarray(np.diff(self.points_m, axis=0) / np.maximum(self.durations_s, 1e-9)[:, None])


def find_routes(walkable: Walkable, orders: Sequence[Order]) -> dict[int, Route]:
    """The route of every agent that has an order."""
    starts_m = np.array([order.start_m for order in orders])
    goals_m = walkable.snap([order.target.point_m for order in orders])
    parties: dict[Hashable, list[int]] = {}
    for i, order in enumerate(orders):
        company = order.target.company
        parties.setdefault(("alone", i) if company is None else company, []).append(i)
    ways = walkable.paths(*(_middles(walkable, ends_m, list(parties.values())) for ends_m in (starts_m, goals_m)))
    found: dict[int, Route] = {}
    for party, way_m in zip(parties.values(), ways, strict=True):
        speeds_mps = [orders[i].speed_mps for i in party]
        if len(party) > 1:
            routes = _together(walkable, starts_m[party], goals_m[party], way_m, min(speeds_mps))
        else:
            routes = [Route(way_m, np.full(len(way_m) - 1, speeds_mps[0]))]
        found.update((orders[i].agent, route) for i, route in zip(party, routes, strict=True))
    return found


def _middles(walkable: Walkable, ends_m: Floats, parties: Sequence[Sequence[int]]) -> Floats:
    """`[party, 2]` free ground in the middle of each party; who is alone is their own middle."""
    middles_m = np.array([ends_m[party].mean(axis=0) for party in parties])
    several = np.array([len(party) > 1 for party in parties])
    middles_m[several] = walkable.snap(middles_m[several])
    return middles_m


def _together(walkable: Walkable, starts_m: Floats, goals_m: Floats, way_m: Floats, speed_mps: float) -> list[Route]:
    """Routes of people who walk along one way in formation."""
    legs_m = np.linalg.norm(np.diff(way_m, axis=0), axis=1)
    spread_m = max(np.ptp(starts_m, axis=0).max(), np.ptp(goals_m, axis=0).max())
    if legs_m.sum() < _SHORTEST_M + spread_m:
        inner_m = np.empty((len(starts_m), 0, 2))
    else:
        inner_m = _formation(walkable, _inner(way_m), starts_m)
    stations_m = np.concatenate([starts_m[:, None], inner_m, goals_m[:, None]], axis=1)
    n_members, n_stations, _ = stations_m.shape
    pieces = walkable.paths(stations_m[:, :-1].reshape(-1, 2), stations_m[:, 1:].reshape(-1, 2))
    own_m = np.array([_length_m(piece) for piece in pieces]).reshape(n_members, n_stations - 1)
    # The longest way between two stations sets the time for all; who has it walks at full speed.
    share = np.clip(own_m / np.maximum(own_m.max(axis=0), 1e-9), _SLOWEST_SHARE, 1.0)
    routes = []
    for i in range(n_members):
        row = pieces[i * (n_stations - 1) : (i + 1) * (n_stations - 1)]
        points_m = np.concatenate([*(piece[:-1] for piece in row), row[-1][-1:]])
        routes.append(Route(points_m, np.repeat(speed_mps * share[i], [len(piece) - 1 for piece in row])))
    return routes


def _inner(way_m: Floats) -> Floats:
    """The stations of a formation on a way: a little after its start, its bends, a little before its end."""
    first_m, last_m = way_m[1] - way_m[0], way_m[-2] - way_m[-1]
    after_m = way_m[0] + first_m * min(0.4, _FORM_UP_M / max(float(np.hypot(*first_m)), 1e-9))
    before_m = way_m[-1] + last_m * min(0.4, _FORM_UP_M / max(float(np.hypot(*last_m)), 1e-9))
    return np.concatenate([after_m[None], way_m[1:-1], before_m[None]])


def _formation(walkable: Walkable, stations_m: Floats, starts_m: Floats) -> Floats:
    """`[member, station, 2]` where everybody is when the party is at each station; in front whoever starts in front."""
    n = len(starts_m)
    legs = np.diff(stations_m, axis=0)
    legs /= np.maximum(np.linalg.norm(legs, axis=1, keepdims=True), 1e-9)
    arriving, leaving = np.concatenate([legs[:1], legs]), np.concatenate([legs, legs[-1:]])
    ahead = arriving + leaving
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    aside = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)

    abreast = min(n, MOST_ABREAST) if n != 4 else 2
    by_front = np.argsort(-(starts_m @ ahead[0]), kind="stable")
    offset_m, behind_m = np.empty(n), np.empty(n)
    for row in range(0, n, abreast):
        members = by_front[row : row + abreast]
        from_right = members[np.argsort(starts_m[members] @ aside[0], kind="stable")]
        offset_m[from_right] = (np.arange(len(members)) - (len(members) - 1) / 2) * ABREAST_M
        behind_m[members] = row // abreast * _ROW_M
    placed_m = (
        stations_m[None] + offset_m[:, None, None] * aside[None] - behind_m[:, None, None] * arriving[None]
    ).reshape(-1, 2)
    # Where there is no room side by side, they go one behind the other.
    narrow = ~walkable.free(placed_m)
    single_m = (stations_m[None] - behind_m[:, None, None] * arriving[None]).reshape(-1, 2)
    placed_m[narrow] = walkable.snap(single_m[narrow])
    formed_m: Floats = placed_m.reshape(n, -1, 2)
    return formed_m


def _length_m(way_m: Floats) -> float:
    return float(np.linalg.norm(np.diff(way_m, axis=0), axis=1).sum())
