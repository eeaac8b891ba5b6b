"""`Kinematic`: everybody follows the shortest path at their own speed; bodies pass through each other.

Built in, exact and fast: for big crowds, bare installs, and tests.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from genc.motion.routes import Order, find_routes
from genc.motion.steering import Target
from genc.plan.walkable import Walkable

Floats = NDArray[np.float64]

DT_S = 0.1


class Kinematic:
    """A `Steering` by shortest paths around obstacles, without avoidance.

    Each walker is on one straight leg of its route at a time. A step moves all of them at once; Python code runs
    only for those who come to the end of a leg.
    """

    def __init__(self, n_agents: int, walkable: Walkable, dt_s: float = DT_S) -> None:
        self.dt_s = dt_s
        self.positions_m = np.zeros((n_agents, 2))
        self.headings_rad = np.zeros(n_agents)
        self.walking = np.zeros(n_agents, dtype=bool)
        self._walkable = walkable
        self._own_mps = np.zeros(n_agents)
        self._velocity_mps = np.zeros((n_agents, 2))
        self._left_s = np.full(n_agents, np.inf)
        """How long each walker is still on the leg it is on."""
        self._legs: list[Iterator[tuple[Floats, Floats, float]]] = [iter(()) for _ in range(n_agents)]
        self._end_m = np.zeros((n_agents, 2))
        self._orders: dict[int, Order] = {}

    def add(self, agent: int, position_m: tuple[float, float], speed_mps: float) -> None:
        """Lets an agent stand there."""
        self.positions_m[agent] = position_m
        self._own_mps[agent] = speed_mps
        self.hold(agent)

    def set_target(self, agent: int, target: Target) -> None:
        """Sends an agent somewhere; its route is found at the next step, together with all others."""
        self.hold(agent)
        x_m, y_m = self.positions_m[agent].tolist()
        self._orders[agent] = Order(agent, (x_m, y_m), target, target.pace * float(self._own_mps[agent]))
        self.walking[agent] = True

    def hold(self, agent: int) -> None:
        """Lets an agent stop."""
        self._orders.pop(agent, None)
        self.walking[agent] = False
        self._velocity_mps[agent] = 0.0
        self._left_s[agent] = np.inf

    def remove(self, agent: int) -> None:
        """Takes an agent out."""
        self.hold(agent)

    def step(self) -> None:
        """Moves everybody on by one step."""
        self._set_off()
        self.positions_m += self._velocity_mps * self.dt_s
        self._left_s -= self.dt_s
        for agent in np.flatnonzero(self._left_s <= 0.0).tolist():
            self._turn(agent, -float(self._left_s[agent]))

    def _set_off(self) -> None:
        if not self._orders:
            return
        routes = find_routes(self._walkable, list(self._orders.values()))
        self._orders.clear()
        for agent, route in routes.items():
            starts_m, velocities_mps = route.points_m[:-1], route.velocities_mps
            self._legs[agent] = zip(starts_m, velocities_mps, route.durations_s.tolist(), strict=True)
            self._end_m[agent] = route.points_m[-1]
            self._turn(agent, 0.0)

    def _turn(self, agent: int, late_s: float) -> None:
        """Puts an agent on the next leg of its route, `late_s` after its start; at the end, lets it stand."""
        for start_m, velocity_mps, duration_s in self._legs[agent]:
            if duration_s > late_s:
                self._velocity_mps[agent] = velocity_mps
                self._left_s[agent] = duration_s - late_s
                self.positions_m[agent] = start_m + late_s * velocity_mps
                self.headings_rad[agent] = np.arctan2(velocity_mps[1], velocity_mps[0])
                return
            late_s -= duration_s
        self.positions_m[agent] = self._end_m[agent]
        self.hold(agent)
