"""How a token is drawn from its distribution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import torch
from torch import Tensor


@dataclass(frozen=True)
class Sampling:
    """How to draw.

    Attributes:
        generator: the source of chance.
        temperature: 1 draws from the learned distribution; below 1 is tamer (and distorts every statistic).
        top_p: draw from the smallest set of tokens that holds this much probability; 1 for all.
        guidance: how far the text steers: 1 as learned, more for more (classifier-free guidance, Ho and Salimans
            2022: the difference that the text makes to the logits, times this).
    """

    generator: torch.Generator
    temperature: float = 1.0
    top_p: float = 1.0
    guidance: float = 1.0

    def seeded(self, seed: int) -> Sampling:
        """The same way of drawing from a chance of its own."""
        return replace(self, generator=torch.Generator().manual_seed(seed))


def guided(logits: Sequence[Tensor], sampling: Sampling) -> Tensor:
    """The logits to draw from, given those with the text and, if guidance asks for it, those without."""
    if len(logits) == 1:
        return logits[0]
    told, untold = logits
    return untold + sampling.guidance * (told - untold)


def draw(logits: Tensor, sampling: Sampling) -> Tensor:
    """One index for each row of `[B, K]` logits, -inf where a token is forbidden."""
    p = torch.softmax(logits / sampling.temperature, dim=1)
    if sampling.top_p < 1:
        ordered, index = p.sort(dim=1, descending=True)
        ordered = ordered.masked_fill(ordered.cumsum(1) - ordered >= sampling.top_p, 0.0)
        p = torch.zeros_like(p).scatter(1, index, ordered)
    return torch.multinomial(p, 1, generator=sampling.generator)[:, 0]
