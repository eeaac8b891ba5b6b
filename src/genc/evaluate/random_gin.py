"""An evaluator that cannot be gamed: what an untrained graph network sees in a group.

A distance in the latent space of a trained encoder flatters the generator that was trained with it, and sees only what
that training needed. The features of an untrained network belong to nobody, look at the whole group (edges of both
kinds, actions, categories) and rank generators as well as trained ones do (Thompson et al. 2022, "On Evaluation
Metrics for Graph Generative Models", arXiv 2201.09871, whose settings these are).

What they do not see: the direction of time (a life told backwards has the same features), and what lies more than
three edges apart. What they see badly: most of their variance is the size of the group, and one seed in three hardly
notices when the actions of each group are dealt anew among its nodes. `two_sample` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from genc.graph.signed_graph import Labelled
from genc.words.vocabulary import ACTIONS, CATEGORIES

Floats = NDArray[np.float64]

N_LAYERS = 3
WIDTH = 35
LEAST_MOVED = 0.01
EDGE_SIGNS = (1, -1)
"""Of sequence and share edges in the signed adjacency."""


@dataclass(frozen=True, eq=False)
class _Layer:
    """One GINE layer: h' = ReLU(W2 ReLU(W1 (h + sum over edges of ReLU(h of the other end + e of the edge's kind)))).

    Attributes:
        edges: an embedding for each kind of edge `[2, WIDTH]`.
        inner, outer: the two maps `[WIDTH, WIDTH]`.
    """

    edges: Floats
    inner: Floats
    outer: Floats

    def __call__(self, nodes: Floats, kinds: Sequence[csr_array]) -> Floats:
        heard = [links @ _relu(nodes + edge) for links, edge in zip(kinds, self.edges, strict=True)]
        return _relu(_relu((nodes + sum(heard)) @ self.inner) @ self.outer)


class RandomGin:
    """A graph isomorphism network with node and edge attributes that was never trained.

    Every weight is orthogonal and drawn from the seed. One seed is one evaluator: compare figures of the same seed
    only, and look at a few seeds before believing a small difference.
    """

    def __init__(self, seed: int = 0) -> None:
        rng = np.random.default_rng(seed)
        self._embedding = _orthogonal(len(ACTIONS) + len(CATEGORIES), WIDTH, rng)
        self._layers = [
            _Layer(_orthogonal(len(EDGE_SIGNS), WIDTH, rng), *(_orthogonal(WIDTH, WIDTH, rng) for _ in range(2)))
            for _ in range(N_LAYERS)
        ]

    def features(self, groups: Sequence[Labelled]) -> Floats:
        """The features of each group `[n, 3 * 35]`: the nodes of each layer summed, the layers side by side.

        The order of nodes has no influence. Sums grow with the group, so that the size of groups is seen; that is
        also why the features must be brought to one scale (`standardise`) before any distance.
        """
        if not groups:
            return np.empty((0, N_LAYERS * WIDTH))
        kinds, members = _links(groups), _members(groups)
        action = np.concatenate([group.action for group in groups])
        category = np.concatenate([group.category for group in groups])
        nodes = self._embedding[action] + self._embedding[len(ACTIONS) + category]
        pooled = []
        for layer in self._layers:
            nodes = layer(nodes, kinds)
            pooled.append(members @ nodes)
        return np.hstack(pooled)


def standardise(features: Floats, train: Floats) -> Floats:
    """The features in units of the training set: its mean is 0 and its standard deviation 1 in each column.

    Both sides of a comparison must be brought to the scale of the training set, never each to its own: a generator
    whose groups are all twice too large would otherwise look perfect. A column that hardly any training group moves
    (fewer than 1 %: of an untrained network some are nearly dead) is only shifted; a few groups would else rule every
    distance.
    """
    mean, spread = train.mean(0), train.std(0)
    resting = np.median(train, axis=0)
    moved = np.abs(train - resting) > 1e-9 * np.maximum(np.abs(resting), np.abs(mean))
    constant = moved.mean(0) < LEAST_MOVED
    scaled: Floats = (features - mean) / np.where(constant, 1.0, spread)
    return scaled


def _links(groups: Sequence[Labelled]) -> list[csr_array]:
    """For each kind of edge one matrix `[n_nodes, n_nodes]` with the groups along its diagonal."""
    starts = _starts(groups)
    ends = [np.nonzero(group.adjacency) for group in groups]
    rows, columns = (np.concatenate([e[i] + s for e, s in zip(ends, starts, strict=False)]) for i in range(2))
    signs = np.concatenate([group.adjacency[e] for group, e in zip(groups, ends, strict=True)])
    return [_ones(rows[signs == sign], columns[signs == sign], (starts[-1], starts[-1])) for sign in EDGE_SIGNS]


def _members(groups: Sequence[Labelled]) -> csr_array:
    """`[n_groups, n_nodes]`: which nodes are in which group."""
    starts = _starts(groups)
    return _ones(np.repeat(np.arange(len(groups)), np.diff(starts)), np.arange(starts[-1]), (len(groups), starts[-1]))


def _starts(groups: Sequence[Labelled]) -> NDArray[np.intp]:
    """The first node of each group, and the number of all nodes."""
    return np.cumsum([0, *(len(group.action) for group in groups)])


def _ones(rows: NDArray[np.intp], columns: NDArray[np.intp], shape: tuple[int, int]) -> csr_array:
    return csr_array((np.ones(len(rows)), (rows, columns)), shape=shape)


def _relu(values: Floats) -> Floats:
    return np.maximum(values, 0.0)


def _orthogonal(n_rows: int, n_columns: int, rng: np.random.Generator) -> Floats:
    """Orthonormal rows, uniform among all such (Mezzadri 2007: signs made those of the diagonal of R)."""
    q, r = np.linalg.qr(rng.standard_normal((n_columns, n_rows)))
    rows: Floats = (q * np.sign(np.diag(r))).T
    return rows
