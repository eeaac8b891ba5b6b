"""The two VGAEs as one module, and their losses (Gen-C, Training)."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.distributions import Independent, Normal, kl_divergence
from torch.nn import functional as F

from genc.model.condition import N_ACTIONS, Conditions
from genc.model.paper.condition import ConditionNetwork, GaussianHeads
from genc.model.paper.decoders import FeatureDecoder, StructureDecoder
from genc.model.paper.encoder import Encoder
from genc.model.paper.graphs import Batch, Structures

GAMMA = 1.5
"""Weight of the action term of L_F (Gen-C, eq. 4)."""


@dataclass(frozen=True)
class PaperConfig:
    """The shape of the network (Gen-C, Experiments) and which variant of the ablation it is.

    Attributes:
        text_dim: dimension of the text encoder: 768 for the paper's, all-mpnet-base-v2.
        n_known: groups trained on, whose counts and frequencies stand in for what a brief leaves open.
        canonical: False for "w/o Canonical": each graph's nodes in an order of its own, drawn once.
        single: True for "Single": one encoder, one latent and one prior for structure and features.
    """

    text_dim: int
    n_known: int
    width: int = 128
    latent: int = 32
    condition: int = 32
    dropout: float = 0.2
    canonical: bool = True
    single: bool = False


@dataclass(frozen=True, eq=False)
class Losses:
    """The terms of the objectives, one for each graph, `[B]`.

    Attributes:
        structure: L_S, SmoothL1 summed over all i, j.
        features: L_F, cross-entropy of actions (times gamma) and locations, summed over nodes.
        kl_structure, kl_features: KL(q(Z | X, C) || p(Z | C)) of both latents; one and the same where there is one.
    """

    structure: Tensor
    features: Tensor
    kl_structure: Tensor
    kl_features: Tensor


class PaperModel(nn.Module):
    """Condition network, two encoders, two conditional priors, two decoders.

    The paper does not say:
        Whether the encoder that the VGAEs "share" is one set of weights; Figure 3 speaks of "encoders", and its
        single-VGAE ablation has one: here two of one architecture.
        Whether the matrix beyond a graph's own nodes is part of L_S: here it is not, for n is given.
        The feature decoder's structure: the true one in training, the decoded one in sampling.
    """

    def __init__(self, config: PaperConfig) -> None:
        super().__init__()
        self.config = c = config
        n_latents = 1 if c.single else 2
        self.condition = ConditionNetwork(c.text_dim, c.width, c.condition)
        self.encoders = nn.ModuleList(Encoder(c.width, c.condition, c.latent, c.dropout) for _ in range(n_latents))
        self.priors = nn.ModuleList(GaussianHeads(c.condition, c.latent) for _ in range(n_latents))
        self.structure = StructureDecoder(c.latent, c.condition, c.width)
        self.features = FeatureDecoder(c.latent, c.condition, c.width)
        self.known_counts: Tensor
        self.known_frequencies: Tensor
        self.register_buffer("known_counts", torch.zeros(c.n_known, 3, dtype=torch.int16))
        self.register_buffer("known_frequencies", torch.zeros(c.n_known, N_ACTIONS))

    def forward(self, batch: Batch, given: Conditions) -> Losses:
        """The terms of L_VGAE-S and L_VGAE-F, at one draw of the latents."""
        condition = self.condition(given)
        posteriors = [encoder(batch, condition) for encoder in self.encoders]
        latents = [posterior.rsample() for posterior in posteriors]
        divergences = [kl_divergence(q, p) for q, p in zip(posteriors, self._priors(condition), strict=True)]
        matrix = self.structure(latents[0], condition)
        action, category = self.features(latents[-1], condition, batch.structures)
        return Losses(
            structure_loss(batch, matrix), features_loss(batch, action, category), divergences[0], divergences[-1]
        )

    def posterior_means(self, batch: Batch, given: Conditions) -> tuple[Tensor, Tensor]:
        """The means of q(Z_S | X, C) and q(Z_F | X, C), each `[B, latent]` (Gen-C, Latent Space Analysis)."""
        condition = self.condition(given)
        means = [encoder(batch, condition).mean for encoder in self.encoders]
        return means[0], means[-1]

    def draw_latents(self, given: Conditions, generator: torch.Generator) -> tuple[Tensor, Tensor, Tensor]:
        """Z_S and Z_F drawn from p(Z | C), and C (Gen-C, Crowd Scenario Generation)."""
        condition = self.condition(given)
        drawn = [p.mean + p.stddev * torch.randn(p.mean.shape, generator=generator) for p in self._priors(condition)]
        return drawn[0], drawn[-1], condition

    def label(self, z: Tensor, condition: Tensor, structures: Structures) -> tuple[Tensor, Tensor]:
        """Probabilities of action `[P, 13]` and location `[P, 8]` for each moment of the batch."""
        action, category = self.features.of_moments(z, condition, structures)
        return action.softmax(1), category.softmax(1)

    def _priors(self, condition: Tensor) -> list[Independent[Normal]]:
        return [prior(condition) for prior in self.priors]


def structure_loss(batch: Batch, matrix: Tensor) -> Tensor:
    """L_S of each graph, `[B]`, for decoded matrices `[B, 100, 100]` (Gen-C, eq. 4)."""
    n = batch.adjacency.shape[1]
    inside = torch.arange(n, device=matrix.device) < batch.structures.n_nodes[:, None]
    loss = F.smooth_l1_loss(matrix[:, :n, :n], batch.adjacency, reduction="none")
    return (loss * (inside[:, :, None] & inside[:, None, :])).sum((1, 2))


def features_loss(batch: Batch, action: Tensor, category: Tensor) -> Tensor:
    """L_F of each graph, `[B]`, for logits `[N, 13]` and `[N, 8]` (Gen-C, eq. 4)."""
    nodes = batch.nodes
    loss = GAMMA * F.cross_entropy(action, nodes.action, reduction="none")
    loss = loss + F.cross_entropy(category, nodes.category, reduction="none")
    return loss.new_zeros(len(batch.adjacency)).index_add(0, batch.structures.graph, loss)
