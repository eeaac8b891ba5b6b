from __future__ import annotations

import numpy as np
import pytest

from genc.motion.executor import Options, simulate
from genc.motion.kinematic import Kinematic
from genc.plan.crowd import PlanRequest, plan_crowd
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.corpus import load_corpus
from genc.scenario.rehearse import rehearse
from genc.world.world import World


def make_world(theme: str, duration_s: float) -> World:
    """The first authored scenario of a theme, played."""
    scenario, rng = load_corpus([theme])[0], np.random.default_rng(0)
    rehearsal = rehearse(scenario, rng)
    pairs = list(zip(rehearsal.records, rehearsal.group_of, strict=True))
    groups = [[record for record, of in pairs if of == group] for group in range(len(rehearsal.captions))]
    request = PlanRequest(duration_s, rehearsal.captions, triggers=rehearsal.triggers)
    plan = plan_crowd(groups, scenario.environment, request, rng)
    ground = Walkable.of(plan.environment)
    steering = Kinematic(len(plan.people), ground)
    motion = simulate(plan, ground, places_of(plan.environment, ground), steering, Options(), rng)
    return World(plan, motion, {"text": scenario.sentence, "theme": theme, "seed": 0, "model": None, "share": 0.1})


@pytest.fixture(scope="session")
def world() -> World:
    """An authored world of ten minutes."""
    return make_world("train station", 600.0)


@pytest.fixture(scope="session")
def short_world() -> World:
    """An authored world of one minute, small on disk."""
    return make_world("city park", 60.0)
