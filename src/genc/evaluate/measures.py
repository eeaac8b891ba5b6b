"""The nine measures: what is counted in a group, and into which bins.

Six are of the paper's ablation (Gen-C, Ablation Study, Table 1) and three of its perturbation experiment (Table 2).
The paper names the descriptors but no bins; these are fixed, so that figures from different data compare.

    measure              one value for each          bins
    degree               node                        0, 1 .. 16: a node of a group has 14 partners and 2 neighbours
    clustering           node                        20 equal bins on [0, 1]
    diameter             graph                       0, 1 .. 99: the longest chain that 100 nodes can make
    average path length  graph                       136 bins of 0.25 on [0, 34]
    action               node                        13
    category             node                        8
    action transition    sequence edge               13 x 13, from row to column
    category transition  sequence edge               8 x 8, from row to column
    joint                node                        13 x 8, action by category

For the first four, edges of both kinds count alike and have no direction or weight. A transition leads along a
sequence edge from the node of the lower index to that of the higher, which in canonical order is the later. So every
measure is defined for any signed adjacency, crowd scenario graph or not. Values pool over all groups, so large groups
weigh more in all but diameter and average path length. The last bin of each of the first four is open: a graph beyond
the limits of a group falls into it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import shortest_path

from genc.graph.crowd_graph import Ints
from genc.graph.signed_graph import Labelled
from genc.words.vocabulary import ACTIONS, CATEGORIES, MAX_AGENTS, MAX_NODES

N_CLUSTERING_BINS = 20
BINS_PER_STEP = 4
"""Of average path length. A chain of n nodes has (n + 1) / 3: at 0.25 every length of chain has its own bin, and a
few hundred groups still fill the bins they reach."""


@dataclass(frozen=True)
class Measure:
    """A name and a number of bins."""

    name: str
    n_bins: int


MEASURES: tuple[Measure, ...] = (
    Measure("degree", MAX_AGENTS + 2),
    Measure("clustering", N_CLUSTERING_BINS),
    Measure("diameter", MAX_NODES),
    Measure("average path length", BINS_PER_STEP * (MAX_NODES + 2) // 3),
    Measure("action", len(ACTIONS)),
    Measure("category", len(CATEGORIES)),
    Measure("action transition", len(ACTIONS) ** 2),
    Measure("category transition", len(CATEGORIES) ** 2),
    Measure("joint", len(ACTIONS) * len(CATEGORIES)),
)
_STARTS = (0, *accumulate(measure.n_bins for measure in MEASURES))
N_BINS = _STARTS[-1]

Profile = NDArray[np.int32]
"""`[n_groups, N_BINS]`: for each group, how many of its values fall into each bin of each measure, side by side in
the order of `MEASURES`. Rows add: the sum of rows is the profile of the groups pooled."""


def profile(groups: Sequence[Labelled]) -> Profile:
    """The profile of these groups, one row each: all that the measures ever look at."""
    return np.array([_row(group) for group in groups], dtype=np.int32).reshape(-1, N_BINS)


def histograms(counts: NDArray[np.integer]) -> list[NDArray[np.integer]]:
    """The histogram of each measure: views into a row, or a sum of rows, of a profile."""
    return np.split(counts, _STARTS[1:-1])


def _row(graph: Labelled) -> Ints:
    linked = graph.adjacency != 0
    degree, clustering = _neighbourhoods(linked)
    diameter, path_bin = _distances(linked)
    before, after = _consecutive(graph.adjacency)
    action, category = graph.action, graph.category
    values = (
        degree,
        clustering,
        diameter,
        path_bin,
        action,
        category,
        action[before] * len(ACTIONS) + action[after],
        category[before] * len(CATEGORIES) + category[after],
        action * len(CATEGORIES) + category,
    )
    bins = [
        np.minimum(value, measure.n_bins - 1) + start
        for value, measure, start in zip(values, MEASURES, _STARTS[:-1], strict=True)
    ]
    return np.bincount(np.concatenate(bins), minlength=N_BINS)


def _neighbourhoods(linked: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Degree, and the bin of the clustering coefficient 2 T / (k (k - 1)), of each node `[n]`."""
    edges = linked.astype(np.float32)  # exact: a group has fewer than 2 ** 24 of anything
    degree = linked.sum(1)
    closed = ((edges @ edges) * edges).sum(1).astype(np.int64)  # 2 T: each triangle is walked both ways round
    pairs = np.maximum(degree * (degree - 1), 1)
    return degree, N_CLUSTERING_BINS * closed // pairs


def _distances(linked: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """Diameter, and the bin of the average path length, over all pairs of connected nodes, each `[1]`; 0 if none."""
    steps = shortest_path(linked, directed=False, unweighted=True)
    between = steps[np.isfinite(steps) & (steps > 0)].astype(np.int64)
    mean_bin = BINS_PER_STEP * between.sum() // max(len(between), 1)
    return between.max(initial=0, keepdims=True), mean_bin[None]


def _consecutive(adjacency: NDArray[np.int8]) -> tuple[Ints, Ints]:
    """The nodes that an agent comes from and goes to, for each sequence edge."""
    before, after = np.nonzero(np.triu(adjacency > 0))
    return before, after
