"""Baselines that learn nothing: what a generator must beat to have learned something.

    Random      knows the rules and the marginals     counts exact
    Perturb     spoils authored groups at random      agents and events of the nearest authored group, as a rule
    Shuffle     an authored structure, labels by lot  counts of the nearest authored group
    Retrieval   the nearest authored group            counts of the nearest authored group

All answer briefs as a `GraphSource` does, save that the last three meet counts only as well as stated.
"""

from __future__ import annotations

from genc.evaluate.baselines.perturb import Perturb, Rates
from genc.evaluate.baselines.random_groups import Random
from genc.evaluate.baselines.retrieval import Retrieval
from genc.evaluate.baselines.shuffle import Shuffle

__all__ = ["Perturb", "Random", "Rates", "Retrieval", "Shuffle"]
