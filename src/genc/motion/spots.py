"""Where people stand: a slot is one person's, and who comes upon a taken one finds room beside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.plan.plan import Slot
from genc.plan.walkable import Walkable

_ELBOW_M = 0.5
"""Least distance between two people who stand."""
_RINGS_M = (0.6, 0.9, 1.3, 1.8, 2.5, 3.5, 5.0)
_N_DIRECTIONS = 12
_GRID_M = np.array([(0.75 * i, 0.75 * j) for i in range(-20, 21) for j in range(-20, 21)])
_GRID_M = _GRID_M[np.argsort(np.linalg.norm(_GRID_M, axis=1), kind="stable")]
"""Where a crowd stands that has filled the rings."""


class Spots:
    """Who stands where; a plan gives each their own slot, but plans may run late.

    Args:
        n_agents: people.
        walkable: the free ground.
        kept_free: slots where nobody just stands: service slots.
    """

    def __init__(self, n_agents: int, walkable: Walkable, kept_free: Sequence[Slot]) -> None:
        self._walkable = walkable
        kept_free_m = np.array([slot.position_m for slot in kept_free]).reshape(-1, 2)
        self._taken_m = np.concatenate([np.full((n_agents, 2), np.inf), kept_free_m])

    def take(self, agent: int, slot: Slot) -> Slot:
        """The slot itself, or if somebody stands there, the nearest room beside it with the same outlook."""
        self.give_back(agent)
        if self._crowded(np.array([slot.position_m]))[0]:
            slot = self.beside(slot)
        self._taken_m[agent] = slot.position_m
        return slot

    def hold(self, agent: int, slot: Slot) -> None:
        """Takes exactly this slot, whoever stands there: in a line there is no choice."""
        self._taken_m[agent] = slot.position_m

    def give_back(self, agent: int) -> None:
        """Frees what an agent has taken."""
        self._taken_m[agent] = np.inf

    def beside(self, slot: Slot) -> Slot:
        """The nearest free ground around a slot where nobody stands; the slot itself if there is none."""
        angles_rad = np.arange(_N_DIRECTIONS) * (2 * np.pi / _N_DIRECTIONS) + slot.facing_rad
        around = np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=1)
        rings_m: NDArray[np.float64] = (np.array(_RINGS_M)[:, None, None] * around).reshape(-1, 2)
        for offsets_m in (rings_m, _GRID_M):
            candidates_m: NDArray[np.float64] = offsets_m + slot.position_m
            fit = np.flatnonzero(self._walkable.free(candidates_m) & ~self._crowded(candidates_m))
            if len(fit):
                x_m, y_m = candidates_m[fit[0]].tolist()
                return Slot((x_m, y_m), slot.facing_rad)
        return slot

    def _crowded(self, points_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of these points, all near each other, are too near to somebody."""
        low_m, high_m = points_m.min(axis=0) - _ELBOW_M, points_m.max(axis=0) + _ELBOW_M
        near_m = self._taken_m[((self._taken_m > low_m) & (self._taken_m < high_m)).all(axis=1)]
        apart_m = np.linalg.norm(points_m[:, None] - near_m, axis=2)
        return np.asarray((apart_m < _ELBOW_M).any(axis=1))
