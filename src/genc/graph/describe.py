"""What the paper conditions on: the counts and the action frequencies of a group."""

from __future__ import annotations

import numpy as np

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
