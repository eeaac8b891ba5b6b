"""How many agents, events and nodes a group has, where a brief leaves that open: p(counts | text, frequencies)."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from genc.model.condition import ConditionNet, Conditions
from genc.model.rules import feasible_counts
from genc.model.sampling import Sampling, guided
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES


class CountPrior(nn.Module):
    """A joint table p(agents) p(events | agents) p(nodes | agents, events) over all feasible counts.

    Being a table it can be conditioned on any subset of the counts exactly: ask for 12 nodes, and agents and events
    follow.
    """

    def __init__(self, text_dim: int, width: int, dropout: float) -> None:
        super().__init__()
        self.condition = ConditionNet(text_dim, width, dropout)
        self.dropout = nn.Dropout(dropout / 2)
        self.agents = nn.Linear(width, MAX_AGENTS)
        self.of_agents = nn.Embedding(MAX_AGENTS, width)
        self.events = nn.Linear(width, MAX_EVENTS)
        self.of_events = nn.Embedding(MAX_EVENTS, width)
        self.nodes = nn.Linear(width, MAX_NODES)
        self.feasible: Tensor
        self.register_buffer("feasible", feasible_counts(), persistent=False)

    def log_prob(self, given: Conditions, counts: Tensor) -> Tensor:
        """`[B]` log p(counts | text, frequencies); `counts` is `[B, 3]`."""
        agents, events, nodes = (counts - 1).unbind(1)
        hidden = self._hidden(given)
        after_agents = hidden + self.of_agents(agents)
        after_events = after_agents + self.of_events(events)
        allowed = self.feasible[agents, events]
        logits = [
            self.agents(F.leaky_relu(hidden)),
            self.events(F.leaky_relu(after_agents)),
            self.nodes(F.leaky_relu(after_events)).masked_fill(~allowed, float("-inf")),
        ]
        parts = [
            F.log_softmax(x, 1).gather(1, y[:, None])[:, 0]
            for x, y in zip(logits, (agents, events, nodes), strict=True)
        ]
        return torch.stack(parts).sum(0)

    def sample(self, given: Conditions, sampling: Sampling) -> Tensor:
        """Counts `[B, 3]` that agree with whatever `given.counts` asks for."""
        counts = given.counts.clone()
        left_open = (counts == 0).any(1).nonzero()[:, 0]
        if not len(left_open):
            return counts
        asked = given[left_open]
        alike = torch.cat([asked.text, asked.frequencies, asked.counts.float()], dim=1)
        _, kind = torch.unique(alike, dim=0, return_inverse=True)
        for k in range(int(kind.max()) + 1):
            rows = (kind == k).nonzero()[:, 0]
            one = asked[rows[:1]]
            told = [one] if sampling.guidance == 1 else [one, one.without_text()]
            log_p = guided([self._log_table(each) for each in told], sampling).flatten().nan_to_num(float("-inf"))
            p = (log_p - log_p.max()).exp()
            cells = torch.multinomial(p, len(rows), True, generator=sampling.generator)
            counts[left_open[rows]] = torch.stack(torch.unravel_index(cells, self.feasible.shape), dim=1) + 1
        return counts

    def _log_table(self, given: Conditions) -> Tensor:
        """`[B, agents, events, nodes]` log-probabilities, -inf where a requested count would be missed."""
        hidden = self._hidden(given)[:, None, :]
        after_agents = hidden + self.of_agents.weight  # (B, A, width)
        after_events = after_agents[:, :, None] + self.of_events.weight  # (B, A, E, width)
        nodes = self.nodes(F.leaky_relu(after_events)).masked_fill(~self.feasible, float("-inf"))
        log_p = (
            F.log_softmax(self.agents(F.leaky_relu(hidden[:, 0])), 1)[:, :, None, None]
            + F.log_softmax(self.events(F.leaky_relu(after_agents)), 2)[..., None]
            + F.log_softmax(nodes, 3)
        )
        for i, size in enumerate((MAX_AGENTS, MAX_EVENTS, MAX_NODES)):
            asked = given.counts[:, i, None]
            fits = (asked == 0) | (torch.arange(1, size + 1, device=asked.device) == asked)
            log_p = log_p.masked_fill(~fits.view(-1, *(size if k == i else 1 for k in range(3))), float("-inf"))
        return log_p

    def _hidden(self, given: Conditions) -> Tensor:
        blank = given.with_counts(torch.zeros_like(given.counts))
        return self.dropout(self.condition(blank))  # type: ignore[no-any-return]
