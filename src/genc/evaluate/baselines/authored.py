"""What the baselines know of authored groups: their counts, and how often each label stands on a node."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.graph.describe import count_gaps, nearest_counts
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, CATEGORIES

Shares = NDArray[np.float64]


class AuthoredCounts:
    """Agents, events and nodes of authored groups, compared by ratio.

    Attributes:
        values: `[n, 3]`.
    """

    def __init__(self, groups: Sequence[CrowdGraph]) -> None:
        self.values: Ints = np.array([[g.n_agents, g.n_events, g.n_nodes] for g in groups])
        self._log = np.log(self.values)

    def gaps(self, brief: Brief) -> NDArray[np.float64]:
        """`[n]` how far each group is from what a brief asks for."""
        return count_gaps(self._log, brief)

    def nearest(self, brief: Brief) -> NDArray[np.intp]:
        """The groups that are nearest to what a brief asks for; all of them where it asks for no count."""
        return nearest_counts(self._log, brief)


def action_shares(groups: Sequence[CrowdGraph]) -> Shares:
    """`[13]` the share of each action among all nodes."""
    return _shares(np.concatenate([g.action for g in groups]), len(ACTIONS))


def category_shares(groups: Sequence[CrowdGraph]) -> Shares:
    """`[8]` the share of each category among all nodes."""
    return _shares(np.concatenate([g.category for g in groups]), len(CATEGORIES))


def _shares(values: Ints, size: int) -> Shares:
    shares: Shares = np.bincount(values, minlength=size) / len(values)
    return shares
