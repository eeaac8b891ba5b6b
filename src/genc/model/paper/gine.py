"""The GINE layer (Hu et al. 2020; Gen-C, Encoder, eq. 1)."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from genc.model.paper.graphs import Structures


class GINE(nn.Module):
    """`MLP((1 + eps) h_v + sum over neighbours u of ReLU(h_u + e_uv))`, without the residual of eq. 1.

    The message's ReLU is that of GINE as published; LeakyReLU stands inside the MLP.

    The paper does not say: how an edge's kind becomes e_uv (here a learned vector each), whether eps is learned (here
    it is), and how deep the MLP is (here two layers).
    """

    def __init__(self, width: int) -> None:
        super().__init__()
        self.edge = nn.Embedding(2, width)
        self.epsilon = nn.Parameter(torch.zeros(()))
        self.mlp = nn.Sequential(nn.Linear(width, width), nn.LeakyReLU(), nn.Linear(width, width))

    def forward(self, h: Tensor, structures: Structures) -> Tensor:
        """`[N, width]` to `[N, width]`."""
        messages = torch.relu(h.index_select(0, structures.source) + self.edge(structures.kind))
        gathered = torch.zeros_like(h).index_add(0, structures.target, messages)
        return self.mlp((1 + self.epsilon) * h + gathered)  # type: ignore[no-any-return]
