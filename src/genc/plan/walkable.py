"""`Walkable`: the ground of an environment on which people can stand and walk (docs/conventions.md)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from genc.errors import LayoutError
from genc.plan.routes import Bools, Floats, Ints, Routes
from genc.scenario.scenario import Environment
from genc.words.vocabulary import Category

BODY_RADIUS_M = 0.25
"""How near the middle of a person may come to something solid."""
MARGIN_M = 6.0
"""Walkable ground on every side of the outermost footprint."""

_NEVER_SOLID = frozenset({Category.ROOM, Category.OUTDOOR_AREA, Category.ENTRANCE})
_DEEPEST_SOLID_M = {
    Category.BUILDING: np.inf,
    Category.FURNITURE: 3.0,
    Category.ITEM: 6.0,
    Category.EXHIBIT: 6.0,
    Category.SERVICE_AREA: 6.0,
}
"""The longest short side of a solid thing. A bench is solid, a food court's seating is floor to walk through."""
_INSIDE_SHARE = 0.6
"""The share of a location's footprint that must lie in another's for it to be inside."""
_EDGE_M = 1e-6


@dataclass(frozen=True, eq=False)
class Walkable:
    """Free ground and the ways on it; built once for an environment.

    A point is free if a body of radius `BODY_RADIUS_M` can stand there and walk to the outside. Ground that solid
    things enclose is not free.

    Attributes:
        obstacles_m: [k, 4] footprints of the solid locations as xmin, ymin, xmax, ymax.
        bounds_m: [4] the end of the world: all footprints and a margin of walkable ground around them.
    """

    obstacles_m: Floats
    bounds_m: Floats

    @classmethod
    def of(cls, environment: Environment) -> Walkable:
        """The ground of an environment.

        Raises:
            LayoutError: for an environment without locations.
        """
        if not environment.locations:
            raise LayoutError("the environment has no locations: give it at least one")
        boxes_m = footprints_m(environment)
        bounds_m = np.concatenate([boxes_m[:, :2].min(axis=0) - MARGIN_M, boxes_m[:, 2:].max(axis=0) + MARGIN_M])
        return cls(boxes_m[is_solid(environment)], bounds_m)

    def free(self, points_m: Floats) -> Bools:
        """Whether one can stand there and get away, [n] for points [n, 2]."""
        points_m = np.asarray(points_m, dtype=float).reshape(-1, 2)
        within = ((points_m >= self.bounds_m[:2]) & (points_m <= self.bounds_m[2:])).all(axis=1)
        return np.asarray(within & ~_inside(points_m, self._blocked_m))

    def snap(self, points_m: Floats) -> Floats:
        """The nearest free points, [n, 2]; a free point stays where it is."""
        points_m = np.array(points_m, dtype=float).reshape(-1, 2)
        for i in np.flatnonzero(~self.free(points_m)).tolist():
            nearest_m = np.clip(points_m[i], self._open_m[:, :2], self._open_m[:, 2:])
            points_m[i] = nearest_m[((nearest_m - points_m[i]) ** 2).sum(axis=1).argmin()]
        return points_m

    def path(self, start_m: Floats, goal_m: Floats) -> Floats:
        """The shortest way, [p, 2] with both ends; see `paths`."""
        return self.paths(np.asarray(start_m)[None], np.asarray(goal_m)[None])[0]

    def paths(self, starts_m: Floats, goals_m: Floats) -> list[Floats]:
        """The shortest ways around everything solid, start by start, each [p, 2] with both ends.

        An end that is not free is left, or reached, straight over the nearest free point.
        """
        starts_m, goals_m = (np.asarray(ends_m, dtype=float).reshape(-1, 2) for ends_m in (starts_m, goals_m))
        from_m, to_m = self.snap(starts_m), self.snap(goals_m)
        ways = self._routes.ways(from_m, to_m)
        for i in np.flatnonzero((from_m != starts_m).any(axis=1)).tolist():
            ways[i] = np.concatenate([starts_m[i : i + 1], ways[i]])
        for i in np.flatnonzero((to_m != goals_m).any(axis=1)).tolist():
            ways[i] = np.concatenate([ways[i], goals_m[i : i + 1]])
        return ways

    def distances(self, starts_m: Floats, goals_m: Floats) -> Floats:
        """Metres to walk from each start to each goal, [n, m]; ends that are not free count from where they snap."""
        return self._routes.lengths_m(self.snap(starts_m), self.snap(goals_m))

    def clear(self, starts_m: Floats, goals_m: Floats) -> Bools:
        """Whether one can walk straight from start to goal; both broadcast to [..., 2]."""
        return self._routes.clear(np.asarray(starts_m, dtype=float), np.asarray(goals_m, dtype=float))

    @cached_property
    def _inflated_m(self) -> Floats:
        return self.obstacles_m + np.array([-1, -1, 1, 1]) * BODY_RADIUS_M

    @cached_property
    def _cells(self) -> tuple[Floats, NDArray[np.int32]]:
        """The bounds cut along all obstacle sides: cells [c, 4] and for each its connected ground, 0 if blocked."""
        xs_m, ys_m = (np.unique(np.concatenate([self._inflated_m[:, i::2].ravel(), self.bounds_m[i::2]])) for i in (0, 1))
        low_m = np.stack(np.meshgrid(xs_m[:-1], ys_m[:-1], indexing="ij"), axis=-1)
        high_m = np.stack(np.meshgrid(xs_m[1:], ys_m[1:], indexing="ij"), axis=-1)
        blocked = _inside(((low_m + high_m) / 2).reshape(-1, 2), self._inflated_m).reshape(low_m.shape[:2])
        grounds, _ = label(~blocked)
        return np.concatenate([low_m, high_m], axis=-1).reshape(-1, 4), grounds.ravel()

    @cached_property
    def _open_m(self) -> Floats:
        """Cells [c, 4] of the ground that reaches the end of the world, drawn in so that their edges are free."""
        cells_m, grounds = self._cells
        open_m = cells_m[grounds == grounds[0]]
        inset_m = np.minimum((open_m[:, 2:] - open_m[:, :2]) / 2, _EDGE_M)
        return open_m + np.concatenate([inset_m, -inset_m], axis=1)

    @cached_property
    def _blocked_m(self) -> Floats:
        """Where nobody can stand, [b, 4]: solid things, with a body's radius around them, and enclosed ground."""
        cells_m, grounds = self._cells
        enclosed = (grounds != grounds[0]) & (grounds != 0)
        return np.concatenate([self._inflated_m, cells_m[enclosed]])

    @cached_property
    def _routes(self) -> Routes:
        x = self._inflated_m + np.array([-1, -1, 1, 1]) * _EDGE_M
        corners_m = x[:, [[0, 1], [2, 1], [2, 3], [0, 3]]].reshape(-1, 2)
        return Routes(self._inflated_m, corners_m[self.free(corners_m)])


def footprints_m(environment: Environment) -> Floats:
    """The rectangles of all locations, [l, 4] as xmin, ymin, xmax, ymax."""
    centres_m = np.array([location.position_m for location in environment.locations])
    halves_m = np.array([location.size_m for location in environment.locations]) / 2
    return np.concatenate([centres_m - halves_m, centres_m + halves_m], axis=1)


def is_solid(environment: Environment) -> Bools:
    """Which locations are obstacles, [l].

    Rooms, outdoor areas and entrances never are. A building and a thing are, unless another location lies inside
    it or it is so deep that it must be floor (a food court's seating, a show ring).
    """
    locations = environment.locations
    deepest_m = np.array([_DEEPEST_SOLID_M.get(location.category, 0.0) for location in locations])
    depth_m = np.array([min(location.size_m) for location in locations])
    return np.asarray((depth_m <= deepest_m) & (hosts(environment) == np.arange(len(locations))[:, None]).sum(axis=1) == 0)
