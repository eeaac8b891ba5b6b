"""The structural measures against networkx, on authored groups."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest

from genc.evaluate.measures import histograms, profile
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.scenario.corpus import load_theme, themes
from genc.scenario.rehearse import rehearse


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


def expected(group: CrowdGraph) -> list[np.ndarray]:
    graph = nx.from_numpy_array(np.abs(group.adjacency))
    alone = len(graph) == 1
    return [
        binned([k for _, k in graph.degree()], 1, 17),
        binned(list(nx.clustering(graph).values()), 20, 20),
        binned([0 if alone else nx.diameter(graph)], 1, 100),
        binned([0 if alone else nx.average_shortest_path_length(graph)], 4, 136),
    ]


def test_structure_of_authored_groups(groups: list[CrowdGraph]) -> None:
    assert len(groups) > 400
    for group, row in zip(groups, profile(groups), strict=True):
        for found, wanted in zip(histograms(row)[:4], expected(group), strict=True):
            assert np.array_equal(found, wanted)
