"""A small plaza, and plans for it that are written by hand."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from genc.motion.executor import Options, simulate
from genc.motion.kinematic import Kinematic
from genc.motion.motion import Executed, Motion
from genc.plan.plan import Activity, CrowdPlan, Person, Slot
from genc.plan.slots import Places, places_of
from genc.plan.walkable import Walkable
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action, Category

PLAZA = Environment(
    (
        Location("arch", Category.ENTRANCE, (0.0, 10.0), (4.0, 4.0)),
        Location("van", Category.SERVICE_AREA, (20.0, 20.0), (2.0, 1.5)),
        Location("lawn", Category.OUTDOOR_AREA, (20.0, 5.0), (12.0, 8.0)),
        Location("library", Category.BUILDING, (40.0, 10.0), (10.0, 10.0)),
        Location("bench", Category.FURNITURE, (28.0, 14.0), (2.0, 0.6)),
    )
)
ARCH, VAN, LAWN, LIBRARY, BENCH = range(5)
SPEED_MPS = 1.25


@cache
def ground() -> Walkable:
    return Walkable.of(PLAZA)


@cache
def places() -> tuple[Places, ...]:
    return places_of(PLAZA, ground())


class Draft:
    """A plan in the making: `do` adds one occasion for some agents, at their slots."""

    def __init__(self, n_agents: int) -> None:
        self.rows: list[list[Activity]] = [[] for _ in range(n_agents)]
        self.n_occasions = 0

    def do(
        self, agents: Sequence[int], action: Action, location: int, slots: Sequence[Slot], start_s: float, end_s: float
    ) -> Draft:
        for agent, slot in zip(agents, slots, strict=True):
            row = self.rows[agent]
            leave_s = row[-1].end_s if row else (start_s if action is Action.ENTER_EXIT else 0.0)
            partners = tuple(sorted(set(agents) - {agent}))
            row.append(Activity(action, location, slot, leave_s, start_s, end_s, self.n_occasions, partners))
        self.n_occasions += 1
        return self

    def plan(self, duration_s: float = 120.0, leaves: bool = False) -> CrowdPlan:
        people = tuple(Person(0, SPEED_MPS, tuple(row), leaves) for row in self.rows)
        return CrowdPlan(PLAZA, people, duration_s, ("a caption",))


def play(plan: CrowdPlan, seed: int = 0, options: Options | None = None) -> Motion:
    steering = Kinematic(len(plan.people), ground())
    return simulate(plan, ground(), places(), steering, options or Options(), np.random.default_rng(seed))


def done_by(motion: Motion, agent: int) -> list[Executed]:
    return [done for done in motion.executed if done.agent == agent]


def at(x_m: float, y_m: float, facing_rad: float = 0.0) -> Slot:
    return Slot((x_m, y_m), facing_rad)
