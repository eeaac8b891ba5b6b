"""`Perturb`: authored groups spoilt at random."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.baselines.authored import AuthoredCounts
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.repair import repair
from genc.graph.signed_graph import SignedGraph
from genc.model.rules import feasible_counts
from genc.model.source import Decoded
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, CATEGORIES, MAX_NODES

Signed = NDArray[np.int8]


@dataclass(frozen=True)
class Rates:
    """How much is spoilt, as shares of what the authored group has; of both kinds of edges alike.

    The paper does not say: any of these.
    """

    nodes_removed: float = 0.1
    nodes_added: float = 0.1
    edges_removed: float = 0.5
    edges_added: float = 0.1


class Perturb:
    """Authored groups with nodes and edges removed and added at random, labels uniform (Gen-C, Ablation Study).

    A brief is answered with one of the groups whose counts are nearest to those asked for; what remains of its nodes
    keeps the canonical order. Added nodes stand anywhere in that order, without edges of their own; added edges join
    any two nodes that have none, of either kind with equal chance. As decoded, a perturbed group need be no group at
    all; `sample` repairs it.

    Args:
        groups: what is perturbed: to follow the paper, the test groups.
    """

    def __init__(self, groups: Sequence[CrowdGraph], rates: Rates | None = None) -> None:
        self._groups = groups
        self._rates = rates or Rates()
        self._counts = AuthoredCounts(groups)
        self._feasible = feasible_counts().numpy()

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief, repaired; its agents and events are counted as in the authored group."""
        return [answer.group for answer in self.decode(briefs, rng)]

    def decode(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[Decoded]:
        """One perturbed group for each brief, as it comes and repaired."""
        authored = [self._groups[rng.choice(self._counts.nearest(brief))] for brief in briefs]
        return [self._mended(group, self._spoilt(group, rng)) for group in authored]

    def _mended(self, group: CrowdGraph, graph: SignedGraph) -> Decoded:
        """The graph and its repair, to as many agents and events as the group has if so many nodes can have them."""
        possible = self._feasible[group.n_agents - 1, group.n_events - 1, graph.n_nodes - 1]
        counts = (group.n_agents, group.n_events) if possible else (None, None)
        repaired = repair(graph.adjacency.astype(np.float64), *counts)
        return Decoded(graph, repaired.labelled(graph.action, graph.category), repaired.change_rate)

    def _spoilt(self, group: CrowdGraph, rng: np.random.Generator) -> SignedGraph:
        rates, n_edges = self._rates, np.count_nonzero(group.adjacency) // 2
        adjacency = without_nodes(group.adjacency, rates.nodes_removed, rng)
        adjacency = without_edges(adjacency, rates.edges_removed, rng)
        adjacency = with_nodes(adjacency, int(rng.binomial(group.n_nodes, rates.nodes_added)), rng)
        adjacency = with_edges(adjacency, int(rng.binomial(n_edges, rates.edges_added)), rng)
        action = rng.integers(len(ACTIONS), size=len(adjacency))
        return SignedGraph(adjacency, action, rng.integers(len(CATEGORIES), size=len(adjacency)))


def without_nodes(adjacency: Signed, rate: float, rng: np.random.Generator) -> Signed:
    """The graph after each node was removed with that chance, though never all of them."""
    stays = rng.random(len(adjacency)) >= rate
    stays[rng.integers(len(adjacency))] |= not stays.any()
    return adjacency[np.ix_(stays, stays)]


def without_edges(adjacency: Signed, rate: float, rng: np.random.Generator) -> Signed:
    """The graph after each edge was removed with that chance."""
    upper = np.triu(np.where(rng.random(adjacency.shape) >= rate, adjacency, 0))
    return upper + upper.T


def with_nodes(adjacency: Signed, n_added: int, rng: np.random.Generator) -> Signed:
    """The graph with that many lone nodes put in anywhere, as far as a group may have more."""
    n = min(len(adjacency) + n_added, MAX_NODES)
    old = np.sort(rng.choice(n, len(adjacency), replace=False))
    larger = np.zeros((n, n), dtype=np.int8)
    larger[np.ix_(old, old)] = adjacency
    return larger


def with_edges(adjacency: Signed, n_added: int, rng: np.random.Generator) -> Signed:
    """The graph with that many edges more, as far as there is room, of either kind with equal chance."""
    free = np.argwhere(np.triu(adjacency == 0, k=1))
    i, j = rng.permutation(free)[:n_added].T
    larger = adjacency.copy()
    larger[i, j] = larger[j, i] = rng.choice(np.array([1, -1], dtype=np.int8), len(i))
    return larger
