"""`GraphSource`: what every generator is to the rest of the product."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.words.brief import Brief


class GraphSource(Protocol):
    """Something that answers briefs with groups."""

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief, in order; counts that a brief asks for are met exactly."""
        ...


@dataclass(frozen=True)
class Decoded:
    """An answer before and after its repair.

    Attributes:
        graph: as it was decoded; need be no group.
        group: repaired.
        change_rate: how much the repair changed, as `genc.graph.repair` counts it.
    """

    graph: SignedGraph
    group: CrowdGraph
    change_rate: float


@runtime_checkable
class MatrixSource(GraphSource, Protocol):
    """A source that decodes matrices, which become groups only by repair."""

    def decode(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[Decoded]:
        """One answer for each brief, in order; from an rng of the same state `sample` gives the same groups."""
        ...
