"""Where people stand: a slot is one person's, and who comes upon a taken one finds room beside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from genc.plan.plan import Slot
from genc.plan.walkable import Walkable

_ELBOW_M = 0.5
"""Least distance between two people who stand."""
_RINGS_M = (0.6, 0.9, 1.3, 1.8, 2.5, 3.5, 5.0)
_N_DIRECTIONS = 12
_CROWD_SPACING_M = 0.75
_CROWD_REACH = 12
_LIKELY = 40
"""So many of a crowd are kept out of other lines' crowds; there is not room for more of every line."""


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

    def give_back(self, agent: int) -> None:
        """Frees what an agent has taken."""
        self._taken_m[agent] = np.inf

    def beside(self, slot: Slot) -> Slot:
        """The nearest free ground around a slot where nobody stands; the slot itself if there is none."""
        angles_rad = np.arange(_N_DIRECTIONS) * (2 * np.pi / _N_DIRECTIONS) + slot.facing_rad
        around = np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=1)
        candidates_m = (np.array(_RINGS_M)[:, None, None] * around).reshape(-1, 2) + slot.position_m
        fit = np.flatnonzero(self._walkable.free(candidates_m) & ~self._crowded(candidates_m))
        if not len(fit):
            return slot
        x_m, y_m = candidates_m[fit[0]].tolist()
        return Slot((x_m, y_m), slot.facing_rad)

    def _crowded(self, points_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of these points, all near each other, are too near to somebody."""
        low_m, high_m = points_m.min(axis=0) - _ELBOW_M, points_m.max(axis=0) + _ELBOW_M
        near_m = self._taken_m[((self._taken_m > low_m) & (self._taken_m < high_m)).all(axis=1)]
        apart_m = np.linalg.norm(points_m[:, None] - near_m, axis=2)
        return np.asarray((apart_m < _ELBOW_M).any(axis=1))


def crowds_behind(lines: Sequence[Sequence[Slot]], walkable: Walkable) -> list[list[Slot]]:
    """For each line, where people stand who find no room in it: around its end, nearest first, in nobody's line."""
    standing_m = [np.array([slot.position_m for slot in line]) for line in lines]
    crowds = []
    for i, line in enumerate(lines):
        offsets = np.indices((2 * _CROWD_REACH + 1,) * 2).reshape(2, -1).T - _CROWD_REACH
        points_m = np.array(line[-1].position_m) + _CROWD_SPACING_M * offsets
        apart_m = KDTree(np.concatenate(standing_m)).query(points_m)[0]
        points_m = points_m[walkable.free(points_m) & (apart_m > _ELBOW_M)]
        order = np.argsort(np.linalg.norm(points_m - line[-1].position_m, axis=1), kind="stable")
        standing_m[i] = np.concatenate([standing_m[i], points_m[order[:_LIKELY]]])
        crowds.append([Slot((x_m, y_m), line[-1].facing_rad) for x_m, y_m in points_m[order].tolist()])
    return crowds
