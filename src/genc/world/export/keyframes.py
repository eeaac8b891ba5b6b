"""Paths with few frames: what can be found again by drawing straight lines between the kept ones is left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.motion.motion import Motion

Floats = NDArray[np.float64]

ERROR_M = 0.02
"""How far a position between two kept frames may be off."""
ERROR_RAD = float(np.radians(3.0))
"""How far a heading may be off."""


@dataclass(frozen=True, eq=False)
class Stay:
    """One unbroken time of a person in the scene, as keyframes `[k]`; linear in between.

    Attributes:
        frames: ascending; the first and the last frame of the stay are among them.
        positions_m: `[k, 2]`.
        headings_rad: `[k]`, without jumps: turning left twice goes beyond pi.
    """

    frames: NDArray[np.int64]
    positions_m: Floats
    headings_rad: Floats


def stays(motion: Motion, agent: int) -> list[Stay]:
    """The times of a person in the scene, in order; none for who never comes."""
    padded = np.concatenate([[False], motion.present[:, agent], [False]])
    begins, ends = np.flatnonzero(np.diff(padded.astype(np.int8))).reshape(-1, 2).T
    return [_stay(motion, agent, begin, end) for begin, end in zip(begins.tolist(), ends.tolist(), strict=True)]


def _stay(motion: Motion, agent: int, begin: int, end: int) -> Stay:
    positions_m = motion.positions_m[begin:end, agent].astype(np.float64)
    headings_rad = np.unwrap(motion.headings_rad[begin:end, agent].astype(np.float64))
    kept = kept_points(np.column_stack([positions_m / ERROR_M, headings_rad / ERROR_RAD]))
    return Stay(begin + kept, np.round(positions_m[kept], 4), np.round(headings_rad[kept], 5))


def kept_points(points: Floats) -> NDArray[np.int64]:
    """The rows of `[n, 3]` to keep, so that linear interpolation by row number is off by 1 at most.

    The distance is that of the first two columns together, or that of the third. Ramer-Douglas-Peucker in time.
    """
    n = len(points)
    keep = np.zeros(n, dtype=bool)
    keep[[0, -1]] = True
    open_spans = [(0, n - 1)]
    while open_spans:
        first, last = open_spans.pop()
        if last - first < 2:
            continue
        share = np.arange(1, last - first)[:, None] / (last - first)
        off = points[first + 1 : last] - (points[first] + share * (points[last] - points[first]))
        error = np.maximum(np.hypot(off[:, 0], off[:, 1]), np.abs(off[:, 2]))
        worst = int(error.argmax())
        if error[worst] > 1:
            middle = first + 1 + worst
            keep[middle] = True
            open_spans += [(first, middle), (middle, last)]
    return np.flatnonzero(keep)
