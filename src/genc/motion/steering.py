"""`Steering`: what carries bodies from place to place."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Target:
    """Where somebody is sent.

    Attributes:
        point_m: a point; on a footprint it stands for the nearest free point.
        pace: the share of one's own speed at which to go.
        company: those who are sent before the same step with the same company, if it is not None, walk side by side,
            at one speed.
        near_m: how near to the point is near enough to count as there.
    """

    point_m: tuple[float, float]
    pace: float = 1.0
    company: Hashable = None
    near_m: float = 0.05


class Steering(Protocol):
    """Bodies that walk to targets, step by step; it knows no activities and no places.

    Agents are numbers from 0 to `n_agents - 1`; each is absent until it is added. A body that has reached its
    target stands still until it gets another. Entries of absent agents keep their last value.

    Attributes:
        dt_s: length of one step.
        positions_m: float64 `[a, 2]`, where everybody is; read only.
        headings_rad: float64 `[a]`, the direction in which each walked last; read only.
        walking: bool `[a]`, who is on the way to a target; read only.
    """

    dt_s: float
    positions_m: NDArray[np.float64]
    headings_rad: NDArray[np.float64]
    walking: NDArray[np.bool_]

    def add(self, agent: int, position_m: tuple[float, float], speed_mps: float) -> None:
        """Lets an absent agent stand at a point of free ground; it will walk at that speed."""
        ...

    def set_target(self, agent: int, target: Target) -> None:
        """Sends an agent somewhere; it counts as walking from now on, until it is there or is sent elsewhere."""
        ...

    def hold(self, agent: int) -> None:
        """Lets an agent stop where it is."""
        ...

    def remove(self, agent: int) -> None:
        """Takes an agent out of the scene."""
        ...

    def step(self) -> None:
        """Lets `dt_s` pass."""
        ...
