"""`CrowdGraph`: the time-expanded graph of the paper (Gen-C, Graph-Based Representation)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from genc.words.vocabulary import ACTIONS, CATEGORIES

Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class CrowdGraph:
    """Nodes in canonical order (event, agent, sequence index); the edges follow from the nodes.

    A node is one agent doing one thing. All agents of an event do the same things in the same turns, so a
    share edge joins two nodes of one event and one turn, and a sequence edge joins two consecutive nodes of
    one agent. Agents are numbered 0..A-1 and events 0..E-1, each number in use.

    Attributes:
        agent, event, action, category: integers `[n]`; action and category are vocabulary indices.

    Raises:
        ValueError: when built from arrays that are no crowd scenario graph.
    """

    agent: Ints
    event: Ints
    action: Ints
    category: Ints

    def __post_init__(self) -> None:
        for name in ("agent", "event", "action", "category"):
            values = np.array(getattr(self, name), dtype=np.int64)  # its own: the caller may change theirs
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        fault = self._fault()
        if fault:
            raise ValueError(f"not a crowd scenario graph: {fault}")

    def _fault(self) -> str | None:
        n = len(self.agent)
        if n == 0 or any(a.shape != (n,) for a in (self.agent, self.event, self.action, self.category)):
            return "all four arrays must have one length, at least 1"
        if not (_covers(self.agent) and _covers(self.event)):
            return "agents and events must be numbered from 0 without gaps"
        if not (_within(self.action, len(ACTIONS)) and _within(self.category, len(CATEGORIES))):
            return "an action or category index is out of range"
        key = self.event * (self.agent.max() + 1) + self.agent
        if np.any(np.diff(key) < 0):
            return "nodes are not in canonical order"
        starts = np.flatnonzero(np.r_[True, np.diff(key) > 0])  # of what each agent does in each event
        lengths = np.diff(np.r_[starts, n])
        joins = np.r_[False, np.diff(self.event[starts]) == 0]  # an agent of the same event comes before
        if np.any(joins[1:] & (np.diff(lengths) != 0)):
            return "the agents of an event must all do the same number of things"
        node = np.flatnonzero(np.repeat(joins, lengths))
        before = node - np.repeat(lengths, lengths)[node]  # the same turn of that agent
        if any(np.any(did[node] != did[before]) for did in (self.action, self.category)):
            return "the agents of an event must do the same thing in each turn"
        return None

    @property
    def n_nodes(self) -> int:
        """Nodes."""
        return len(self.agent)

    @cached_property
    def n_agents(self) -> int:
        """Agents."""
        return int(self.agent.max()) + 1

    @cached_property
    def n_events(self) -> int:
        """Events."""
        return int(self.event.max()) + 1

    @cached_property
    def step(self) -> Ints:
        """The sequence index of each node within its agent's chain, `[n]`."""
        return _running_count(self.agent)

    @cached_property
    def turn(self) -> Ints:
        """The place of each node within its event: share edges join equal turns, `[n]`."""
        return _running_count(self.event * (self.agent.max() + 1) + self.agent)

    @cached_property
    def adjacency(self) -> NDArray[np.int8]:
        """The signed adjacency of the paper, `[n, n]`: 0 no edge, +1 sequence, -1 share; symmetric."""
        same_agent = self.agent[:, None] == self.agent[None, :]
        adjacent = np.abs(self.step[:, None] - self.step[None, :]) == 1
        moment = self.event * self.n_nodes + self.turn
        together = (moment[:, None] == moment[None, :]) & ~same_agent
        signed: NDArray[np.int8] = (same_agent & adjacent).astype(np.int8) - together.astype(np.int8)
        return signed

    @cached_property
    def part(self) -> Ints:
        """The connected part (the group) of each node, `[n]`, numbered by first node."""
        ones = np.ones(self.n_nodes, dtype=np.int8)
        bipartite = coo_array(
            (ones, (self.event, self.n_events + self.agent)), shape=(self.n_events + self.n_agents,) * 2
        )
        _, label = connected_components(bipartite, directed=False)
        return _by_first_appearance(label[self.event])

    def groups(self) -> list[CrowdGraph]:
        """Its connected parts H_k, each renumbered from 0 in its own order."""
        return [self._take(self.part == k) for k in range(int(self.part.max()) + 1)]

    def _take(self, mask: NDArray[np.bool_]) -> CrowdGraph:
        agent = np.unique(self.agent[mask], return_inverse=True)[1]
        event = np.unique(self.event[mask], return_inverse=True)[1]
        return CrowdGraph(agent, event, self.action[mask], self.category[mask])

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CrowdGraph):
            return NotImplemented
        return all(
            np.array_equal(getattr(self, name), getattr(other, name))
            for name in ("agent", "event", "action", "category")
        )

    def __hash__(self) -> int:
        return hash((self.agent.tobytes(), self.event.tobytes(), self.action.tobytes(), self.category.tobytes()))

    def __repr__(self) -> str:
        return f"CrowdGraph({self.n_nodes} nodes, {self.n_agents} agents, {self.n_events} events)"


def _covers(values: Ints) -> bool:
    return bool(values.min() == 0 and np.bincount(values).all())


def _within(values: Ints, size: int) -> bool:
    return bool(values.min() >= 0 and values.max() < size)


def _running_count(key: Ints) -> Ints:
    """For each entry, how many entries before it have the same key."""
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    starts = np.flatnonzero(np.r_[True, ordered[1:] != ordered[:-1]])
    lengths = np.diff(np.r_[starts, len(key)])
    counts = np.empty(len(key), dtype=np.int64)
    counts[order] = np.arange(len(key)) - np.repeat(starts, lengths)
    return counts


def _by_first_appearance(label: Ints) -> Ints:
    _, first, inverse = np.unique(label, return_index=True, return_inverse=True)
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return rank[inverse]
