from __future__ import annotations

import numpy as np
import pytest
from drawn_groups import records
from hypothesis import given

from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import unfold, weave


def graph(*nodes: tuple[int, int, int, int]) -> CrowdGraph:
    """A graph of nodes (event, agent, action, category)."""
    event, agent, action, category = np.array(nodes).T
    return CrowdGraph(agent, event, action, category)


@given(records())
def test_adjacency_agrees_with_its_definition(drawn):
    g = weave(drawn)
    expected = np.zeros((g.n_nodes, g.n_nodes), dtype=int)
    for i in range(g.n_nodes):
        for j in range(g.n_nodes):
            if i == j:
                continue
            if g.agent[i] == g.agent[j]:
                expected[i, j] = int(abs(g.step[i] - g.step[j]) == 1)
            elif g.event[i] == g.event[j] and g.turn[i] == g.turn[j]:
                expected[i, j] = -1
    assert np.array_equal(g.adjacency, expected)


@given(records())
def test_parts_are_the_connected_components(drawn):
    networkx = pytest.importorskip("networkx")
    g = weave(drawn)
    components = {frozenset(c) for c in networkx.connected_components(networkx.Graph(np.abs(g.adjacency)))}
    parts = {frozenset(np.flatnonzero(g.part == k).tolist()) for k in range(g.part.max() + 1)}
    assert parts == components
    assert sum(part.n_nodes for part in g.groups()) == g.n_nodes


@given(records())
def test_unfold_takes_back_what_weave_makes(drawn):
    assert unfold(weave(drawn)) == drawn


@pytest.mark.parametrize(
    ("nodes", "fault"),
    [
        ([(0, 1, 0, 0), (0, 0, 0, 0)], "canonical order"),
        ([(1, 0, 0, 0)], "without gaps"),
        ([(0, 0, 13, 0)], "out of range"),
        ([(0, 0, 0, 8)], "out of range"),
        ([(0, 0, 0, 0), (0, 1, 1, 0)], "same thing"),
        ([(0, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 0)], "same number of things"),
    ],
)
def test_what_is_no_crowd_scenario_graph_cannot_be_built(nodes, fault):
    with pytest.raises(ValueError, match=fault):
        graph(*nodes)


def test_records_that_contradict_each_other_are_refused():
    drawn = unfold(graph((0, 0, 0, 0), (0, 1, 0, 0)))
    lonely = [drawn[0], type(drawn[1])(1, tuple(type(s)(s.event, s.action, s.category) for s in drawn[1].steps))]
    with pytest.raises(ValueError, match="disagree"):
        weave(lonely)
