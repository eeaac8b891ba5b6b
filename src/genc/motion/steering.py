"""`Steering`: what carries bodies from place to place."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray


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

    def set_target(self, agent: int, target_m: tuple[float, float], pace: float = 1.0) -> None:
        """Sends an agent to a point, at its own speed times `pace`; it counts as walking from now on.

        A target on a footprint stands for the nearest free point.
        """
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
