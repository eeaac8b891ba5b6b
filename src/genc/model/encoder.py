"""The posterior q(Z_S, Z_F | X, C) (Gen-C, Encoder)."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.distributions import Independent, Normal

from genc.model.attention import Stack, hide
from genc.model.condition import N_ACTIONS
from genc.model.tensors import N_RELATIONS, GroupBatch, Steps
from genc.words.vocabulary import CATEGORIES, MAX_AGENTS

N_CATEGORIES = len(CATEGORIES)


class StepEmbedding(nn.Module):
    """What the structure says of each step, `[B, T, width]`: its people, and its place in its event and group."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.members = nn.Embedding(MAX_AGENTS + 1, width)
        self.turn = nn.Embedding(8, width)
        self.turns_left = nn.Embedding(8, width)
        self.event = nn.Embedding(16, width)
        self.steps_left = nn.Embedding(16, width)
        self.shares = nn.Linear(4, width)

    def forward(self, steps: Steps) -> Tensor:
        """`[B, T, width]`."""
        count = steps.members.long().cumsum(1)
        total = count[:, -1:]
        size = steps.n_members.clamp(min=1)
        first = (steps.members & (count == 1)).sum(-1)
        last = (steps.members & (count == total)).sum(-1)
        newcomers = (steps.members & (count == 1)).any(-1)
        shares = torch.stack([first / size, last / size, newcomers.float(), steps.events_left / 10], dim=-1)
        return (  # type: ignore[no-any-return]
            self.members(steps.n_members)
            + self.turn(steps.turn.clamp(max=7))
            + self.turns_left(steps.turns_left.clamp(max=7))
            + self.event(steps.event.clamp(max=15))
            + self.steps_left(steps.steps_left.clamp(max=15))
            + self.shares(shares)
        )


class RelationBias(nn.Module):
    """An attention bias for each head by how two steps are tied."""

    def __init__(self, heads: int) -> None:
        super().__init__()
        self.bias = nn.Embedding(N_RELATIONS, heads)

    def forward(self, relations: Tensor) -> Tensor:
        """`[B, T, T]` relations to `[B, heads, T, T]`."""
        return self.bias(relations).permute(0, 3, 1, 2)  # type: ignore[no-any-return]


class Encoder(nn.Module):
    """Reads a whole group, structure and content, into the two posteriors.

    Departs from the paper: attention biased by the edges takes the place of GINE layers, on one token for each step
    (all nodes of a step share action and category); the two posteriors share one body.
    """

    def __init__(self, width: int, heads: int, depth: int, latent: int, dropout: float) -> None:
        super().__init__()
        self.step = StepEmbedding(width)
        self.action = nn.Embedding(N_ACTIONS, width)
        self.category = nn.Embedding(N_CATEGORIES, width)
        self.relation = RelationBias(heads)
        self.body = Stack(width, heads, depth, dropout)
        self.head = nn.Sequential(nn.Linear(3 * width, width), nn.LeakyReLU(), nn.Linear(width, 4 * latent))

    def forward(self, groups: GroupBatch, steps: Steps, condition: Tensor) -> Independent[Normal]:
        """q(Z | X, C) over `[B, 2 * latent]`: Z_S, then Z_F."""
        valid = steps.valid
        x = self.step(steps) + self.action(groups.action.clamp(min=0)) + self.category(groups.category.clamp(min=0))
        bias = hide(valid[:, None, :], self.relation(steps.relations()))
        hidden = self.body(x, bias) * valid[..., None]
        total = hidden.sum(1)
        pooled = torch.cat([total / valid.sum(1, keepdim=True), total / 10, condition], dim=1)
        mean, log_scale = self.head(pooled).chunk(2, dim=1)
        return Independent(Normal(mean, log_scale.clamp(-4, 1).exp()), 1)
