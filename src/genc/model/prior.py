"""The conditional prior p(Z_S, Z_F | C), joint over both latents (Gen-C, Condition Network)."""

from __future__ import annotations

import torch
import zuko
from torch import Tensor, nn


class Prior(nn.Module):
    """A coupling flow: one pass to score, one to sample.

    Departs from the paper: its two Gaussian priors are independent given C, and leave the gap between posterior and
    prior open; a flow over both latents at once closes it (docs/decisions/0003).
    """

    def __init__(self, latent: int, context: int) -> None:
        super().__init__()
        self.size = 2 * latent
        self.flow = zuko.flows.NICE(self.size, context, transforms=4, hidden_features=(96,))

    def log_prob(self, z: Tensor, condition: Tensor) -> Tensor:
        """`[B]` log p(z | C)."""
        return self.flow(condition).log_prob(z)  # type: ignore[no-any-return]

    def sample(self, condition: Tensor, generator: torch.Generator) -> Tensor:
        """z `[B, 2 * latent]`."""
        noise = torch.randn(len(condition), self.size, generator=generator, device=condition.device)
        return self.flow(condition).transform.inv(noise)  # type: ignore[no-any-return]
