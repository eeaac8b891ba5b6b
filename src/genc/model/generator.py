"""`CodecGenerator`: a trained `codec` model with its text encoder, a `GraphSource`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch

from genc.graph.crowd_graph import CrowdGraph
from genc.model.codec import CodecModel
from genc.model.condition import Conditions
from genc.model.sampling import Sampling
from genc.model.tensors import GroupBatch
from genc.words.brief import Brief
from genc.words.embed import TextEncoder


@dataclass(frozen=True, eq=False)
class CodecGenerator:
    """Answers briefs with groups.

    Attributes:
        model: in evaluation mode.
        encoder: the text encoder that it was trained with.
        hash: sixteen hex digits of its weights.
        temperature, top_p, guidance: see `Sampling`; 1, 1 and 1 draw from the learned distribution.
    """

    model: CodecModel
    encoder: TextEncoder
    hash: str
    temperature: float = 1.0
    top_p: float = 1.0
    guidance: float = 1.0

    @property
    def settings(self) -> dict[str, float]:
        """What else its groups depend on, for the record."""
        return {"guidance": self.guidance}

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief, in order; requested counts are met exactly, frequencies nearly."""
        return self.sample_batch(self.conditions(briefs), rng).graphs() if briefs else []

    def sample_batch(self, given: Conditions, rng: np.random.Generator) -> GroupBatch:
        """The same as arrays, for conditions that are embedded already."""
        generator = torch.Generator().manual_seed(int(rng.integers(2**62)))
        return self.model.sample(given, Sampling(generator, self.temperature, self.top_p, self.guidance))

    def conditions(self, briefs: Sequence[Brief]) -> Conditions:
        """The briefs as tensors."""
        return Conditions.of(briefs, self.encoder)
