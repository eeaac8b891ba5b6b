"""Interaction: how many agents ever do something together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from genc.evaluate.sequences import chains
from genc.graph.signed_graph import Labelled


def participation_rate(groups: Sequence[Labelled]) -> float:
    """The share of agents with a share edge at any of their nodes (Gen-C, Table 2: "Interact Rate"); no units.

    Agents pool over all groups, of which there is at least one. No direction: the closer to the authored rate the
    better. In a graph that is no crowd scenario graph, an agent is what sequence edges hold together (`chains`).
    """
    takes_part = [took for group in groups for took in _takes_part(group)]
    return sum(takes_part) / len(takes_part)


def _takes_part(graph: Labelled) -> list[bool]:
    """For each agent of `chains`."""
    shares = np.any(graph.adjacency < 0, axis=1)
    return [bool(shares[nodes].any()) for nodes in chains(graph)]
