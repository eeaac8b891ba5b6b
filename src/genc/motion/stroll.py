"""Strolls: where people who go about turn next, without leaving their place."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.plan.plan import Slot
from genc.plan.walkable import Walkable
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action

PACES = {Action.WANDER: 0.6, Action.CARRY: 0.9}
"""What people do who go about within a place, and at which share of their walking speed."""

LONGEST_PAUSE_S = 4.0
_N_TRIES = 8
_AROUND_M = 1.5
"""How far from a thing that one cannot walk through (a table, a statue) one walks around it."""
_ABREAST_M = 0.7
_LOOKING_RAD = 1.0

Floats = NDArray[np.float64]


class Strolls:
    """Draws waypoints in each location's ground."""

    def __init__(self, environment: Environment, walkable: Walkable, rng: np.random.Generator) -> None:
        self._walkable = walkable
        self._rng = rng
        self._zones_m = [_zone(location, walkable) for location in environment.locations]

    def next(self, location: int, here_m: Sequence[tuple[float, float]]) -> list[Slot]:
        """Where people who stroll together turn next, side by side.

        The first of them can go straight there; so nobody leaves a place, which is convex, by a way round.
        """
        low_m, high_m = self._zones_m[location]
        here = np.array(here_m)
        tries_m = self._rng.uniform(low_m, high_m, (_N_TRIES, 2))
        goal_m = self._straight(here[0], tries_m)
        way = goal_m - here[0]
        heading_rad = float(np.arctan2(way[1], way[0]))
        aside = np.array([-np.sin(heading_rad), np.cos(heading_rad)]) * _ABREAST_M
        goals_m = goal_m + np.arange(len(here))[:, None] * aside
        goals_m = np.clip(self._walkable.snap(goals_m), low_m, high_m)
        facing_rad = heading_rad + self._rng.uniform(-_LOOKING_RAD, _LOOKING_RAD, len(here))
        return [Slot((x, y), f) for (x, y), f in zip(goals_m.tolist(), facing_rad.tolist(), strict=True)]

    def pause_s(self) -> float:
        """How long they look around before they go on."""
        return float(self._rng.uniform(1.0, LONGEST_PAUSE_S))

    def _straight(self, here_m: Floats, tries_m: Floats) -> Floats:
        """The first of these points to which a straight way leads; where one is, if there is none."""
        fit_m = tries_m[self._walkable.free(tries_m)]
        for path_m in self._walkable.paths(np.broadcast_to(here_m, fit_m.shape), fit_m):
            if len(path_m) == 2:
                return np.asarray(path_m[1])
        return here_m


def _zone(location: Location, walkable: Walkable) -> tuple[Floats, Floats]:
    """The corners of the rectangle in which one strolls: the place itself, or if it is solid, a strip around it."""
    half_m = np.array(location.size_m) / 2
    centre_m = np.array(location.position_m)
    grid = np.stack(np.meshgrid(*[np.linspace(-0.8, 0.8, 5)] * 2), axis=-1).reshape(-1, 2)
    if not walkable.free(centre_m + grid * half_m).any():
        half_m = half_m + _AROUND_M
    return centre_m - half_m, centre_m + half_m
