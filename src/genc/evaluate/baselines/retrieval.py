"""`Retrieval`: the authored group of which the nearest is said."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.baselines.authored import AuthoredCounts
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import action_frequencies
from genc.words.brief import Brief
from genc.words.embed import TextEncoder


class Retrieval:
    """The training group with the nearest text, or with the nearest condition; by lot where several are as near.

    Args:
        groups: the training groups.
        texts: for each group everything that is said of it; the nearest of these counts.
        encoder: gives the vectors of which the nearest is the one with the highest cosine.
        whole_condition: weigh counts and frequencies, where a brief asks for them, as well as the text. The distance
            is then the sum of 1 - cosine, the absolute log ratio of each count, and the total variation between the
            action frequencies: terms that all go from 0 to about 1.
    """

    def __init__(
        self,
        groups: Sequence[CrowdGraph],
        texts: Sequence[Sequence[str]],
        encoder: TextEncoder,
        whole_condition: bool = False,
    ) -> None:
        self._groups = groups
        self._encoder = encoder
        self._whole_condition = whole_condition
        self._counts = AuthoredCounts(groups)
        self._frequencies = np.array([action_frequencies(group) for group in groups])
        number = {text: i for i, text in enumerate(dict.fromkeys(text for said in texts for text in said))}
        self._vectors = encoder.encode(list(number))
        self._said = np.array([number[text] for said in texts for text in said])
        """Which text, group after group; those of group g begin at `_starts[g]`."""
        self._starts = np.cumsum([0, *(len(said) for said in texts[:-1])])

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One authored group for each brief, whatever counts it asks for."""
        vectors = self._encoder.encode(list(dict.fromkeys(brief.text for brief in briefs)))
        distance = dict(zip(dict.fromkeys(brief.text for brief in briefs), 1 - vectors @ self._vectors.T, strict=True))
        nearest = {brief: self._nearest(brief, distance[brief.text]) for brief in dict.fromkeys(briefs)}
        return [self._groups[rng.choice(nearest[brief])] for brief in briefs]

    def _nearest(self, brief: Brief, text_distance: NDArray[np.float32]) -> NDArray[np.intp]:
        distance = np.minimum.reduceat(text_distance[self._said], self._starts).astype(np.float64)
        if self._whole_condition:
            distance += self._counts.gaps(brief)
            if brief.action_frequencies is not None:
                distance += np.abs(self._frequencies - brief.action_frequencies).sum(1) / 2
        return np.flatnonzero(distance == distance.min())
