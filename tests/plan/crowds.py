"""Plans of authored scenarios, and small environments made by hand."""

from __future__ import annotations

import numpy as np

from genc.plan.crowd import PlanRequest, plan_crowd
from genc.plan.plan import CrowdPlan
from genc.scenario.record import Record, Step
from genc.scenario.rehearse import Rehearsal, rehearse
from genc.scenario.scenario import Environment, Location, Scenario
from genc.words.vocabulary import Action, Category


def environment(*places: tuple[str, Category, tuple[float, float], tuple[float, float]]) -> Environment:
    return Environment(tuple(Location(*place) for place in places))


HALL = environment(
    ("gate", Category.ENTRANCE, (0, 0), (3, 3)),
    ("kiosk", Category.SERVICE_AREA, (20, 6), (2, 2)),
    ("stand", Category.SERVICE_AREA, (20, -12), (2, 2)),
    ("bench", Category.FURNITURE, (10, -5), (4, 1)),
    ("lawn", Category.OUTDOOR_AREA, (15, 0), (30, 30)),
    ("tower", Category.BUILDING, (40, 0), (8, 20)),
)


def alone(*steps: tuple[Action, Category]) -> list[Record]:
    """A group of one person, one event."""
    return [Record(0, tuple(Step(0, action, category) for action, category in steps))]


def plan(groups: list[list[Record]], layout: Environment = HALL, seed: int = 0, **wishes: object) -> CrowdPlan:
    request = PlanRequest(**{"duration_s": 600.0, **wishes})
    return plan_crowd(groups, layout, request, np.random.default_rng(seed))


def authored(scenario: Scenario, seed: int = 0) -> tuple[Rehearsal, CrowdPlan]:
    """A scenario as written, planned for ten minutes."""
    rehearsal = rehearse(scenario, np.random.default_rng(seed))
    groups = [
        [record for record, group in zip(rehearsal.records, rehearsal.group_of, strict=True) if group == g]
        for g in range(len(rehearsal.captions))
    ]
    return rehearsal, plan(groups, scenario.environment, seed, captions=rehearsal.captions, triggers=rehearsal.triggers)
