"""`Shuffle`: an authored structure, with labels by lot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from genc.evaluate.baselines.authored import AuthoredCounts, action_shares, category_shares
from genc.graph.codec import Tokens, decode, encode
from genc.graph.crowd_graph import CrowdGraph
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, CATEGORIES


class Shuffle:
    """Who meets whom from an authored group, what they do and where by lot.

    The structure is that of a training group whose counts are nearest to those asked for; each turn gets an action
    drawn from the frequencies asked for, else from those of training, and a category drawn from those of training. It
    shows how much of each figure the condition gives away.
    """

    def __init__(self, groups: Sequence[CrowdGraph]) -> None:
        self._tokens = [encode(group) for group in groups]
        self._counts = AuthoredCounts(groups)
        self._actions = action_shares(groups)
        self._categories = category_shares(groups)

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief."""
        return [self._answer(brief, rng) for brief in briefs]

    def _answer(self, brief: Brief, rng: np.random.Generator) -> CrowdGraph:
        tokens = self._tokens[rng.choice(self._counts.nearest(brief))]
        n_turns = len(tokens.action)
        actions = self._actions if brief.action_frequencies is None else np.array(brief.action_frequencies)
        action = rng.choice(len(ACTIONS), n_turns, p=actions / actions.sum())
        category = rng.choice(len(CATEGORIES), n_turns, p=self._categories)
        return decode(Tokens(tokens.structure, action, category))
