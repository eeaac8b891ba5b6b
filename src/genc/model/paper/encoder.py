"""The encoder: q(Z | X, C) (Gen-C, Encoder)."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.distributions import Independent, Normal

from genc.model.condition import N_ACTIONS
from genc.model.paper.condition import GaussianHeads
from genc.model.paper.gine import GINE
from genc.model.paper.graphs import Batch
from genc.model.paper.laplacian import N_VECTORS
from genc.words.vocabulary import CATEGORIES, MAX_AGENTS

N_FEATURES = 16 + 8 + 16 + 1 + 4 + N_VECTORS
"""49: action, location, agent, time, global index, Laplacian (Gen-C, Node Features)."""


class NodeFeatures(nn.Module):
    """The 49 features of each node."""

    def __init__(self) -> None:
        super().__init__()
        self.action = nn.Embedding(N_ACTIONS, 16)
        self.category = nn.Embedding(len(CATEGORIES), 8)
        self.agent = nn.Embedding(MAX_AGENTS, 16)

    def forward(self, batch: Batch) -> Tensor:
        """`[N, 49]`."""
        nodes, structures = batch.nodes, batch.structures
        parts = (
            self.action(nodes.action),
            self.category(nodes.category),
            self.agent(nodes.agent),
            nodes.time[:, None],
            sinusoids(structures.position),
            structures.laplacian,
        )
        return torch.cat(parts, dim=1)


def sinusoids(index: Tensor) -> Tensor:
    """`[N]` to `[N, 4]`: sine and cosine at the two wavelengths that 4 dimensions have (Vaswani et al. 2017)."""
    angle = index[:, None] * torch.tensor([1.0, 0.01], device=index.device)
    return torch.stack([angle.sin(), angle.cos()], dim=2).flatten(1)


class Encoder(nn.Module):
    """Two GINE layers with residuals, each followed by dropout; add pooling, normalised, beside C; Gaussian heads.

    Pooling adds up, as the paper has it, and LayerNorm then takes the size away again; C tells it.
    """

    def __init__(self, width: int, condition: int, latent: int, dropout: float) -> None:
        super().__init__()
        self.features = NodeFeatures()
        self.project = nn.Linear(N_FEATURES, width)
        self.layers = nn.ModuleList(GINE(width) for _ in range(2))
        self.dropout = nn.Dropout(dropout)
        self.norm = nn.LayerNorm(width)
        self.joint = nn.Sequential(nn.Linear(width + condition, width), nn.LeakyReLU())
        self.heads = GaussianHeads(width, latent)

    def forward(self, batch: Batch, condition: Tensor) -> Independent[Normal]:
        """q(Z | X, C) over `[B, latent]`."""
        h = self.project(self.features(batch))
        for layer in self.layers:
            h = h + self.dropout(layer(h, batch.structures))
        pooled = h.new_zeros(len(condition), h.shape[1]).index_add(0, batch.structures.graph, h)
        joint = torch.cat([self.norm(pooled), condition], dim=1)
        return self.heads(self.joint(joint))  # type: ignore[no-any-return]
