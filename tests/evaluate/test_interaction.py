from __future__ import annotations

import numpy as np
import pytest

from genc.evaluate.interaction import participation_rate
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.graph.weave import unfold


def signed(n: int, *edges: tuple[int, int, int]) -> SignedGraph:
    adjacency = np.zeros((n, n), dtype=np.int8)
    for i, j, sign in edges:
        adjacency[i, j] = adjacency[j, i] = sign
    return SignedGraph(adjacency, np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64))


def test_one_shared_node_of_a_chain_is_enough() -> None:
    # agents {0, 1, 2}, {3, 4}, {5}: the first two meet once, the third stays alone
    assert participation_rate([signed(6, (0, 1, 1), (1, 2, 1), (3, 4, 1), (2, 3, -1))]) == pytest.approx(2 / 3)


def test_sequence_edges_are_no_interaction() -> None:
    assert participation_rate([signed(4, (0, 1, 1), (2, 3, 1))]) == 0


def test_agents_pool_over_groups() -> None:
    pair, alone = signed(2, (0, 1, -1)), signed(3, (0, 1, 1), (1, 2, 1))
    assert participation_rate([pair, alone]) == pytest.approx(2 / 3)  # of agents; of groups it is 1/2, of nodes 2/5


def test_authored_groups(groups: list[CrowdGraph]) -> None:
    records = [record for group in groups for record in unfold(group)]
    took = [any(step.partners for step in record.steps) for record in records]
    assert participation_rate(groups) == pytest.approx(np.mean(took))
    assert 0.6 < np.mean(took) < 0.95
