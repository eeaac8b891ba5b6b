"""`Kinematic`: everybody follows the shortest path at their own speed; bodies pass through each other.

Built in, exact and fast: for big crowds, bare installs, and tests.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from genc.plan.walkable import Walkable

Floats = NDArray[np.float64]

DT_S = 0.1


class Kinematic:
    """A `Steering` by shortest paths around obstacles, without avoidance.

    Each walker is on one straight leg of its path at a time. A step moves all of them at once; Python code runs
    only for those who come to the end of a leg.
    """

    def __init__(self, n_agents: int, walkable: Walkable, dt_s: float = DT_S) -> None:
        self.dt_s = dt_s
        self.positions_m = np.zeros((n_agents, 2))
        self.headings_rad = np.zeros(n_agents)
        self.walking = np.zeros(n_agents, dtype=bool)
        self._walkable = walkable
        self._own_mps = np.zeros(n_agents)
        self._speed_mps = np.zeros(n_agents)
        self._direction = np.zeros((n_agents, 2))
        self._leg_m = np.full(n_agents, np.inf)
        self._route: list[Floats] = [np.empty((0, 2))] * n_agents
        self._targets: dict[int, tuple[float, float]] = {}

    def add(self, agent: int, position_m: tuple[float, float], speed_mps: float) -> None:
        """Lets an agent stand there."""
        self.positions_m[agent] = position_m
        self._own_mps[agent] = speed_mps
        self.hold(agent)

    def set_target(self, agent: int, target_m: tuple[float, float], pace: float = 1.0) -> None:
        """Sends an agent to a point; its path is found at the next step, together with all others."""
        self.hold(agent)
        self._targets[agent] = target_m
        self._speed_mps[agent] = pace * self._own_mps[agent]
        self.walking[agent] = True

    def hold(self, agent: int) -> None:
        """Lets an agent stop."""
        self._targets.pop(agent, None)
        self.walking[agent] = False
        self._direction[agent] = 0.0
        self._leg_m[agent] = np.inf

    def remove(self, agent: int) -> None:
        """Takes an agent out."""
        self.hold(agent)

    def step(self) -> None:
        """Moves everybody on by one step."""
        self._set_off()
        way_m = self._speed_mps * self.dt_s
        self.positions_m += self._direction * way_m[:, None]
        self._leg_m -= way_m
        for agent in np.flatnonzero(self._leg_m <= 0.0).tolist():
            self._turn(agent, -float(self._leg_m[agent]))

    def _set_off(self) -> None:
        if not self._targets:
            return
        agents = list(self._targets)
        goals_m = np.array(list(self._targets.values()))
        self._targets.clear()
        paths = self._walkable.paths(self.positions_m[agents], self._walkable.snap(goals_m))
        for agent, path_m in zip(agents, paths, strict=True):
            self._route[agent] = path_m
            self._turn(agent, 0.0)

    def _turn(self, agent: int, beyond_m: float) -> None:
        """Puts an agent on the next leg of its route, `beyond_m` behind the corner; at the end, lets it stand."""
        here_m, *rest_m = self._route[agent]
        while rest_m:
            leg = rest_m[0] - here_m
            length_m = float(np.hypot(*leg))
            if length_m > beyond_m:
                direction = leg / length_m
                self._direction[agent] = direction
                self._leg_m[agent] = length_m - beyond_m
                self.positions_m[agent] = here_m + beyond_m * direction
                self.headings_rad[agent] = np.arctan2(direction[1], direction[0])
                self._route[agent] = np.array(rest_m)
                return
            beyond_m -= length_m
            here_m = rest_m.pop(0)
        self.positions_m[agent] = here_m
        self.hold(agent)
