"""p(structure | Z_S, C, counts): who takes part in each event and for how many turns (Gen-C, Structure Decoder)."""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from genc.graph.codec import N_STRUCTURE_TOKENS
from genc.model.attention import Past, Stack, hide, select
from genc.model.rules import N_FEATURES, StructureRules
from genc.model.sampling import Sampling, draw, guided
from genc.model.tensors import PAD
from genc.words.vocabulary import MAX_EVENTS


class StructureDecoder(nn.Module):
    """A causal transformer over structure tokens, under the masks of `StructureRules`.

    Departs from the paper: tokens drawn one after another take the place of n x n tanh outputs, which at a sample of
    the prior give the mean of many graphs and no graph (docs/decisions/0003).
    """

    def __init__(self, width: int, heads: int, depth: int, context: int, dropout: float) -> None:
        super().__init__()
        self.start = N_STRUCTURE_TOKENS
        self.token = nn.Embedding(N_STRUCTURE_TOKENS + 1, width)
        self.event = nn.Embedding(MAX_EVENTS + 1, width)
        self.state = nn.Linear(N_FEATURES, width)
        self.context = nn.Linear(context, width)
        self.body = Stack(width, heads, depth, dropout)
        self.out = nn.Linear(width, N_STRUCTURE_TOKENS)

    def log_prob(self, structure: Tensor, trace: Trace, context: Tensor) -> Tensor:
        """`[B]` log-likelihood of tokens `[B, L]` under `context` `[B, context]` (Z_S and C)."""
        before = F.pad(structure.clamp(min=0), (1, -1), value=self.start)
        x = self._embed(before, trace.event, trace.features, context[:, None])
        n = x.shape[1]
        causal = torch.ones(1, n, n, dtype=torch.bool, device=x.device).tril()
        logits = self.out(self.body(x, hide(causal))).masked_fill(~trace.mask, float("-inf"))
        loss = F.cross_entropy(logits.transpose(1, 2), structure, ignore_index=PAD, reduction="none")
        return -loss.sum(1)

    def sample(self, rules: StructureRules, contexts: Sequence[Tensor], sampling: Sampling) -> Tensor:
        """Tokens `[B, L]`, padded with -1, that use up exactly the counts that `rules` starts from.

        `contexts` are one or two `[B, context]`, see `guided`.
        """
        rows = torch.arange(len(contexts[0]), device=contexts[0].device)
        n_rows, n_events = len(rows), rules.events
        token = torch.full_like(rows, self.start)
        pasts: list[list[Past] | None] = [None] * len(contexts)
        columns: list[Tensor] = []
        while len(rows):
            logits = []
            for i, context in enumerate(contexts):
                x = self._embed(token, n_events - rules.events, rules.features(), context)[:, None]
                hidden, pasts[i] = self.body.extend(x, None, pasts[i])
                logits.append(self.out(hidden[:, 0]))
            token = draw(guided(logits, sampling).masked_fill(~rules.mask(), float("-inf")), sampling)
            columns.append(rows.new_full((n_rows,), PAD).index_copy(0, rows, token))
            rules.advance(token)
            keep = (~rules.finished).nonzero()[:, 0]
            if len(keep) < len(rows):
                rules.select(keep)
                rows, token, n_events = rows[keep], token[keep], n_events[keep]
                contexts = [context[keep] for context in contexts]
                pasts = [None if past is None else select(past, keep) for past in pasts]
        return torch.stack(columns, dim=1)

    def _embed(self, before: Tensor, event: Tensor, features: Tensor, context: Tensor) -> Tensor:
        return (  # type: ignore[no-any-return]
            self.token(before) + self.event(event) + self.state(features) + self.context(context)
        )


class Trace:
    """What the rules say along authored structures: computed once, used in every epoch.

    Attributes:
        mask: bool `[B, L, N_STRUCTURE_TOKENS]` tokens allowed; all True in padding.
        features: `[B, L, N_FEATURES]`.
        event: `[B, L]` the number of the event under way.
    """

    def __init__(self, mask: Tensor, features: Tensor, event: Tensor) -> None:
        self.mask, self.features, self.event = mask, features, event

    @staticmethod
    def of(structure: Tensor, counts: Tensor) -> Trace:
        """The trace of tokens `[B, L]` that have these counts `[B, 3]` (agents, events, nodes)."""
        rules = StructureRules(*counts.unbind(1))
        masks, features, events = [], [], []
        for token in structure.unbind(1):
            masks.append(rules.mask() | (token == PAD)[:, None])
            features.append(rules.features())
            events.append(counts[:, 1] - rules.events)
            rules.advance(token.clamp(min=0))
        return Trace(torch.stack(masks, 1), torch.stack(features, 1), torch.stack(events, 1))

    def __getitem__(self, key: tuple[Tensor, slice]) -> Trace:
        return Trace(self.mask[key], self.features[key], self.event[key])

    def to(self, device: torch.device) -> Trace:
        """The same on another device."""
        return Trace(self.mask.to(device), self.features.to(device), self.event.to(device))
