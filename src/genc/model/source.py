"""`GraphSource`: what every generator is to the rest of the product."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from genc.graph.crowd_graph import CrowdGraph
from genc.words.brief import Brief


class GraphSource(Protocol):
    """Something that answers briefs with groups."""

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief, in order; counts that a brief asks for are met exactly."""
        ...
