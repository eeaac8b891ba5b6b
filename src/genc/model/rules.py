"""Which structure token may come next: masks under which every sample is valid and every count exact.

The requested numbers of agents, events and nodes are always known when a structure is decoded (those that a brief
leaves open are drawn first, `genc.model.counts`). A state is *alive* if the rest can still be completed: all agents
introduced, all parts joined into one group, all nodes used up, in exactly the events that are left. With E events
left, R nodes left and `need` = parts + agents still to introduce, that is

    E = 0:  R = 0 and need = 1
    E = 1:  some m in [need, A] divides R           (one event of m agents and R/m turns)
    E > 1:  R >= E - 1 + need                       (an event of one agent takes up any surplus)

and a token may come next exactly if it leads to a state that is alive. Neither is any valid group excluded nor can
decoding run into a dead end; `tests/model` checks both.
"""

from __future__ import annotations

from functools import cache

import torch
from torch import Tensor

from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES

N_FEATURES = 10


@cache
def _one_event_table() -> Tensor:
    """bool `[R, need, A]`: one event of m agents, need <= m <= A, uses up exactly R > 0 nodes."""
    table = torch.zeros(MAX_NODES + 1, MAX_AGENTS + 2, MAX_AGENTS + 1, dtype=torch.bool)
    for nodes in range(1, MAX_NODES + 1):
        for size in range(1, min(nodes, MAX_AGENTS) + 1):
            if nodes % size == 0:
                table[nodes, : size + 1, size:] = True
    return table


@cache
def _two_event_table() -> Tensor:
    """bool `[R, m, need, A]`: an event of m agents and some k turns, then one last event, use up exactly R nodes."""
    one = _one_event_table()
    table = torch.zeros(MAX_NODES + 1, MAX_AGENTS + 1, *one.shape[1:], dtype=torch.bool)
    for size in range(1, MAX_AGENTS + 1):
        for nodes in range(size + 1, MAX_NODES + 1):
            table[nodes, size] = one[nodes % size : nodes - size + 1 : size].any(0)
    return table


def feasible_counts() -> Tensor:
    """bool `[agents, events, nodes]`: which counts, each less one, some valid group has."""
    agents = torch.arange(1, MAX_AGENTS + 1)[:, None, None]
    events = torch.arange(1, MAX_EVENTS + 1)[None, :, None]
    nodes = torch.arange(1, MAX_NODES + 1)[None, None, :]
    return torch.where(events == 1, nodes % agents == 0, nodes >= events - 1 + agents)


class StructureRules:
    """The state of B structures under way.

    Args:
        n_agents, n_events, n_nodes: `[B]` the requested counts.
    """

    def __init__(self, n_agents: Tensor, n_events: Tensor, n_nodes: Tensor) -> None:
        self.n_agents, self.events, self.nodes = n_agents, n_events, n_nodes
        self.known = torch.zeros_like(n_agents)
        """Agents introduced so far."""
        agents = torch.arange(MAX_AGENTS, device=n_agents.device)
        self.part = agents.repeat(len(n_agents), 1)
        """`[B, A]` for each agent the least agent of its part; its own number while it is unknown."""
        self.inside = torch.zeros_like(self.part, dtype=torch.bool)
        """`[B, A]` who takes part in the event under way."""
        self.last = torch.full_like(n_agents, -1)
        """The last agent named in the event under way, or -1."""

    @property
    def finished(self) -> Tensor:
        """bool `[B]`: nothing is left to say."""
        return self.events == 0

    def select(self, rows: Tensor) -> None:
        """Keeps these rows only."""
        for name in ("n_agents", "events", "nodes", "known", "part", "inside", "last"):
            setattr(self, name, getattr(self, name)[rows])

    def features(self) -> Tensor:
        """`[B, 10]`: what is left and what is under way, on scales near 1."""
        parts, touched = self._parts()
        columns = [
            self.nodes / 20,
            (self.nodes + 1).log() / 3,
            self.events / 6,
            (self.n_agents - self.known) / 4,
            self.known / 4,
            self.inside.sum(1) / 4,
            parts / 4,
            touched / 4,
            self.nodes / self.events.clamp(min=1) / 4,
            (self.events == 1).float(),
        ]
        return torch.stack([c.float() for c in columns], dim=1)

    def mask(self) -> Tensor:
        """bool `[B, N_STRUCTURE_TOKENS]`: the tokens that may come next."""
        parts, touched = self._parts()
        need = parts - touched + 1 + self.n_agents - self.known
        return torch.cat([self._agent_mask(need), self._turns_mask(need)], dim=1)

    def advance(self, token: Tensor) -> None:
        """Takes one allowed token `[B]` for each row; rows that are finished ignore theirs."""
        live = ~self.finished
        is_end = (token >= MAX_AGENTS) & live
        agent = torch.where(live & ~is_end, token, 0)
        named = live & ~is_end
        self.known = torch.where(named & (token == self.known), self.known + 1, self.known)
        self.inside |= named[:, None] & (torch.arange(MAX_AGENTS, device=token.device) == agent[:, None])
        self.last = torch.where(named, token, self.last)
        self._join(is_end)
        n_turns = token - (MAX_AGENTS - 1)
        self.nodes = torch.where(is_end, self.nodes - n_turns * self.inside.sum(1), self.nodes)
        self.events = self.events - is_end.long()
        self.last = torch.where(is_end, -1, self.last)
        self.inside &= ~is_end[:, None]

    def _join(self, is_end: Tensor) -> None:
        """Makes one part of all that the ended events touch."""
        touched = self._touched()
        least = torch.where(touched, torch.arange(MAX_AGENTS, device=touched.device), MAX_AGENTS).amin(1)
        joins = touched.gather(1, self.part) & is_end[:, None]
        self.part = torch.where(joins, least[:, None], self.part)

    def _touched(self) -> Tensor:
        """bool `[B, A]`: parts, by their least agent, that the event under way touches."""
        return torch.zeros_like(self.inside).scatter_reduce(1, self.part, self.inside, "amax")

    def _parts(self) -> tuple[Tensor, Tensor]:
        """`[B]` parts in all, and how many of them the event under way touches."""
        agents = torch.arange(MAX_AGENTS, device=self.part.device)
        roots = (self.part == agents) & (agents < self.known[:, None])
        # those introduced in this very event are parts of their own until it ends
        return roots.sum(1), (roots & self._touched()).sum(1)

    def _turns_mask(self, need: Tensor) -> Tensor:
        """bool `[B, 100]`: how many turns the event under way may have."""
        size = self.inside.sum(1)
        turns = torch.arange(1, MAX_NODES + 1, device=size.device)
        rest = self.nodes[:, None] - size[:, None] * turns
        events = (self.events - 1)[:, None]
        one = _one_event_table().to(size.device)[rest.clamp(min=0), need[:, None], self.n_agents[:, None]]
        alive = torch.where(events == 1, one, rest >= events - 1 + need[:, None])
        alive = torch.where(events == 0, (rest == 0) & (need == 1)[:, None], alive)
        return alive & (rest >= 0) & (size > 0)[:, None] & (events >= 0)

    def _agent_mask(self, need: Tensor) -> Tensor:
        """bool `[B, 15]`: which agent may be named next."""
        agents = torch.arange(MAX_AGENTS, device=need.device)
        is_new = agents == self.known[:, None]
        untouched = (self.part == agents) & (agents < self.known[:, None]) & ~self._touched()  # (B, root)
        joins = is_new | untouched.gather(1, self.part)
        possible = (agents > self.last[:, None]) & (agents < self.known[:, None] + 1)
        possible &= ~is_new | (self.known < self.n_agents)[:, None]
        # after naming j: what else could still be named in this event, and how much of it would join something
        unborn = (self.n_agents - self.known)[:, None] - is_new.long()
        later = (self.known[:, None] - 1 - agents).clamp(min=0) + unborn
        greatest = self._greatest()
        own = (self.part[:, :, None] == agents) & ~is_new[:, :, None]  # (B, j, root): j's own part
        others = (untouched[:, None, :] & (greatest[:, None, :] > agents[:, None]) & ~own).sum(-1)
        more = torch.arange(MAX_AGENTS + 1, device=need.device)  # (x,) further members
        size = self.inside.sum(1)[:, None, None] + 1 + more
        still = (need[:, None] - joins.long())[:, :, None] - torch.minimum(more, (others + unborn)[:, :, None])
        alive = self._can_end(size, still) & (more <= later[:, :, None])
        return possible & alive.any(-1) & ~self.finished[:, None]

    def _can_end(self, size: Tensor, need: Tensor) -> Tensor:
        """bool: an event of `size` agents that leaves `need` may end here after some number of turns."""
        nodes, events = self.nodes[:, None, None], (self.events - 1)[:, None, None]
        bounded, fits = need.clamp(0, MAX_AGENTS + 1), size <= MAX_AGENTS
        inside = size.clamp(max=MAX_AGENTS)
        two = _two_event_table().to(size.device)[nodes, inside, bounded, self.n_agents[:, None, None]]
        alive = torch.where(events == 1, two, nodes - size >= events - 1 + need)
        alive = torch.where(events == 0, (nodes % size == 0) & (nodes >= size) & (need == 1), alive)
        return alive & fits

    def _greatest(self) -> Tensor:
        """`[B, A]` for each part, by its least agent, its greatest known agent; -1 where there is no such part."""
        agents = torch.arange(MAX_AGENTS, device=self.part.device).expand_as(self.part)
        known = torch.where(agents < self.known[:, None], agents, -1)
        return torch.full_like(self.part, -1).scatter_reduce(1, self.part, known, "amax")
