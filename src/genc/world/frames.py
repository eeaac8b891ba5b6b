"""Frames as small integers: positions on a grid of centimetres, headings on 65,536 directions.

Both are written as differences from frame to frame (the first frame from zero), modulo 65,536: most people stand
most of the time, so nearly all numbers are zero and pack well, and a running sum brings everything back.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.motion.motion import Motion

QUANTUM_M = 0.01
"""The grid of positions. It is coarser only for a world of more than 655 metres: 65,535 cells must do."""

_DIRECTIONS = 65_536

Words = NDArray[np.uint16]


@dataclass(frozen=True)
class Grid:
    """Where cell (0, 0) is and how wide a cell is, metres."""

    origin_m: tuple[float, float]
    quantum_m: float


def grid_of(motion: Motion) -> Grid:
    """The grid on which all positions of a motion fit."""
    if not motion.positions_m.size:
        return Grid((0.0, 0.0), QUANTUM_M)
    least_m = motion.positions_m.min(axis=(0, 1)).astype(np.float64)
    most_m = motion.positions_m.max(axis=(0, 1)).astype(np.float64)
    coarser = np.ceil((most_m - least_m).max() / QUANTUM_M / (_DIRECTIONS - 2))
    quantum_m = QUANTUM_M * max(1.0, float(coarser))
    x_m, y_m = np.round(np.rint(least_m / quantum_m) * quantum_m, 6).tolist()
    return Grid((x_m, y_m), quantum_m)


def pack(motion: Motion, grid: Grid) -> tuple[Words, Words]:
    """Differences of positions `[t, a, 2]` and of headings `[t, a]`."""
    cells = np.rint((motion.positions_m - np.array(grid.origin_m)) / grid.quantum_m)
    directions = np.rint(motion.headings_rad * (_DIRECTIONS / (2 * np.pi))).astype(np.int64) % _DIRECTIONS
    return _differences(np.maximum(cells, 0).astype(np.uint16)), _differences(directions.astype(np.uint16))


def unpack(positions: Words, headings: Words, grid: Grid) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Positions in metres and headings in (-pi, pi], from their differences."""
    cells = np.cumsum(positions, axis=0, dtype=np.uint16)
    directions = np.cumsum(headings, axis=0, dtype=np.uint16).view(np.int16)
    positions_m = cells * np.float32(grid.quantum_m)
    positions_m += np.array(grid.origin_m, dtype=np.float32)
    return positions_m, directions * np.float32(2 * np.pi / _DIRECTIONS)


def _differences(values: Words) -> Words:
    return np.diff(values, axis=0, prepend=np.zeros_like(values[:1]))
