"""What a generator is told, as tensors, and the network that makes one vector of it (Gen-C, Condition Network)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import torch
from torch import Tensor, nn

from genc.words.brief import Brief
from genc.words.embed import TextEncoder
from genc.words.vocabulary import ACTIONS, MAX_AGENTS, MAX_EVENTS, MAX_NODES

N_ACTIONS = len(ACTIONS)
UNKNOWN = 0
"""A count that was not asked for."""


@dataclass(frozen=True, eq=False)
class Conditions:
    """Briefs as tensors.

    Attributes:
        text: `[B, text_dim]` sentence embeddings; all zero where no text is given.
        counts: integers `[B, 3]`: agents, events, nodes; 0 where not given.
        frequencies: `[B, 13]` shares; all zero where not given.
    """

    text: Tensor
    counts: Tensor
    frequencies: Tensor

    @staticmethod
    def of(briefs: Sequence[Brief], encoder: TextEncoder) -> Conditions:
        """The conditions of at least one brief; each distinct text is embedded once."""
        distinct = {text: i for i, text in enumerate(dict.fromkeys(b.text for b in briefs))}
        vectors = torch.from_numpy(encoder.encode(list(distinct)))
        counts = [[b.n_agents or UNKNOWN, b.n_events or UNKNOWN, b.n_nodes or UNKNOWN] for b in briefs]
        frequencies = [b.action_frequencies or (0.0,) * N_ACTIONS for b in briefs]
        text = vectors[[distinct[b.text] for b in briefs]]
        return Conditions(text, torch.tensor(counts), torch.tensor(frequencies))

    def __len__(self) -> int:
        return len(self.text)

    def __getitem__(self, rows: Tensor) -> Conditions:
        return Conditions(self.text[rows], self.counts[rows], self.frequencies[rows])

    def to(self, device: torch.device) -> Conditions:
        """The same on another device."""
        return Conditions(self.text.to(device), self.counts.to(device), self.frequencies.to(device))

    def with_counts(self, counts: Tensor) -> Conditions:
        """The same with these counts."""
        return replace(self, counts=counts)

    def without_text(self) -> Conditions:
        """The same with no text."""
        return replace(self, text=torch.zeros_like(self.text))


class ConditionNet(nn.Module):
    """The condition vector C `[B, width]` of (text, counts, action frequencies), each of which may be missing.

    Departs from the paper: texts are few (hundreds of sentences), so an embedding passes through heavy dropout and
    a narrow layer before it meets the rest; a missing condition is a learned vector.
    """

    def __init__(self, text_dim: int, width: int, dropout: float) -> None:
        super().__init__()
        self.text = nn.Sequential(nn.Dropout(dropout), nn.Linear(text_dim, width // 2), nn.LeakyReLU())
        self.counts = nn.Sequential(nn.Linear(6, width), nn.LeakyReLU())
        self.frequencies = nn.Sequential(nn.Linear(N_ACTIONS, width), nn.LeakyReLU())
        self.no_text = nn.Parameter(torch.zeros(width // 2))
        self.no_counts = nn.Parameter(torch.zeros(width))
        self.no_frequencies = nn.Parameter(torch.zeros(width))
        joint = width // 2 + 2 * width
        self.mix = nn.Sequential(nn.LayerNorm(joint), nn.Linear(joint, width), nn.LeakyReLU(), nn.Linear(width, width))
        self.most: Tensor
        self.register_buffer("most", torch.tensor([MAX_AGENTS, MAX_EVENTS, MAX_NODES]), persistent=False)

    def forward(self, given: Conditions) -> Tensor:
        """C `[B, width]`."""
        share = given.counts / self.most  # the paper's normalised counts
        scaled = torch.cat([share, (given.counts.float() + 1).log() / 3], dim=1)
        parts = [
            torch.where(given.text.any(1, keepdim=True), self.text(given.text), self.no_text),
            torch.where(given.counts.any(1, keepdim=True), self.counts(scaled), self.no_counts),
            torch.where(
                given.frequencies.any(1, keepdim=True),
                self.frequencies(4 * given.frequencies),
                self.no_frequencies,
            ),
        ]
        return self.mix(torch.cat(parts, dim=1))  # type: ignore[no-any-return]
