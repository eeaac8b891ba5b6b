"""Hypothesis strategies for signed graphs of any shape: branching, cyclic, in several parts."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from genc.graph.signed_graph import SignedGraph
from genc.words.vocabulary import ACTIONS, CATEGORIES


@st.composite
def signed_graphs(draw: st.DrawFn) -> SignedGraph:
    n = draw(st.integers(1, 24))
    node = st.integers(0, n - 1)
    edges = draw(st.lists(st.tuples(node, node, st.sampled_from([1, -1])), max_size=3 * n))
    adjacency = np.zeros((n, n), dtype=np.int8)
    for i, j, sign in edges:
        if i != j:
            adjacency[i, j] = adjacency[j, i] = sign
    action, category = (
        np.array(draw(st.lists(st.integers(0, len(words) - 1), min_size=n, max_size=n)), dtype=np.int64)
        for words in (ACTIONS, CATEGORIES)
    )
    return SignedGraph(adjacency, action, category)
