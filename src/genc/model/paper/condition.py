"""The condition network, shared by both VGAEs, and the prior networks (Gen-C, Condition Network)."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.distributions import Independent, Normal

from genc.model.condition import N_ACTIONS, Conditions
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES

MOST_LOG_VARIANCE = 10.0


class ConditionNetwork(nn.Module):
    """C `[B, 32]` of text embedding, normalised counts and action frequencies, each projected to 128 dimensions.

    The paper does not say: how deep the MLP behind their concatenation is (here two layers).
    """

    def __init__(self, text_dim: int, width: int, size: int) -> None:
        super().__init__()
        self.text = nn.Sequential(nn.Linear(text_dim, width), nn.LeakyReLU())
        self.counts = nn.Sequential(nn.Linear(3, width), nn.LeakyReLU())
        self.frequencies = nn.Sequential(nn.Linear(N_ACTIONS, width), nn.LeakyReLU())
        self.mlp = nn.Sequential(
            nn.Linear(3 * width, width), nn.LayerNorm(width), nn.LeakyReLU(), nn.Linear(width, size)
        )
        self.most: Tensor
        self.register_buffer("most", torch.tensor([MAX_AGENTS, MAX_EVENTS, MAX_NODES]), persistent=False)

    def forward(self, given: Conditions) -> Tensor:
        """C; every condition must be given."""
        parts = (
            self.text(given.text),
            self.counts(given.counts / self.most),
            self.frequencies(given.frequencies),
        )
        return self.mlp(torch.cat(parts, dim=1))  # type: ignore[no-any-return]


class GaussianHeads(nn.Module):
    """Two linear layers that give the mean and the log-variance of a diagonal Gaussian (Gen-C, eq. 2).

    The paper does not say: whether the log-variance is bounded (here to -10..10, which training never meets).
    """

    def __init__(self, width: int, latent: int) -> None:
        super().__init__()
        self.mean = nn.Linear(width, latent)
        self.log_variance = nn.Linear(width, latent)

    def forward(self, x: Tensor) -> Independent[Normal]:
        """A Gaussian over `[B, latent]`."""
        log_variance = self.log_variance(x).clamp(-MOST_LOG_VARIANCE, MOST_LOG_VARIANCE)
        return Independent(Normal(self.mean(x), (0.5 * log_variance).exp()), 1)
