"""`GroupBatch`: many groups as padded tensors, and the relations between their steps.

A *step* here is one turn of one event: what all its members do together. B groups, L structure tokens, T steps,
A = 15 agents.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional as F

from genc.graph.codec import Tokens, decode
from genc.graph.crowd_graph import CrowdGraph
from genc.words.vocabulary import MAX_AGENTS

PAD = -1
N_RELATIONS = 13


@dataclass(frozen=True, eq=False)
class GroupBatch:
    """Groups as tokens, padded with -1.

    Attributes:
        structure: `[B, L]` tokens of `genc.graph.codec`.
        action, category: `[B, T]` vocabulary indices.
    """

    structure: Tensor
    action: Tensor
    category: Tensor

    @staticmethod
    def of(groups: Sequence[Tokens]) -> GroupBatch:
        """The batch of these groups."""
        return GroupBatch(
            _padded([g.structure for g in groups]),
            _padded([g.action for g in groups]),
            _padded([g.category for g in groups]),
        )

    def __len__(self) -> int:
        return len(self.structure)

    def to(self, device: torch.device) -> GroupBatch:
        """The same batch on another device."""
        return GroupBatch(self.structure.to(device), self.action.to(device), self.category.to(device))

    def tokens(self) -> list[Tokens]:
        """Each group's tokens."""
        rows = (t.cpu().numpy() for t in (self.structure, self.action, self.category))
        return [Tokens(s[s >= 0], a[a >= 0], c[c >= 0]) for s, a, c in zip(*rows, strict=True)]

    def graphs(self) -> list[CrowdGraph]:
        """Each group as a checked graph."""
        return [decode(tokens) for tokens in self.tokens()]


@dataclass(frozen=True, eq=False)
class Steps:
    """The steps that a structure spells, before anybody says what is done in them.

    Attributes:
        members: bool `[B, T, A]`; all False in padding.
        turn, turns_left: `[B, T]` place in the event, and how many turns of it follow.
        event, events_left: `[B, T]` the same for the event in the group.
        steps_left: `[B, T]` steps of the group that follow.
    """

    members: Tensor
    turn: Tensor
    turns_left: Tensor
    event: Tensor
    events_left: Tensor
    steps_left: Tensor

    @property
    def valid(self) -> Tensor:
        """bool `[B, T]`, False in padding."""
        return self.members.any(-1)

    @property
    def n_members(self) -> Tensor:
        """`[B, T]`, 0 in padding."""
        return self.members.sum(-1)

    @staticmethod
    def of(structure: Tensor) -> Steps:
        """The steps of structure tokens `[B, L]`."""
        is_end = structure >= MAX_AGENTS
        n_turns = torch.where(is_end, structure - (MAX_AGENTS - 1), 0)  # (B, L)
        upto = n_turns.cumsum(1)
        total = upto[:, -1:]
        at = torch.arange(int(total.max()), device=structure.device).expand(len(structure), -1).contiguous()
        end = torch.searchsorted(upto, at, right=True)  # (B, T): the position of the event's end token
        valid = at < total
        end = end.clamp(max=structure.shape[1] - 1)
        event_at = (is_end.cumsum(1) - is_end.long()).clamp(min=0)  # event number of each token
        n_events = is_end.sum(1, keepdim=True)
        members = structure.new_zeros(len(structure), int(n_events.max()) + 1, MAX_AGENTS + 1)
        agent = torch.where((structure >= 0) & ~is_end, structure, MAX_AGENTS)
        rows = torch.arange(len(structure), device=structure.device)[:, None]
        members[rows, event_at, agent] = 1
        event = event_at.gather(1, end)
        start = (upto - n_turns).gather(1, end)
        turn = at - start
        of_step = members[rows, event][..., :MAX_AGENTS].bool() & valid[..., None]
        return Steps(
            of_step,
            torch.where(valid, turn, 0),
            torch.where(valid, n_turns.gather(1, end) - 1 - turn, 0),
            torch.where(valid, event, 0),
            torch.where(valid, n_events - 1 - event, 0),
            torch.where(valid, total - 1 - at, 0),
        )

    def relations(self) -> Tensor:
        """`[B, T, T]` in 0..12: how step s (row) is tied to step r (column).

        For r before s: 0, 1 of one event (neighbours; farther apart); 2, 3 somebody does r and then s with nothing
        between (the same people; others too); 4 some member in common; 5 nobody in common. 6 to 11 the same for r
        after s; 12 itself.
        """
        people = self.members.float()
        shared = people @ people.transpose(1, 2)  # (B, T, T)
        size = self.n_members.float()
        same_people = (shared == size[:, :, None]) & (shared == size[:, None, :])
        same_event = (self.event[:, :, None] == self.event[:, None, :]) & (shared > 0)
        neighbours = (self.turn[:, :, None] - self.turn[:, None, :]).abs() == 1
        direct = self._direct()
        kind = torch.where(shared > 0, 4, 5)
        kind = torch.where(direct, torch.where(same_people, 2, 3), kind)
        kind = torch.where(same_event, torch.where(neighbours, 0, 1), kind)
        t = torch.arange(kind.shape[1], device=kind.device)
        kind = torch.where(t[None, :] > t[:, None], kind + 6, kind)
        return torch.where(t[None, :] == t[:, None], N_RELATIONS - 1, kind)

    def _direct(self) -> Tensor:
        """bool `[B, T, T]`: some agent does r and then s (or s and then r) with nothing between."""
        b, n, agents = self.members.shape
        t = torch.arange(n, device=self.members.device)[:, None]
        latest = torch.where(self.members, t, -1).cummax(1).values  # (B, T, A)
        before = torch.cat([latest.new_full((b, 1, agents), -1), latest[:, :-1]], dim=1)
        before = torch.where(self.members & (before >= 0), before, n)
        follows = torch.zeros(b, n, n + 1, dtype=torch.bool, device=t.device).scatter_(2, before, True)[..., :n]
        return follows | follows.transpose(1, 2)


def _padded(rows: Sequence[np.ndarray]) -> Tensor:
    tensors = [torch.from_numpy(np.asarray(row, dtype=np.int64)) for row in rows]
    longest = max(len(t) for t in tensors)
    return torch.stack([F.pad(t, (0, longest - len(t)), value=PAD) for t in tensors])
