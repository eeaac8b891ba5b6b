from __future__ import annotations

import math

import numpy as np
import pytest

from genc.evaluate.adherence import adherence
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import full_brief
from genc.words.brief import Brief


def test_every_authored_group_is_what_it_is(groups: list[CrowdGraph]) -> None:
    found = adherence([full_brief("they wait", g) for g in groups], groups)
    assert (found.valid, found.agents, found.events, found.nodes) == (1, 1, 1, 1)
    assert found.action_gap == pytest.approx(0, abs=1e-12)


def test_each_count_is_judged_apart_and_only_where_asked() -> None:
    pair = CrowdGraph(np.array([0, 0, 1, 1]), np.zeros(4), np.array([1, 2, 1, 2]), np.zeros(4))
    sitting = (0.0, 1.0) + (0.0,) * 11
    briefs = [Brief("a", n_agents=2), Brief("b", n_agents=3, n_nodes=4), Brief("c", action_frequencies=sitting)]
    found = adherence(briefs, [pair] * 3)
    assert found.agents == 0.5
    assert found.nodes == 1
    assert math.isnan(found.events)
    assert found.action_gap == 0.5  # half of its nodes wander


def test_a_graph_in_two_parts_or_too_large_is_no_valid_group() -> None:
    one = np.zeros(1)
    whole = CrowdGraph(one, one, one, one)
    apart = CrowdGraph(np.arange(2), np.arange(2), np.zeros(2), np.zeros(2))
    large = CrowdGraph(np.arange(16), np.zeros(16), np.zeros(16), np.zeros(16))
    assert adherence([Brief("a")] * 3, [whole, apart, large]).valid == pytest.approx(1 / 3)


def test_a_brief_without_an_answer_is_an_error() -> None:
    with pytest.raises(ValueError, match="zip"):
        adherence([Brief("a")], [])
