"""The nine figures, and the floor beside which each must be read."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.distances import kl_divergence
from genc.evaluate.measures import MEASURES, Profile, histograms

NAMES: tuple[str, ...] = tuple(measure.name for measure in MEASURES)


@dataclass(frozen=True, eq=False)
class Divergences:
    """How far repeated draws of groups are from one test set.

    Attributes:
        nats: `[n_repeats, 9]` KL(test || draw), in the order of `MEASURES`.
    """

    nats: NDArray[np.float64]

    @property
    def means(self) -> dict[str, float]:
        """For each measure its mean over the draws."""
        return dict(zip(NAMES, self.nats.mean(0).tolist(), strict=True))

    @property
    def spreads(self) -> dict[str, float]:
        """For each measure its standard deviation from draw to draw; the test set stays the same."""
        return dict(zip(NAMES, self.nats.std(0).tolist(), strict=True))

    @property
    def total(self) -> float:
        """The sum of the nine means."""
        return float(self.nats.mean(0).sum())

    def ratios(self, floor: Divergences) -> dict[str, float]:
        """For each measure how many times its floor it is."""
        return dict(zip(NAMES, (self.nats.mean(0) / floor.nats.mean(0)).tolist(), strict=True))

    def total_ratio(self, floor: Divergences) -> float:
        """The sum of the nine over the sum of their floors: "the total".

        Nats add up, so a measure counts by what it tells: the mean of the nine ratios would be ruled by the smallest
        floor, which is nearly all noise.
        """
        return self.total / floor.total


def compare(test: Profile, draws: Iterable[Profile]) -> Divergences:
    """The divergence of each draw of generated groups from the test set (Gen-C, Tables 1 and 2).

    A divergence shrinks as a draw grows: to be compared with `floor`, a draw must be as large as the test set.
    """
    authored = histograms(test.sum(0))
    rows = [[kl_divergence(p, q) for p, q in zip(authored, histograms(draw.sum(0)), strict=True)] for draw in draws]
    return Divergences(np.array(rows).reshape(-1, len(MEASURES)))


def floor(train: Profile, test: Profile, n_repeats: int, rng: np.random.Generator) -> Divergences:
    """The divergence of authored groups from the test set: as many training groups as it has, drawn anew each time.

    What a perfect generator that knows the training set alone would score. It is no lower bound: a generator that is
    told the counts and the frequencies of the test groups can come below it.

    Raises:
        ValueError: if the training set is the smaller one.
    """
    size = len(test)
    return compare(test, (train[rng.choice(len(train), size, replace=False)] for _ in range(n_repeats)))
