from __future__ import annotations

import numpy as np
import pytest

from genc.graph.crowd_graph import CrowdGraph
from genc.plan.compose import compose


def _group(n_agents: int) -> CrowdGraph:
    zeros = np.zeros(n_agents, dtype=int)
    return CrowdGraph(np.arange(n_agents), zeros, zeros, zeros)


@pytest.mark.parametrize("n_agents", [1, 2, 3, 14, 15, 16, 60, 999])
def test_the_crowd_has_exactly_as_many_people_as_asked_for(n_agents):
    rng = np.random.default_rng(n_agents)
    asked: list[int | None] = []

    def sample(n_groups: int, size: int | None) -> list[CrowdGraph]:
        asked.append(size)
        return [_group(int(rng.integers(1, 16)) if size is None else size) for _ in range(n_groups)]

    groups = compose(sample, n_agents)
    assert sum(group.n_agents for group in groups) == n_agents
    assert sum(size is not None for size in asked) <= 1, "only the last group is of a size that was asked for"
