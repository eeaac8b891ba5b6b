"""Two baselines that learn nothing: what a generator must beat to have learned something.

Both answer briefs as a `GraphSource` does, save that counts are met only as well as an authored group happens to.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.graph.codec import Tokens, decode, encode
from genc.graph.crowd_graph import CrowdGraph
from genc.words.brief import Brief
from genc.words.embed import TextEncoder
from genc.words.vocabulary import ACTIONS, CATEGORIES


class Shuffle:
    """Who meets whom from an authored group, what they do and where by lot.

    The structure is that of a training group whose counts are nearest to those asked for; each turn gets an action
    drawn from the frequencies asked for, else from those of training, and a category drawn from those of training. It
    shows how much of each figure the condition gives away.
    """

    def __init__(self, groups: Sequence[CrowdGraph]) -> None:
        self._tokens = [encode(group) for group in groups]
        self._log_counts = np.log([[g.n_agents, g.n_events, g.n_nodes] for g in groups])
        self._actions = _shares(np.concatenate([g.action for g in groups]), len(ACTIONS))
        self._categories = _shares(np.concatenate([g.category for g in groups]), len(CATEGORIES))

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief."""
        return [self._answer(brief, rng) for brief in briefs]

    def _answer(self, brief: Brief, rng: np.random.Generator) -> CrowdGraph:
        tokens = self._tokens[rng.choice(self._nearest(brief))]
        n_turns = len(tokens.action)
        actions = self._actions if brief.action_frequencies is None else np.array(brief.action_frequencies)
        action = rng.choice(len(ACTIONS), n_turns, p=actions / actions.sum())
        category = rng.choice(len(CATEGORIES), n_turns, p=self._categories)
        return decode(Tokens(tokens.structure, action, category))

    def _nearest(self, brief: Brief) -> NDArray[np.intp]:
        """The training groups whose counts are nearest by ratio; all of them where none is asked for."""
        asked = np.array([brief.n_agents, brief.n_events, brief.n_nodes], dtype=np.float64)  # None becomes nan
        distance = np.nansum(np.abs(self._log_counts - np.log(asked)), axis=1)
        return np.flatnonzero(distance == distance.min())


class Retrieval:
    """The training group with the nearest text; one of them by lot where several share it.

    Args:
        groups: the training groups.
        texts: for each group everything that is said of it.
        encoder: gives the vectors of which the nearest is the one with the highest cosine.
    """

    def __init__(self, groups: Sequence[CrowdGraph], texts: Sequence[Sequence[str]], encoder: TextEncoder) -> None:
        self._groups = groups
        self._encoder = encoder
        self._described: dict[str, list[int]] = {}
        for i, said in enumerate(texts):
            for text in said:
                self._described.setdefault(text, []).append(i)
        self._texts = list(self._described)
        self._vectors = encoder.encode(self._texts)

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One authored group for each brief, whatever counts it asks for."""
        asked = list(dict.fromkeys(brief.text for brief in briefs))
        nearest = (self._encoder.encode(asked) @ self._vectors.T).argmax(1)
        answers = {text: self._described[self._texts[i]] for text, i in zip(asked, nearest, strict=True)}
        return [self._groups[rng.choice(answers[brief.text])] for brief in briefs]


def _shares(values: NDArray[np.int64], size: int) -> NDArray[np.float64]:
    shares: NDArray[np.float64] = np.bincount(values, minlength=size) / len(values)
    return shares
