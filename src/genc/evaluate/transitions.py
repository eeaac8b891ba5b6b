"""Transitions: what agents do next."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.sequences import ActionSequence
from genc.graph.crowd_graph import Ints
from genc.words.vocabulary import ACTIONS


def transition_counts(sequences: Iterable[ActionSequence]) -> Ints:
    """How often an agent goes from one action (row) to another (column), `[13, 13]`; staying counts as going."""
    counts = np.zeros((len(ACTIONS), len(ACTIONS)), dtype=np.int64)
    for sequence in sequences:
        np.add.at(counts, (sequence[:-1], sequence[1:]), 1)
    return counts


def transition_matrix(sequences: Iterable[ActionSequence]) -> NDArray[np.float64]:
    """The share of each action (column) in what agents do after another (row), `[13, 13]`; each row sums to 1.

    A row is nan where no agent goes on from its action: nothing is known of it, and the difference of two matrices
    says so too. (Gen-C, Assessment of LLM-bootstrapped Data: rows are the "from" action, columns the "to".)
    """
    counts = transition_counts(sequences)
    n_left = counts.sum(1, keepdims=True)
    shares: NDArray[np.float64] = counts / np.where(n_left > 0, n_left, np.nan)
    return shares
