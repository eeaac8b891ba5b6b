"""The two decoders (Gen-C, Structure Decoder and Feature Decoder)."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from genc.model.condition import N_ACTIONS
from genc.model.paper.gine import GINE
from genc.model.paper.graphs import Structures
from genc.model.paper.laplacian import N_VECTORS
from genc.words.vocabulary import CATEGORIES, MAX_NODES


class StructureDecoder(nn.Module):
    """[Z_S; C] to the adjacency `U + U^T`, `U_ij = tanh(f(...)_ij)` for i < j, zero diagonal (Gen-C, eq. 3)."""

    def __init__(self, latent: int, condition: int, width: int) -> None:
        super().__init__()
        self.mlp = nn.Sequential(
            *(nn.Linear(latent + condition, width), nn.LayerNorm(width), nn.LeakyReLU()),
            *(nn.Linear(width, width), nn.LayerNorm(width), nn.LeakyReLU()),
            nn.Linear(width, MAX_NODES * (MAX_NODES - 1) // 2),
        )
        self.rows: Tensor
        self.columns: Tensor
        rows, columns = torch.triu_indices(MAX_NODES, MAX_NODES, offset=1)
        self.register_buffer("rows", rows, persistent=False)
        self.register_buffer("columns", columns, persistent=False)

    def forward(self, z: Tensor, condition: Tensor) -> Tensor:
        """`[B, 100, 100]`, entries in -1..1; the first n rows and columns are those of a graph of n nodes."""
        upper = z.new_zeros(len(z), MAX_NODES, MAX_NODES)
        upper[:, self.rows, self.columns] = torch.tanh(self.mlp(torch.cat([z, condition], dim=1)))
        return upper + upper.transpose(1, 2)


class FeatureDecoder(nn.Module):
    """[Z_F; C] and a structure to logits of action and location for each node, equal within each moment.

    Z_F and C are given to every node, beside its projected positional encodings (share-only and full Laplacian, and
    the normalised group identifier); two pre-norm GINE layers with residuals; then collapse, predict, uncollapse.

    The paper does not say: what the group identifier numbers (here the connected parts of share edges, as they are
    collapsed), how wide its projection is (here as wide as C), and how a part collapses (here to its mean).
    """

    def __init__(self, latent: int, condition: int, width: int) -> None:
        super().__init__()
        self.positions = nn.Sequential(nn.Linear(2 * N_VECTORS + 1, condition), nn.LeakyReLU())
        self.fuse = nn.Sequential(nn.Linear(latent + 2 * condition, width), nn.LeakyReLU())
        self.norms = nn.ModuleList(nn.LayerNorm(width) for _ in range(2))
        self.layers = nn.ModuleList(GINE(width) for _ in range(2))
        self.norm = nn.LayerNorm(width)
        self.action = nn.Linear(width, N_ACTIONS)
        self.category = nn.Linear(width, len(CATEGORIES))

    def forward(self, z: Tensor, condition: Tensor, structures: Structures) -> tuple[Tensor, Tensor]:
        """Logits `[N, 13]` and `[N, 8]`."""
        action, category = self.of_moments(z, condition, structures)
        return action[structures.moment], category[structures.moment]

    def of_moments(self, z: Tensor, condition: Tensor, structures: Structures) -> tuple[Tensor, Tensor]:
        """The same before they are uncollapsed, one row for each moment of the batch."""
        encodings = (structures.share_laplacian, structures.laplacian, structures.moment_share[:, None])
        told = torch.cat([z, condition], dim=1)[structures.graph]
        h = self.fuse(torch.cat([told, self.positions(torch.cat(encodings, dim=1))], dim=1))
        for norm, layer in zip(self.norms, self.layers, strict=True):
            h = h + layer(norm(h), structures)
        collapsed = _mean_of_parts(self.norm(h), structures.moment)
        return self.action(collapsed), self.category(collapsed)


def _mean_of_parts(h: Tensor, part: Tensor) -> Tensor:
    """`[N, D]` to the mean of each part `[P, D]`; every part 0..P-1 has a node."""
    size = torch.bincount(part)
    return h.new_zeros(len(size), h.shape[1]).index_add(0, part, h) / size[:, None]
