"""The most frequent pairs of action and location category."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genc.graph.signed_graph import Labelled
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category


@dataclass(frozen=True)
class Pair:
    """What is done where, and its share of all nodes; as text `sit@furniture 0.08`."""

    action: Action
    category: Category
    share: float

    def __str__(self) -> str:
        return f"{self.action}@{self.category} {self.share:.2f}"


def top_pairs(groups: Sequence[Labelled], k: int = 4) -> list[Pair]:
    """The k most frequent pairs, or all that occur if fewer do (Gen-C, Quantitative Results, Table 3).

    Nodes pool over all groups, of which there is at least one. Of equally frequent pairs the one whose action, then
    category, stands first in the vocabulary comes first.
    """
    joint = np.concatenate([group.action * len(CATEGORIES) + group.category for group in groups])
    counts = np.bincount(joint)
    first = [int(i) for i in np.argsort(-counts, kind="stable")[:k] if counts[i]]
    return [
        Pair(ACTIONS[i // len(CATEGORIES)], CATEGORIES[i % len(CATEGORIES)], float(counts[i] / len(joint)))
        for i in first
    ]
