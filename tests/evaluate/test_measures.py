from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.evaluate.measures import MEASURES, N_BINS, Profile, histograms, profile
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import Labelled, SignedGraph
from genc.words.vocabulary import ACTIONS, CATEGORIES


def measured(*graphs: Labelled) -> dict[str, dict[int, int]]:
    """For each measure the filled bins of these graphs pooled."""
    pooled = histograms(profile(graphs).sum(0))
    return {
        measure.name: {int(i): int(counts[i]) for i in np.flatnonzero(counts)}
        for measure, counts in zip(MEASURES, pooled, strict=True)
    }


def chain(n: int) -> CrowdGraph:
    """One agent that does n things in one event."""
    return CrowdGraph(np.zeros(n), np.zeros(n), np.arange(n) % len(ACTIONS), np.arange(n) % len(CATEGORIES))


def clique(n: int) -> CrowdGraph:
    """One event in which n agents do one thing."""
    return CrowdGraph(np.arange(n), np.zeros(n), np.full(n, 3), np.full(n, 7))


@given(st.integers(2, 100))
def test_a_chain(n: int) -> None:
    found = measured(chain(n))
    assert found["degree"] == {1: 2} | ({2: n - 2} if n > 2 else {})
    assert found["clustering"] == {0: n}
    assert found["diameter"] == {n - 1: 1}
    assert found["average path length"] == {4 * (n + 1) // 3: 1}
    assert sum(found["action transition"].values()) == sum(found["category transition"].values()) == n - 1


@given(st.integers(3, 15))
def test_a_clique(n: int) -> None:
    found = measured(clique(n))
    assert found["degree"] == {n - 1: n}
    assert found["clustering"] == {19: n}
    assert found["diameter"] == {1: 1}
    assert found["average path length"] == {4: 1}
    assert found["action"] == {3: n}
    assert found["category"] == {7: n}
    assert found["joint"] == {3 * len(CATEGORIES) + 7: n}
    assert found["action transition"] == {}


def test_one_node_has_no_paths_and_no_transitions() -> None:
    found = measured(chain(1))
    assert found["degree"] == found["clustering"] == {0: 1}
    assert found["diameter"] == found["average path length"] == {0: 1}
    assert found["action transition"] == {}


def test_transitions_run_forward_along_each_agent_and_across_events() -> None:
    # agent 0 alone: 2; agents 0 and 1: 5, 6; agent 1 alone: 4
    graph = CrowdGraph(
        np.array([0, 0, 0, 1, 1, 1]),
        np.array([0, 1, 1, 1, 1, 2]),
        np.array([2, 5, 6, 5, 6, 4]),
        np.array([0, 1, 1, 1, 1, 3]),
    )
    n = len(ACTIONS)
    found = measured(graph)
    assert found["action transition"] == {2 * n + 5: 1, 5 * n + 6: 2, 6 * n + 4: 1}
    assert found["category transition"] == {0 * 8 + 1: 1, 1 * 8 + 1: 2, 1 * 8 + 3: 1}


def test_the_parts_of_a_graph_do_not_see_each_other() -> None:
    apart = CrowdGraph(np.array([0, 0, 1]), np.array([0, 0, 1]), np.zeros(3), np.zeros(3))
    found = measured(apart)
    assert found["diameter"] == {1: 1}
    assert found["average path length"] == {4: 1}


def test_beyond_the_limits_of_a_group_the_last_bin_is_open() -> None:
    found = measured(clique(40), chain(400))
    assert found["degree"] == {1: 2, 2: 398, 16: 40}
    assert found["diameter"] == {1: 1, 99: 1}
    assert found["average path length"] == {4: 1, 135: 1}


def test_any_signed_adjacency_can_be_measured() -> None:
    # a sequence edge backwards along a triangle 0-1-2, a branch 2-3 and 2-4, a share edge 5-6 apart
    adjacency = np.zeros((7, 7), dtype=np.int8)
    for i, j, sign in ((1, 0, 1), (0, 2, -1), (1, 2, 1), (2, 3, 1), (2, 4, 1), (5, 6, -1)):
        adjacency[i, j] = adjacency[j, i] = sign
    found = measured(SignedGraph(adjacency, np.array([9, 8, 7, 6, 5, 4, 3]), np.array([0, 1, 2, 3, 4, 5, 6])))
    assert found["degree"] == {1: 4, 2: 2, 4: 1}
    assert found["clustering"] == {0: 4, 3: 1, 19: 2}  # 2 T / (k (k - 1)) = 2 / 12 at node 2, 1 at nodes 0 and 1
    assert found["diameter"] == {2: 1}
    assert found["average path length"] == {int(4 * (5 * 1 + 5 * 2 + 1) / 11): 1}
    assert found["action transition"] == {9 * 13 + 8: 1, 8 * 13 + 7: 1, 7 * 13 + 6: 1, 7 * 13 + 5: 1}
    assert found["category transition"] == {0 * 8 + 1: 1, 1 * 8 + 2: 1, 2 * 8 + 3: 1, 2 * 8 + 4: 1}


def test_transitions_of_the_corpus_are_those_of_its_agents(groups: list[CrowdGraph], authored: Profile) -> None:
    for group, row in zip(groups, authored, strict=True):
        order = np.lexsort((group.step, group.agent))
        same = np.diff(group.agent[order]) == 0
        before, after = order[:-1][same], order[1:][same]
        actions, categories = histograms(row)[6:8]
        assert np.array_equal(actions, np.bincount(13 * group.action[before] + group.action[after], minlength=169))
        assert np.array_equal(categories, np.bincount(8 * group.category[before] + group.category[after], minlength=64))


def test_the_rows_of_the_corpus_count_every_node_and_every_group(groups: list[CrowdGraph], authored: Profile) -> None:
    sizes = np.array([[g.n_nodes, g.n_nodes - g.n_agents] for g in groups])
    of_nodes, of_steps, of_groups = sizes[:, 0], sizes[:, 1], np.ones(len(groups))
    expected = [of_nodes] * 2 + [of_groups] * 2 + [of_nodes] * 2 + [of_steps] * 2 + [of_nodes]
    split = np.split(authored, np.cumsum([m.n_bins for m in MEASURES])[:-1], axis=1)
    for counts, total in zip(split, expected, strict=True):
        assert np.array_equal(counts.sum(1), total)


def test_a_profile_does_not_depend_on_how_agents_are_numbered(groups: list[CrowdGraph]) -> None:
    for group in groups[::50]:
        agent = group.n_agents - 1 - group.agent
        order = np.lexsort((group.step, agent, group.event))
        turned = CrowdGraph(agent[order], group.event[order], group.action[order], group.category[order])
        assert np.array_equal(profile([turned]), profile([group]))


def test_no_groups_have_an_empty_profile() -> None:
    assert profile([]).shape == (0, N_BINS)


@pytest.mark.parametrize("measure", [m.name for m in MEASURES])
def test_the_corpus_fills_bins_of_every_measure(measure: str, groups: list[CrowdGraph]) -> None:
    assert len(measured(*groups[:300])[measure]) >= 5
