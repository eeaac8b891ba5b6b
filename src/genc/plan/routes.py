"""`Routes`: shortest ways around axis-aligned rectangles.

A shortest way among rectangles is straight from corner to corner. So the corners that see each other are a graph,
its shortest paths are known once and for all, and a query only has to find the corners that its two ends see.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import shortest_path

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_TOUCH_M = 1e-9
"""A segment that runs this deep along a rectangle's side still passes it."""
_CHUNK = 2_000_000
"""Numbers held at once in an array of pairs times corners."""


class Routes:
    """Shortest ways among obstacles.

    Args:
        obstacles_m: [k, 4] as xmin, ymin, xmax, ymax; their insides cannot be crossed, their sides can be followed.
        corners_m: [c, 2] the points at which a way may turn: obstacle corners on free ground.
    """

    def __init__(self, obstacles_m: Floats, corners_m: Floats) -> None:
        self._centre_m = (obstacles_m[:, :2] + obstacles_m[:, 2:]) / 2
        self._half_m = (obstacles_m[:, 2:] - obstacles_m[:, :2]) / 2
        self._corners_m = corners_m
        # Infinity, not zero, says that there is no edge: two corners may fall upon one point.
        edges_m = self._straight_m(corners_m, corners_m)
        self._between_m, before = shortest_path(np.ma.masked_invalid(edges_m), return_predecessors=True)
        self._before = before.astype(np.int64)

    def lengths_m(self, starts_m: Floats, goals_m: Floats) -> Floats:
        """Lengths of the shortest ways, [n, m]; infinite where there is none."""
        direct_m = self._straight_m(starts_m, goals_m)
        if not len(self._corners_m):
            return direct_m
        from_m = self._to_corners_m(starts_m)
        to_m = self._straight_m(goals_m, self._corners_m)
        for rows in _chunks(len(starts_m), to_m.size):
            around_m = (from_m[rows, None, :] + to_m).min(axis=2)
            direct_m[rows] = np.minimum(direct_m[rows], around_m)
        return direct_m

    def ways(self, starts_m: Floats, goals_m: Floats) -> list[Floats]:
        """The shortest way of each pair, [p, 2] with both ends; straight where there is none."""
        ways = list(np.stack([starts_m, goals_m], axis=1))
        bent = np.flatnonzero(~self.clear(starts_m, goals_m))
        if not len(bent) or not len(self._corners_m):
            return ways
        for row, corners in zip(bent.tolist(), self._corners_between(starts_m[bent], goals_m[bent]), strict=True):
            ways[row] = np.concatenate([ways[row][:1], self._corners_m[corners], ways[row][1:]])
        return ways

    def clear(self, starts_m: Floats, goals_m: Floats) -> Bools:
        """Whether the segment from start to goal crosses no obstacle; starts and goals broadcast to [..., 2]."""
        middle_m = ((starts_m + goals_m) / 2)[..., None, :] - self._centre_m
        reach_m = ((goals_m - starts_m) / 2)[..., None, :]
        span_m = np.abs(reach_m)
        apart = (np.abs(middle_m) >= span_m + self._half_m - _TOUCH_M).any(axis=-1)
        # The third separating axis of a segment and a rectangle: across the segment.
        across = np.abs(middle_m[..., 0] * reach_m[..., 1] - middle_m[..., 1] * reach_m[..., 0])
        room = self._half_m[:, 0] * span_m[..., 1] + self._half_m[:, 1] * span_m[..., 0]
        apart |= across >= room - _TOUCH_M * span_m.sum(axis=-1)
        return np.asarray(apart.all(axis=-1))

    def _straight_m(self, starts_m: Floats, goals_m: Floats) -> Floats:
        """Distances [n, m] as the crow flies; infinite where an obstacle is between."""
        straight_m = np.linalg.norm(starts_m[:, None] - goals_m, axis=2)
        for rows in _chunks(len(starts_m), 8 * len(goals_m) * max(1, len(self._half_m))):
            straight_m[rows][~self.clear(starts_m[rows, None], goals_m)] = np.inf
        return straight_m

    def _to_corners_m(self, starts_m: Floats) -> Floats:
        """Lengths [n, c] of the shortest ways to every corner."""
        seen_m = self._straight_m(starts_m, self._corners_m)
        to_m = np.empty_like(seen_m)
        for rows in _chunks(len(starts_m), self._between_m.size):
            to_m[rows] = (seen_m[rows, :, None] + self._between_m).min(axis=1)
        return to_m

    def _corners_between(self, starts_m: Floats, goals_m: Floats) -> Iterator[list[int]]:
        """For each pair, the corners at which its way turns, in order; none where there is no way."""
        seen_m = self._straight_m(starts_m, self._corners_m)
        left_m = self._straight_m(goals_m, self._corners_m)
        for rows in _chunks(len(starts_m), self._between_m.size):
            to_m = seen_m[rows, :, None] + self._between_m
            last = (to_m.min(axis=1) + left_m[rows]).argmin(axis=1)
            pairs = np.arange(len(last))
            first = to_m[pairs, :, last].argmin(axis=1)
            found = np.isfinite(to_m[pairs, first, last] + left_m[rows][pairs, last])
            for a, b, exists in zip(first.tolist(), last.tolist(), found.tolist(), strict=True):
                yield self._walk_back(a, b) if exists else []

    def _walk_back(self, first: int, last: int) -> list[int]:
        corners = [last]
        while corners[-1] != first:
            corners.append(int(self._before[first, corners[-1]]))
        return corners[::-1]


def _chunks(n_rows: int, row_size: int) -> Iterator[slice]:
    """Slices of the rows, so that the rows of one slice hold at most `_CHUNK` numbers."""
    step = max(1, _CHUNK // max(1, row_size))
    return (slice(low, low + step) for low in range(0, n_rows, step))
