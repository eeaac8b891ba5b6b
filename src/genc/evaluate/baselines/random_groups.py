"""`Random`: groups that keep to the rules and the marginals, and to nothing else."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.special import gammaln

from genc.evaluate.baselines.authored import AuthoredCounts, Shares, action_shares, category_shares
from genc.graph.codec import Tokens, decode
from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.graph.describe import asked_counts
from genc.model.rules import StructureRules, feasible_counts
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, CATEGORIES, MAX_AGENTS

Floats = NDArray[np.float64]
NOISE_CONCENTRATION = 100.0
"""The label shares of a group are drawn from a Dirichlet of that many observations of the training shares: a share of
0.25 becomes 0.25 +- 0.04."""


class Random:
    """Random valid groups with exactly the counts asked for (Gen-C, Ablation Study: "Random").

    The structure is walked out event by event under the rules of `genc.model.rules`, so that every valid group can
    come and no other. Of those who may take part in an event, each does by the toss of a coin, nobody at all being
    tossed anew. The event then has as many turns as if the nodes that are left were cut into the events that are left
    with every cut equally likely. In each turn all who take part share one action and one category, drawn
    independently from the training shares after mild noise (`NOISE_CONCENTRATION`), which is drawn anew for each group.

    Counts that a brief leaves open are those of a training group drawn from the ones nearest to what it asks for.

    The paper does not say: how its random structures are drawn, nor what noise is mild.
    """

    def __init__(self, groups: Sequence[CrowdGraph]) -> None:
        self._counts = AuthoredCounts(groups)
        self._actions = action_shares(groups)
        self._categories = category_shares(groups)
        self._feasible = feasible_counts().nonzero().numpy() + 1

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief; requested counts are met exactly."""
        if not briefs:
            return []
        counts = np.array([self._wanted(brief, rng) for brief in briefs])
        return [self._labelled(structure, rng) for structure in random_structures(counts, rng)]

    def _wanted(self, brief: Brief, rng: np.random.Generator) -> Ints:
        """Agents, events and nodes for this brief: of all that a group can have, the nearest to an authored group."""
        authored: Ints = self._counts.values[rng.choice(self._counts.nearest(brief))]
        asked = asked_counts(brief)
        left_open = np.isnan(asked)
        if (left_open | (authored == asked)).all():
            return authored
        fit = self._feasible[(left_open | (self._feasible == asked)).all(1)]
        nearest: Ints = fit[np.abs(np.log(fit / authored)).sum(1).argmin()]
        return nearest

    def _labelled(self, structure: Ints, rng: np.random.Generator) -> CrowdGraph:
        n_turns = int((structure[structure >= MAX_AGENTS] - (MAX_AGENTS - 1)).sum())
        action = rng.choice(len(ACTIONS), n_turns, p=_jittered(self._actions, rng))
        category = rng.choice(len(CATEGORIES), n_turns, p=_jittered(self._categories, rng))
        return decode(Tokens(structure, action, category))


def random_structures(counts: Ints, rng: np.random.Generator) -> list[Ints]:
    """The structure tokens of one random group for each row of agents, events and nodes `[B, 3]`.

    All counts must be feasible, as those of a `Brief` are that asks for all three.
    """
    rules = StructureRules(*torch.from_numpy(counts).unbind(1))
    structures: list[list[int]] = [[] for _ in counts]
    under_way = np.arange(len(counts))
    while len(under_way):
        weights = _token_weights(rules)
        token = (weights.cumsum(1) > rng.random((len(weights), 1)) * weights.sum(1, keepdims=True)).argmax(1)
        for row, said in zip(under_way.tolist(), token.tolist(), strict=True):
            structures[row].append(said)
        rules.advance(torch.from_numpy(token))
        left = ~rules.finished
        rules.select(left)
        under_way = under_way[left.numpy()]
    return [np.array(structure) for structure in structures]


def _token_weights(rules: StructureRules) -> Floats:
    """`[B, n_tokens]` how likely each token is to come next, up to a factor of each row."""
    allowed = rules.mask().numpy()
    agents, turns = allowed[:, :MAX_AGENTS], allowed[:, MAX_AGENTS:]
    # with coins for all who may come, the k-th of them is the next to come with 2^-k, and nobody comes with 2^-n
    takes_part = np.where(agents, 0.5 ** agents.cumsum(1), 0.0)
    nobody = 0.5 ** agents.sum(1, keepdims=True)
    cuts = np.where(turns, _log_cuts(rules), -np.inf)
    most = cuts.max(1, keepdims=True, initial=-1e300)
    shares = np.exp(cuts - most)
    ends = nobody * shares / np.maximum(shares.sum(1, keepdims=True), 1e-300)
    return np.concatenate([takes_part, ends], axis=1)


def _log_cuts(rules: StructureRules) -> Floats:
    """`[B, 100]` log number of ways to cut what the event leaves into the events after it, for each number of turns."""
    turns = np.arange(1, 101)
    rest = rules.nodes.numpy()[:, None] - rules.inside.sum(1).numpy()[:, None] * turns
    others = rules.events.numpy()[:, None] - 1
    possible = (rest >= others) & (others >= 1)
    n, k = np.where(possible, rest - 1, 0), np.where(possible, others - 1, 0)
    ways: Floats = gammaln(n + 1) - gammaln(k + 1) - gammaln(n - k + 1)
    return ways


def _jittered(shares: Shares, rng: np.random.Generator) -> Shares:
    return rng.dirichlet(NOISE_CONCENTRATION * shares)
