"""Plans of authored scenarios."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from genc.plan.crowd import PlanRequest, plan_crowd
from genc.plan.plan import CrowdPlan
from genc.scenario.corpus import load_corpus
from genc.scenario.record import Record
from genc.scenario.rehearse import Rehearsal, rehearse
from genc.scenario.scenario import Scenario


def groups_of(rehearsal: Rehearsal) -> list[list[Record]]:
    """The records of each group."""
    pairs = list(zip(rehearsal.records, rehearsal.group_of, strict=True))
    return [[record for record, of in pairs if of == group] for group in range(len(rehearsal.captions))]


def plan_of(scenario: Scenario, seed: int = 0, duration_s: float = 600.0) -> tuple[Rehearsal, CrowdPlan]:
    """An authored scenario, rehearsed and planned as written."""
    rehearsal = rehearse(scenario, np.random.default_rng(seed))
    request = PlanRequest(duration_s, rehearsal.captions, triggers=rehearsal.triggers)
    return rehearsal, plan_crowd(groups_of(rehearsal), scenario.environment, request, np.random.default_rng(seed))


@cache
def authored(theme: str) -> Sequence[Scenario]:
    """All authored scenarios of a theme."""
    return load_corpus([theme])
