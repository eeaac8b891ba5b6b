"""Transformer blocks whose attention may be biased, masked and cached. B batch, Q queries, K keys, D width."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional as F

Past = tuple[Tensor, Tensor]
"""Keys and values `[B, heads, K, D / heads]` of what a block has seen."""


class Block(nn.Module):
    """One pre-norm transformer block."""

    def __init__(self, width: int, heads: int, dropout: float) -> None:
        super().__init__()
        self.heads = heads
        self.norm_attention = nn.LayerNorm(width)
        self.to_qkv = nn.Linear(width, 3 * width)
        self.out = nn.Linear(width, width)
        self.norm_mlp = nn.LayerNorm(width)
        self.mlp = nn.Sequential(
            nn.Linear(width, 3 * width), nn.GELU(), nn.Dropout(dropout), nn.Linear(3 * width, width)
        )
        self.dropout = nn.Dropout(dropout)

    def forward(self, x: Tensor, bias: Tensor | None, past: Past | None = None) -> tuple[Tensor, Past]:
        """The next layer's `[B, Q, D]`, and the keys and values seen so far.

        `bias` is added to the attention logits, `[B, heads or 1, Q, K]`, -inf where a key is hidden.
        """
        b, q, d = x.shape
        qkv = self.to_qkv(self.norm_attention(x)).view(b, q, 3, self.heads, d // self.heads)
        query, key, value = qkv.permute(2, 0, 3, 1, 4)
        if past is not None:
            key, value = torch.cat([past[0], key], dim=2), torch.cat([past[1], value], dim=2)
        mixed = F.scaled_dot_product_attention(query, key, value, attn_mask=bias)
        x = x + self.dropout(self.out(mixed.transpose(1, 2).reshape(b, q, d)))
        return x + self.dropout(self.mlp(self.norm_mlp(x))), (key, value)


class Stack(nn.Module):
    """Blocks and a final norm."""

    def __init__(self, width: int, heads: int, depth: int, dropout: float) -> None:
        super().__init__()
        self.blocks = nn.ModuleList(Block(width, heads, dropout) for _ in range(depth))
        self.norm = nn.LayerNorm(width)

    def forward(self, x: Tensor, bias: Tensor | None) -> Tensor:
        """`[B, Q, D]` to `[B, Q, D]`."""
        for block in self.blocks:
            x, _ = block(x, bias)
        return self.norm(x)  # type: ignore[no-any-return]

    def extend(self, x: Tensor, bias: Tensor | None, past: list[Past] | None) -> tuple[Tensor, list[Past]]:
        """The same for new positions `x` behind what `past` holds (None at the beginning)."""
        seen: list[Past] = []
        for i, block in enumerate(self.blocks):
            x, now = block(x, bias, None if past is None else past[i])
            seen.append(now)
        return self.norm(x), seen


def select(past: list[Past], rows: Tensor | slice) -> list[Past]:
    """The same cache for these rows only."""
    return [(key[rows], value[rows]) for key, value in past]


def hide(visible: Tensor, bias: Tensor | None = None) -> Tensor:
    """Attention bias that is -inf where `visible` `[B or 1, Q, K]` is False, else `bias` `[B, heads, Q, K]` or 0."""
    shown = visible[:, None]
    zeros = torch.zeros((), device=visible.device) if bias is None else bias
    return torch.where(shown, zeros, float("-inf"))
