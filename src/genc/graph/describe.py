"""What the paper conditions on: the counts and the action frequencies of a group."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from genc.graph.crowd_graph import CrowdGraph
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS


def action_frequencies(graph: CrowdGraph) -> tuple[float, ...]:
    """The share of each action among the nodes (Gen-C, Graph-Level Conditioning)."""
    counts = np.bincount(graph.action, minlength=len(ACTIONS))
    return tuple((counts / counts.sum()).tolist())


def full_brief(text: str, graph: CrowdGraph) -> Brief:
    """The brief that asks for a group like this one in every way the paper conditions on."""
    return Brief(text, graph.n_agents, graph.n_events, graph.n_nodes, action_frequencies(graph))


def asked_counts(brief: Brief) -> NDArray[np.float64]:
    """`[3]` agents, events and nodes that a brief asks for; nan where it does not."""
    return np.array([brief.n_agents, brief.n_events, brief.n_nodes], dtype=np.float64)


def count_gaps(log_counts: NDArray[np.float64], brief: Brief) -> NDArray[np.float64]:
    """`[n]` how far groups are from what a brief asks for: the sum of the absolute log ratios of its counts.

    Args:
        log_counts: logarithms of the agents, events and nodes of each group, `[n, 3]`.
    """
    gaps: NDArray[np.float64] = np.nansum(np.abs(log_counts - np.log(asked_counts(brief))), axis=1)
    return gaps


def nearest_counts(log_counts: NDArray[np.float64], brief: Brief) -> NDArray[np.intp]:
    """The groups that are nearest to what a brief asks for; all of them where it asks for no count."""
    gaps = count_gaps(log_counts, brief)
    return np.flatnonzero(gaps == gaps.min())
