"""Which transitions two corpora differ in, and by how much more than chance would have it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.lives import Lives
from genc.evaluate.sequences import Interval
from genc.evaluate.transitions import transition_counts, transition_matrix
from genc.words.vocabulary import ACTIONS, Action

Floats = NDArray[np.float64]

Z_95 = 1.959964
"""95 % of a normal distribution lie within so many standard deviations."""


@dataclass(frozen=True)
class Deviation:
    """One transition in two corpora.

    Attributes:
        before, after: the action left and the one that follows.
        a, b: the share of `after` in what follows `before`.
        difference: a - b, with its 95 % interval.
    """

    before: Action
    after: Action
    a: float
    b: float
    difference: Interval

    @property
    def sure(self) -> float:
        """The end of the interval that is nearer to 0, or 0 if it holds 0: how much the corpora differ at least."""
        return max(self.difference.low, -self.difference.high, 0.0)


def deviations(a: Lives, b: Lives) -> list[Deviation]:
    """The transitions of either whose share is known in both, those first that differ surely by the most.

    By the bare difference, those would come first that were hardly ever seen.
    """
    of_a, of_b = transition_matrix(a.sequences), transition_matrix(b.sequences)
    gap = of_a - of_b
    (middle_a, error_a), (middle_b, error_b) = _estimates(a), _estimates(b)
    reach = Z_95 * np.hypot(error_a, error_b)
    low, high = np.clip([middle_a - middle_b - reach, middle_a - middle_b + reach], -1, 1)
    found = [
        Deviation(
            ACTIONS[i],
            ACTIONS[j],
            float(of_a[i, j]),
            float(of_b[i, j]),
            Interval(float(gap[i, j]), float(low[i, j]), float(high[i, j])),
        )
        for i, j in np.argwhere(of_a + of_b > 0).tolist()
    ]
    return sorted(found, key=lambda deviation: (-deviation.sure, -abs(deviation.difference.mean)))


def _estimates(lives: Lives) -> tuple[Floats, Floats]:
    """The middle of an interval of each share of the transition matrix, and the standard error, both `[13, 13]`.

    They are those of as many transitions with two imagined, one of which goes there (Agresti and Caffo 2000, Simple
    and effective confidence intervals for proportions and differences): what a few never did could still be done. But
    the error is at least that of a ratio of sums over clusters, as agents of one scenario or clip often do the same
    (Cochran 1977, Sampling Techniques, 6.3). nan where nobody leaves the action.
    """
    inside = [np.flatnonzero(lives.cluster == c) for c in range(lives.n_clusters)]
    counts = np.array([transition_counts(lives.sequences[i] for i in some) for some in inside])
    total = counts.sum(0)
    n_left = np.where(total.sum(1, keepdims=True) > 0, total.sum(1, keepdims=True), np.nan)
    rest = counts - total / n_left * counts.sum(2, keepdims=True)
    of_clusters = (rest**2).sum(0) / n_left**2 * lives.n_clusters / max(lives.n_clusters - 1, 1)
    middle = (total + 1) / (n_left + 2)
    return middle, np.sqrt(np.maximum(of_clusters, middle * (1 - middle) / (n_left + 2)))
