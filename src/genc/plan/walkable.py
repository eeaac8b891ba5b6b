"""The free ground of an environment, and the shortest ways across it.

All footprints are axis-aligned rectangles. What is solid is said in `docs/conventions.md`: buildings, unless other
locations lie inside them, and small furniture, items, exhibits and service areas. Everything else is ground.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import distance_transform_edt, label
from scipy.sparse.csgraph import shortest_path

from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Category

Floats = NDArray[np.float64]

BODY_RADIUS_M = 0.25
"""Kept clear of every footprint."""
MARGIN_M = 6.0
"""Walkable ground round everything."""
LARGE_M2 = 40.0
"""A thing with a larger footprint is an area with such things in it: a ring of benches, a market."""
CELL_M = 0.2

_THINGS = (Category.FURNITURE, Category.ITEM, Category.EXHIBIT, Category.SERVICE_AREA)


def is_solid(environment: Environment) -> NDArray[np.bool_]:
    """For each location, whether its footprint is an obstacle, `[n_locations]`."""
    places = environment.locations
    return np.array([_is_solid(place, [other for other in places if other is not place]) for place in places])


def _is_solid(place: Location, others: Sequence[Location]) -> bool:
    holds_another = any(_holds(place, other) for other in others)
    if place.category is Category.BUILDING:
        return not holds_another
    width_m, depth_m = place.size_m
    return place.category in _THINGS and width_m * depth_m <= LARGE_M2 and not holds_another


def _holds(place: Location, other: Location) -> bool:
    """Whether the other is smaller and its centre lies inside, well away from the edge (a door lies on it)."""
    if other.category is Category.ENTRANCE or math.prod(other.size_m) >= math.prod(place.size_m):
        return False
    return all(
        abs(b - a) < size / 2 - min(0.5, size / 4)
        for a, b, size in zip(place.position_m, other.position_m, place.size_m, strict=True)
    )


class Walkable:
    """Free ground with shortest ways round the obstacles.

    Attributes:
        obstacles_m: `[k, 4]` solid footprints (xmin, ymin, xmax, ymax).
        bounds_m: (xmin, ymin, xmax, ymax) of the world.
    """

    def __init__(self, obstacles_m: Floats, bounds_m: tuple[float, float, float, float]) -> None:
        self.obstacles_m, self.bounds_m = obstacles_m, bounds_m
        self._kept_clear = obstacles_m + BODY_RADIUS_M * np.array([-1.0, -1.0, 1.0, 1.0])

    @staticmethod
    def of(environment: Environment) -> Walkable:
        """The free ground of an environment."""
        boxes = np.array([box_of(place) for place in environment.locations]).reshape(-1, 4)
        bounds = (*(boxes[:, :2].min(0) - MARGIN_M).tolist(), *(boxes[:, 2:].max(0) + MARGIN_M).tolist())
        return Walkable(boxes[is_solid(environment)], bounds)

    def free(self, points_m: ArrayLike) -> NDArray[np.bool_]:
        """bool `[n]`: inside the bounds, a body's radius clear of every obstacle, and reachable."""
        points = np.asarray(points_m, dtype=float).reshape(-1, 2)
        clear = self.clear(points)
        clear[clear] = self._main[self._cell(points[clear])]
        return clear

    def clear(self, points_m: ArrayLike) -> NDArray[np.bool_]:
        """bool `[n]`: inside the bounds and a body's radius clear of every obstacle, perhaps out of reach."""
        points = np.asarray(points_m, dtype=float).reshape(-1, 2)
        x, y = points[:, :1], points[:, 1:]
        box = self._kept_clear
        hit = (x > box[:, 0]) & (x < box[:, 2]) & (y > box[:, 1]) & (y < box[:, 3])
        low, high = np.array(self.bounds_m[:2]), np.array(self.bounds_m[2:])
        inside = ((points >= low) & (points <= high)).all(axis=1)
        return np.asarray(inside & ~hit.any(axis=1), dtype=bool)

    def snap(self, points_m: ArrayLike) -> Floats:
        """`[n, 2]`: the points themselves where they are free, else the nearest free ground."""
        points = np.array(points_m, dtype=float).reshape(-1, 2)
        lost = ~self.free(points)
        columns, rows = self._nearest[:, *self._cell(points[lost])]
        points[lost] = self._centre(columns, rows)
        return points

    def path(self, start_m: ArrayLike, goal_m: ArrayLike) -> Floats:
        """`[p, 2]` the shortest way, both ends included."""
        return self.paths(np.reshape(start_m, (1, 2)), np.reshape(goal_m, (1, 2)))[0]

    def paths(self, starts_m: ArrayLike, goals_m: ArrayLike) -> list[Floats]:
        """The shortest way from each start `[n, 2]` to its own goal `[n, 2]`."""
        starts, goals = np.asarray(starts_m, dtype=float), np.asarray(goals_m, dtype=float)
        ways = [np.stack(ends) for ends in zip(starts, goals, strict=True)]
        round_about = np.flatnonzero(self._blocked(starts, goals))
        if len(round_about) == 0 or len(self._corners) == 0:
            return ways
        first, last = self._to_corners(starts[round_about]), self._to_corners(goals[round_about])
        ahead = (first[:, :, None] + self._between[None]).min(1) + last  # (n, corner)
        for row, end in zip(round_about, ahead.argmin(1), strict=True):
            i = int(np.searchsorted(round_about, row))
            if np.isfinite(ahead[i, end]):
                begin = int((first[i] + self._between[:, end]).argmin())
                ways[row] = np.concatenate(
                    [starts[row, None], self._corners[self._chain(begin, int(end))], goals[row, None]]
                )
        return ways

    def distances(self, starts_m: ArrayLike, goals_m: ArrayLike) -> Floats:
        """`[n, m]` metres of the shortest way from each start `[n, 2]` to each goal `[m, 2]`."""
        starts, goals = np.asarray(starts_m, dtype=float), np.asarray(goals_m, dtype=float)
        n, m = len(starts), len(goals)
        straight: Floats = np.linalg.norm(starts[:, None] - goals[None], axis=2)
        blocked = self._blocked(np.repeat(starts, m, axis=0), np.tile(goals, (n, 1))).reshape(n, m)
        if not blocked.any() or len(self._corners) == 0:
            return straight
        ahead = (self._to_corners(starts)[:, :, None] + self._between[None]).min(1)
        round_about = (ahead[:, None, :] + self._to_corners(goals)[None]).min(2)
        # where no way is known the straight line stands in, so that nothing is infinitely far
        best: Floats = np.where(blocked & np.isfinite(round_about), round_about, straight)
        return best

    def _blocked(self, starts: Floats, ends: Floats) -> NDArray[np.bool_]:
        """bool `[n]`: the straight line from start to end crosses what is kept clear (slab test)."""
        low, high = self._kept_clear[:, :2] + 1e-6, self._kept_clear[:, 2:] - 1e-6
        step = (ends - starts)[:, None]
        step = np.where(np.abs(step) < 1e-12, 1e-12, step)
        to_low, to_high = (low - starts[:, None]) / step, (high - starts[:, None]) / step
        enter = np.minimum(to_low, to_high).max(2)
        leave = np.maximum(to_low, to_high).min(2)
        crossed: NDArray[np.bool_] = ((enter < leave) & (leave > 0) & (enter < 1)).any(1)
        return crossed

    @cached_property
    def _corners(self) -> Floats:
        """`[c, 2]` the turning points of shortest ways."""
        x0, y0, x1, y1 = (self._kept_clear + 1e-3 * np.array([-1.0, -1.0, 1.0, 1.0])).T
        corners = np.concatenate([np.stack(c, axis=1) for c in ((x0, y0), (x0, y1), (x1, y0), (x1, y1))])
        return corners[self.clear(corners)]

    def _to_corners(self, points: Floats) -> Floats:
        """`[n, c]` metres in a straight line; infinite where the line is blocked."""
        n, c = len(points), len(self._corners)
        blocked = self._blocked(np.repeat(points, c, axis=0), np.tile(self._corners, (n, 1))).reshape(n, c)
        return np.where(blocked, np.inf, np.linalg.norm(points[:, None] - self._corners[None], axis=2))

    @cached_property
    def _roads(self) -> tuple[Floats, NDArray[np.int32]]:
        lengths, before = shortest_path(self._to_corners(self._corners), directed=False, return_predecessors=True)
        return lengths, before

    @property
    def _between(self) -> Floats:
        """`[c, c]` metres of the shortest way between corners."""
        return self._roads[0]

    def _chain(self, begin: int, end: int) -> list[int]:
        """The corners of the shortest way between two corners."""
        chain = [end]
        while chain[-1] != begin:
            chain.append(int(self._roads[1][begin, chain[-1]]))
        return chain[::-1]

    # A grid tells which ground hangs together.

    @cached_property
    def _main(self) -> NDArray[np.bool_]:
        """bool `[columns, rows]`: cells of the one part of the ground that reaches the border."""
        x0, y0, x1, y1 = self.bounds_m
        shape = int((x1 - x0) / CELL_M) + 1, int((y1 - y0) / CELL_M) + 1
        cells = np.indices(shape).reshape(2, -1)
        parts, _ = label(self.clear(self._centre(*cells)).reshape(shape))
        main: NDArray[np.bool_] = parts == parts[0, 0]
        return main

    @cached_property
    def _nearest(self) -> NDArray[np.int32]:
        """`[2, columns, rows]`: for each cell the nearest cell of the main part."""
        nearest: NDArray[np.int32] = distance_transform_edt(~self._main, return_distances=False, return_indices=True)
        return nearest

    def _cell(self, points: Floats) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        at = np.floor((points - np.array(self.bounds_m[:2])) / CELL_M).astype(np.int64)
        columns, rows = np.clip(at, 0, np.array(self._main.shape) - 1).T
        return columns, rows

    def _centre(self, columns: ArrayLike, rows: ArrayLike) -> Floats:
        cells = np.stack([np.asarray(columns), np.asarray(rows)], axis=-1)
        return np.asarray((cells + 0.5) * CELL_M + np.array(self.bounds_m[:2]), dtype=np.float64)


def box_of(place: Location) -> tuple[float, float, float, float]:
    """The footprint of a location (xmin, ymin, xmax, ymax) in metres."""
    (x, y), (width, depth) = place.position_m, place.size_m
    return x - width / 2, y - depth / 2, x + width / 2, y + depth / 2
