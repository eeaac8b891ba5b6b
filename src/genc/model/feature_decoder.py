"""p(actions, categories | structure, Z_F, C): what is done at each step (Gen-C, Feature Decoder)."""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from genc.model.attention import Past, Stack, hide, select
from genc.model.condition import N_ACTIONS
from genc.model.encoder import N_CATEGORIES, RelationBias, StepEmbedding
from genc.model.sampling import Sampling, draw, guided
from genc.model.tensors import PAD, GroupBatch, Steps


class FeatureDecoder(nn.Module):
    """Draws action and category step by step; all members of a step share them.

    That one draw serves a whole step is the paper's collapse, predict, uncollapse. Each step has two tokens: a
    *question* (who, and where in the structure) and an *answer* (the same with what is done). A question sees the
    answers of all steps before it; attention is biased by how two steps are tied.
    """

    def __init__(self, width: int, heads: int, depth: int, context: int, dropout: float) -> None:
        super().__init__()
        self.step = StepEmbedding(width)
        self.context = nn.Linear(context, width)
        self.outline_bias = RelationBias(heads)
        self.outline = Stack(width, heads, 1, dropout)
        self.question = nn.Parameter(torch.zeros(width))
        self.left = nn.Linear(N_ACTIONS, width, bias=False)
        self.action = nn.Embedding(N_ACTIONS, width)
        self.category = nn.Embedding(N_CATEGORIES, width)
        self.relation = RelationBias(heads)
        self.body = Stack(width, heads, depth, dropout)
        self.to_action = nn.Linear(width, N_ACTIONS)
        self.to_category = nn.Sequential(nn.Linear(width, width), nn.GELU(), nn.Linear(width, N_CATEGORIES))

    def log_prob(self, groups: GroupBatch, steps: Steps, context: Tensor, wanted: Tensor) -> Tensor:
        """`[B]` log-likelihood of actions and categories.

        `context` is `[B, context]` (Z_F and C); `wanted` `[B, 13]` holds the number of nodes with each action that the
        brief asks for, all zero where it does not.
        """
        relations = steps.relations()
        outline = self._outline(steps, relations, context)
        action, category = groups.action.clamp(min=0), groups.category.clamp(min=0)
        answers = outline + self.action(action) + self.category(category)
        used = F.one_hot(action, N_ACTIONS) * steps.n_members[..., None]
        left = self._left(wanted[:, None], used.cumsum(1) - used, steps.n_members)
        questions = outline + self.question + self.left(left)
        n = action.shape[1]
        before = torch.ones(1, n, n, dtype=torch.bool, device=action.device).tril(-1)
        same = torch.eye(n, dtype=torch.bool, device=action.device)[None]
        upper = torch.cat([before | same, torch.zeros_like(same)], dim=2)  # answers see answers
        lower = torch.cat([before, same], dim=2)  # questions see the answers before, and themselves
        bias = self.relation(relations).repeat(1, 1, 2, 2)
        hidden = self.body(torch.cat([answers, questions], dim=1), hide(torch.cat([upper, lower], dim=1), bias))[:, n:]
        return -self._loss(hidden, groups.action, self.to_action) - self._loss(
            hidden + self.action(action), groups.category, self.to_category
        )

    def sample(
        self, steps: Steps, contexts: Sequence[Tensor], wanted: Tensor, sampling: Sampling
    ) -> tuple[Tensor, Tensor]:
        """Actions and categories `[B, T]`, padded with -1. Rows must come in order of falling length.

        `contexts` are one or two `[B, context]`, see `guided`.
        """
        relations = steps.relations()
        outlines = [self._outline(steps, relations, context) for context in contexts]
        bias = self.relation(relations)
        length = steps.valid.sum(1)
        action, category = torch.full_like(steps.turn, PAD), torch.full_like(steps.turn, PAD)
        used = torch.zeros_like(wanted)
        pasts: list[list[Past] | None] = [None] * len(contexts)
        for t in range(action.shape[1]):
            b = int((length > t).sum())
            question = self.question + self.left(self._left(wanted[:b], used[:b], steps.n_members[:b, t]))
            # the answer of the step before comes in with the question of this one
            answer = self.action(action[:b, t - 1]) + self.category(category[:b, t - 1]) if t > 0 else None
            seen = self._seen(bias[:b], t)
            asked = []
            for i, outline in enumerate(outlines):
                new = (
                    [outline[:b, t] + question]
                    if answer is None
                    else [outline[:b, t - 1] + answer, outline[:b, t] + question]
                )
                past = pasts[i]
                hidden, past = self.body.extend(
                    torch.stack(new, 1), seen, None if past is None else select(past, slice(b))
                )
                # a question is asked once: later steps see answers only
                pasts[i] = [(key[:, :, :-1], value[:, :, :-1]) for key, value in past]
                asked.append(hidden[:, -1])
            action[:b, t] = draw(guided([self.to_action(h) for h in asked], sampling), sampling)
            done = self.action(action[:b, t])
            category[:b, t] = draw(guided([self.to_category(h + done) for h in asked], sampling), sampling)
            used[:b] += F.one_hot(action[:b, t], N_ACTIONS) * steps.n_members[:b, t, None]
        return action, category

    @staticmethod
    def _seen(bias: Tensor, t: int) -> Tensor:
        """The attention bias of what is new at step t (the last answer, the question) to all that is before it."""
        question = bias[:, :, t : t + 1, : t + 1]
        if t == 0:
            return question
        answer = F.pad(bias[:, :, t - 1 : t, :t], (0, 1), value=float("-inf"))
        return torch.cat([answer, question], dim=2)

    def _outline(self, steps: Steps, relations: Tensor, context: Tensor) -> Tensor:
        """`[B, T, width]`: each step seen within the whole structure."""
        x = self.step(steps) + self.context(context)[:, None]
        seen: Tensor = self.outline(x, hide(steps.valid[:, None, :], self.outline_bias(relations)))
        return x + seen  # type: ignore[no-any-return]

    @staticmethod
    def _left(wanted: Tensor, used: Tensor, size: Tensor) -> Tensor:
        """How many of each action are still wanted, in units of this step's people, on a scale near 1."""
        asked = wanted.any(-1, keepdim=True)
        return torch.where(asked, ((wanted - used) / size.clamp(min=1)[..., None]).clamp(-2, 4), 0.0)

    @staticmethod
    def _loss(hidden: Tensor, target: Tensor, head: nn.Module) -> Tensor:
        logits = head(hidden).transpose(1, 2)
        return F.cross_entropy(logits, target, ignore_index=PAD, reduction="none").sum(1)
