"""Adherence: are the groups valid, and are they what was asked for?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genc.graph.codec import group_fault
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import action_frequencies
from genc.words.brief import Brief


@dataclass(frozen=True)
class Adherence:
    """Shares of groups that keep to their briefs; nan where no brief asks.

    Attributes:
        valid: connected and within the limits, as every authored group is; that the nodes make a crowd scenario graph
            at all is certain, for no other can be built.
        agents, events, nodes: have exactly the count that was asked for.
        action_gap: mean total variation distance between the action frequencies asked for and those of the group:
            the share of its nodes that would have to do something else.
    """

    valid: float
    agents: float
    events: float
    nodes: float
    action_gap: float


def adherence(briefs: Sequence[Brief], groups: Sequence[CrowdGraph]) -> Adherence:
    """How well groups keep to their briefs, one group for each brief."""
    pairs = list(zip(briefs, groups, strict=True))
    return Adherence(
        valid=_mean([group_fault(g) is None for g in groups]),
        agents=_mean([g.n_agents == b.n_agents for b, g in pairs if b.n_agents is not None]),
        events=_mean([g.n_events == b.n_events for b, g in pairs if b.n_events is not None]),
        nodes=_mean([g.n_nodes == b.n_nodes for b, g in pairs if b.n_nodes is not None]),
        action_gap=_mean([_gap(b.action_frequencies, g) for b, g in pairs if b.action_frequencies is not None]),
    )


def _gap(asked: tuple[float, ...], group: CrowdGraph) -> float:
    return float(np.abs(np.subtract(asked, action_frequencies(group))).sum() / 2)


def _mean(values: Sequence[float]) -> float:
    return float(np.mean(values)) if values else float("nan")
