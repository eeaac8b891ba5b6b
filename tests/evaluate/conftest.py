from __future__ import annotations

import numpy as np
import pytest

from genc.evaluate.measures import Profile, profile
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.scenario.corpus import load_corpus
from genc.scenario.rehearse import rehearse


@pytest.fixture(scope="session")
def groups() -> list[CrowdGraph]:
    """All groups of the shipped corpus, scenario by scenario."""
    rng = np.random.default_rng(0)
    return [g for scenario in load_corpus() for g in weave(rehearse(scenario, rng).records).groups()]


@pytest.fixture(scope="session")
def authored(groups: list[CrowdGraph]) -> Profile:
    return profile(groups)
