"""`JuPedSim`: people who walk round each other, by the collision-free speed model of JuPedSim.

One simulation, one direct-steering stage, one journey for everybody (jupedsim 1.4; not 2). The model knows no places,
no lines and no facing; the executor does. Where there is no way past
the others people push through: they leave the
simulation and walk on as if alone, until there is room for them in it again.

Source: Tordeux, Chraibi, Seyfried, "Collision-free speed model for pedestrian dynamics" (2016); parameters are the
library's unless said.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from genc.errors import ExtraError
from genc.motion.routes import Order, find_routes
from genc.motion.steering import Target
from genc.motion.walk import BROAD, Company, Walk, Way
from genc.plan.ground import ground_polygon, on_ground
from genc.plan.walkable import Walkable

if TYPE_CHECKING:
    import jupedsim

Floats = NDArray[np.float64]

DT_S = 0.1
"""One step of the steering."""
N_ITERATIONS = 2
"""Iterations of the model in it."""
_EDGE_M = 0.01
"""Nobody's middle comes so near to the edge of the ground that rounding to centimetres puts it there."""
_GIVE_M = 0.15
"""How much wider the ground is for the model than it is. People are pushed over its edge in a press, and the library
stops at anybody who is off its ground; so whoever is off the real one is put back before the next iteration."""
_PUSHING = 0.5
"""The share of their speed at which people push through."""
_AT_M = 1e-6
"""Who is so near to a bend is there; from there the next is in sight."""
_MOVES_MPS = 0.15
"""Who is slower shows no direction."""
_SMOOTHING = 0.35


class JuPedSim:
    """A `Steering` with collision avoidance.

    Args:
        n_agents: people.
        walkable: the ground.

    Raises:
        ExtraError: if jupedsim is not installed.
    """

    def __init__(self, n_agents: int, walkable: Walkable) -> None:
        self.dt_s = DT_S
        self.positions_m = np.zeros((n_agents, 2))
        self.headings_rad = np.zeros(n_agents)
        self.walking = np.zeros(n_agents, dtype=bool)
        self._jupedsim = library()
        self._walkable = walkable
        self._ground = ground_polygon(walkable, -_EDGE_M)
        self._simulation: jupedsim.Simulation = self._jupedsim.Simulation(
            model=self._jupedsim.CollisionFreeSpeedModelV2(),
            geometry=ground_polygon(walkable, _GIVE_M),
            dt=DT_S / N_ITERATIONS,
        )
        self._stage = self._simulation.add_direct_steering_stage()
        self._journey = self._simulation.add_journey(self._jupedsim.JourneyDescription([self._stage]))
        self._own_mps = np.zeros(n_agents)
        self._velocities_mps = np.zeros((n_agents, 2))
        self._orders: dict[int, Order] = {}
        self._walks: dict[int, Walk] = {}
        self._halted: set[int] = set()
        """Who has stopped walking since the last step."""
        self._outside: dict[int, None] = {}
        """Who is not in the simulation because there is no room where they are; first come first."""
        self._bodies: dict[int, int] = {}
        """The number in the simulation of each agent, and the other way round."""
        self._agents: dict[int, int] = {}

    def add(self, agent: int, position_m: tuple[float, float], speed_mps: float) -> None:
        """Lets an agent stand there."""
        self.remove(agent)
        self.positions_m[agent] = position_m
        self._velocities_mps[agent] = 0.0
        self._own_mps[agent] = speed_mps
        self._outside[agent] = None
        self._let_in(agent)

    def set_target(self, agent: int, target: Target) -> None:
        """Sends an agent somewhere; its route is found at the next step, together with all others."""
        x_m, y_m = self.positions_m[agent].tolist()
        self._orders[agent] = Order(agent, (x_m, y_m), target, target.pace * float(self._own_mps[agent]))
        self.walking[agent] = True

    def hold(self, agent: int) -> None:
        """Lets an agent stop."""
        self._orders.pop(agent, None)
        if self._walks.pop(agent, None) is not None:
            self._halted.add(agent)
        self.walking[agent] = False

    def remove(self, agent: int) -> None:
        """Takes an agent out."""
        self.hold(agent)
        self._halted.discard(agent)
        self._take_out(agent)
        self._outside.pop(agent, None)

    def step(self) -> None:
        """Moves everybody on by one step."""
        self._set_off()
        for agent in list(self._outside):
            self._let_in(agent)
        before_m = self.positions_m.copy()
        self._steer()
        for _ in range(N_ITERATIONS):
            self._simulation.iterate()
            self._look()
        self._turn(self.positions_m - before_m)
        for agent in [agent for agent, walk in self._walks.items() if walk.is_over(self.positions_m[agent].tolist())]:
            self.hold(agent)

    def _let_in(self, agent: int) -> None:
        """Puts an agent into the simulation, if there is room where it is."""
        x_m, y_m = self.positions_m[agent].tolist()
        body = self._jupedsim.CollisionFreeSpeedModelV2AgentParameters(
            position=(x_m, y_m),
            desired_speed=0.0,
            radius=BROAD.radius_m,
            time_gap=BROAD.time_gap_s,
            strength_neighbor_repulsion=BROAD.repulsion,
            journey_id=self._journey,
            stage_id=self._stage,
        )
        try:
            number = self._simulation.add_agent(body)
        except RuntimeError:  # too near to somebody; the library has no other way to ask
            return
        self._bodies[agent], self._agents[number] = number, agent
        del self._outside[agent]

    def _take_out(self, agent: int) -> None:
        """Takes an agent out of the simulation, not out of the scene."""
        if agent in self._bodies:
            body = self._bodies.pop(agent)
            del self._agents[body]
            self._simulation.mark_agent_for_removal(body)
            self._outside[agent] = None

    def _set_off(self) -> None:
        if not self._orders:
            return
        companies: dict[Hashable, Company] = {}
        for agent, route in find_routes(self._walkable, list(self._orders.values())).items():
            target = self._orders[agent].target
            company = None if target.company is None else companies.setdefault(target.company, Company())
            walk = Walk(agent, route, company, target.near_m)
            if agent in self._walks:
                walk.takes_over(self._walks[agent])
            self._walks[agent] = walk
        self._orders.clear()

    def _steer(self) -> None:
        """Gives everybody who walks a point to walk to and a speed."""
        ways = {agent: walk.way(self.positions_m[agent].tolist(), DT_S) for agent, walk in self._walks.items()}
        for agent in [agent for agent, way in ways.items() if way.pushes_through]:
            self._take_out(agent)
        for agent in ways.keys() & self._outside.keys():
            self._go_as_if_alone(agent, ways[agent])
        for body in self._simulation.agents():
            known = self._agents.get(body.id)
            if known in ways:
                way = ways[known]
            elif known in self._halted:
                way = Way(body.position, 0.0, BROAD)
            else:
                continue
            body.target, state = way.target_m, body.model
            state.desired_speed = way.speed_mps
            state.radius, state.time_gap, state.strength_neighbor_repulsion = way.build
        self._halted.clear()

    def _go_as_if_alone(self, agent: int, way: Way) -> None:
        """Moves an agent that is not in the simulation on its way, clear of the footprints."""
        here_m = self.positions_m[agent].copy()
        if self._walkable.clear(here_m)[0]:
            path_m = self._walkable.path(here_m, self._walkable.snap(way.target_m)[0])
            next_m = next((point_m for point_m in path_m if math.dist(point_m, here_m) > _AT_M), here_m)
        else:
            next_m = self._walkable.snap(here_m)[0]
        step_m = next_m - here_m
        self.positions_m[agent] += step_m * min(1.0, _PUSHING * way.speed_mps * DT_S / max(math.hypot(*step_m), 1e-9))

    def _look(self) -> None:
        """Reads where everybody is; who is off the ground is put back to where they were an iteration ago."""
        seen = [(self._agents.get(body.id), body.position) for body in self._simulation.agents()]
        agents = np.array([agent for agent, _ in seen if agent is not None], dtype=int)
        positions_m = np.array([position_m for agent, position_m in seen if agent is not None]).reshape(-1, 2)
        off = ~on_ground(self._ground, positions_m)
        self.positions_m[agents[~off]] = positions_m[~off]
        for agent in agents[off].tolist():
            self._take_out(agent)

    def _turn(self, moved_m: Floats) -> None:
        """Lets everybody look where they go."""
        self._velocities_mps += _SMOOTHING * (moved_m / DT_S - self._velocities_mps)
        x_mps, y_mps = self._velocities_mps.T
        moves = np.hypot(x_mps, y_mps) > _MOVES_MPS
        self.headings_rad[moves] = np.arctan2(y_mps[moves], x_mps[moves])


def library() -> ModuleType:
    """The library itself.

    Raises:
        ExtraError: if it is not installed.
    """
    try:
        return import_module("jupedsim")
    except ImportError:
        raise ExtraError("the steering 'jupedsim'", "jupedsim") from None
