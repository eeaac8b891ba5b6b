"""Measures against networkx and plain loops, on authored groups and on signed graphs of any shape."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from drawn_signed_graphs import signed_graphs
from hypothesis import given
from hypothesis import strategies as st

from genc.evaluate.interaction import participation_rate
from genc.evaluate.measures import histograms, profile
from genc.evaluate.pairs import top_pairs
from genc.evaluate.sequences import action_sequences, chains
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import Labelled, SignedGraph
from genc.graph.weave import weave
from genc.scenario.corpus import load_theme, themes
from genc.scenario.rehearse import rehearse
from genc.words.vocabulary import ACTIONS, CATEGORIES


@pytest.fixture(scope="module")
def groups() -> list[CrowdGraph]:
    """Every fourth group of one theme, and the largest of it."""
    rng = np.random.default_rng(0)
    every = [g for scenario in load_theme(themes()[-1]) for g in weave(rehearse(scenario, rng).records).groups()]
    return every[::4] + sorted(every, key=lambda g: g.n_nodes)[-10:]


def binned(values: list[float], per_unit: int, n_bins: int) -> np.ndarray:
    """Counts in equal bins that begin at 0; a value on an edge belongs to the bin above, whatever floats say."""
    bins = np.floor(per_unit * np.array(values) + 1e-9).astype(int)
    return np.bincount(np.minimum(bins, n_bins - 1), minlength=n_bins)


def counted(values: list[int], n_bins: int) -> np.ndarray:
    return np.bincount(np.array(values, dtype=int), minlength=n_bins)


def sequence_edges(graph: Labelled) -> list[tuple[int, int]]:
    return [(i, j) for i, j in combinations(range(len(graph.action)), 2) if graph.adjacency[i, j] == 1]


def expected(graph: Labelled) -> list[np.ndarray]:
    both = nx.from_numpy_array(np.abs(graph.adjacency))
    paths = dict(nx.all_pairs_shortest_path_length(both))
    between = [paths[i][j] for i, j in combinations(both, 2) if j in paths[i]]
    done = [(int(a), int(c)) for a, c in zip(graph.action, graph.category, strict=True)]
    steps = [(done[i], done[j]) for i, j in sequence_edges(graph)]
    return [
        binned([k for _, k in both.degree()], 1, 17),
        binned(list(nx.clustering(both).values()), 20, 20),
        binned([max(between, default=0)], 1, 100),
        binned([sum(between) / max(len(between), 1)], 4, 136),
        counted([a for a, _ in done], 13),
        counted([c for _, c in done], 8),
        counted([13 * a + b for (a, _), (b, _) in steps], 169),
        counted([8 * c + d for (_, c), (_, d) in steps], 64),
        counted([8 * a + c for a, c in done], 104),
    ]


def agents(graph: Labelled) -> list[list[int]]:
    """The parts that sequence edges make, each ascending, in order of their first node."""
    sequence = nx.empty_graph(len(graph.action))
    sequence.add_edges_from(sequence_edges(graph))
    return sorted(sorted(part) for part in nx.connected_components(sequence))


def assert_as_expected(graph: Labelled, row: np.ndarray) -> None:
    for found, wanted in zip(histograms(row), expected(graph), strict=True):
        assert np.array_equal(found, wanted)


def test_authored_groups(groups: list[CrowdGraph]) -> None:
    assert len(groups) > 400
    for group, row in zip(groups, profile(groups), strict=True):
        assert_as_expected(group, row)


def test_the_same_groups_as_matrices(groups: list[CrowdGraph]) -> None:
    matrices = [SignedGraph(g.adjacency, g.action, g.category) for g in groups]
    assert np.array_equal(profile(matrices), profile(groups))
    assert action_sequences(matrices) == action_sequences(groups)
    assert participation_rate(matrices) == participation_rate(groups)


@given(signed_graphs())
def test_signed_graphs_of_any_shape(graph: SignedGraph) -> None:
    assert_as_expected(graph, profile([graph])[0])


def test_the_last_bins_are_open() -> None:
    rng = np.random.default_rng(0)
    sign = np.triu(rng.choice([-1, 0, 1], size=(130, 130)), 1).astype(np.int8)
    dense = SignedGraph(sign + sign.T, rng.integers(0, 13, 130), rng.integers(0, 8, 130))
    line = np.eye(160, k=1, dtype=np.int8)
    long = SignedGraph(line + line.T, np.zeros(160, dtype=np.int64), np.zeros(160, dtype=np.int64))
    for graph in (dense, long):
        assert_as_expected(graph, profile([graph])[0])


@given(signed_graphs())
def test_agents_are_what_sequence_edges_hold_together(graph: SignedGraph) -> None:
    assert [nodes.tolist() for nodes in chains(graph)] == agents(graph)
    assert action_sequences([graph]) == [tuple(graph.action[part]) for part in agents(graph)]


@given(st.lists(signed_graphs(), min_size=1, max_size=4))
def test_participation_in_signed_graphs(graphs: list[SignedGraph]) -> None:
    took = [any(-1 in graph.adjacency[node] for node in part) for graph in graphs for part in agents(graph)]
    assert participation_rate(graphs) == pytest.approx(np.mean(took))


@given(st.lists(signed_graphs(), min_size=1, max_size=4), st.integers(1, 12))
def test_top_pairs_of_signed_graphs(graphs: list[SignedGraph], k: int) -> None:
    nodes = Counter((int(a), int(c)) for g in graphs for a, c in zip(g.action, g.category, strict=True))
    ranked = sorted(nodes, key=lambda pair: (-nodes[pair], pair))[:k]
    found = top_pairs(graphs, k)
    assert [(p.action, p.category) for p in found] == [(ACTIONS[a], CATEGORIES[c]) for a, c in ranked]
    assert [p.share for p in found] == pytest.approx([nodes[pair] / nodes.total() for pair in ranked])
