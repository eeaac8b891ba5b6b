"""From a real-valued adjacency, as a decoder of matrices gives it, to the nearest group.

Nearest is meant in squared error over pairs of nodes. A pair then adds a gain of its own, compared with no edge: with
entry x, 2x - 1 for a sequence edge and -2x - 1 for a share edge. Three steps:

1. `blocks`: the best cut of the row of nodes into events, exact for the edges within events and for the most that
   the links between events could add, each node taken by itself;
2. `chains`: the best links for that cut, exact;
3. `chains`: where these leave the group in parts, the cheapest exchanges of links that tie it together.

Where the links reach what the cut hoped for and need no exchange, no group is nearer; so the adjacency of a group comes
back as it is. Elsewhere a nearer one can exist, for the cut hopes that each first node gets the link it likes best. On
authored groups mixed and blurred, a search over prices of links (Lagrange multipliers, 30 cuts) found one in 1 of 7
cases, 0.1 nearer on average, at 15 times the cost; `tests/graph/test_repair.py` compares with all groups of up to 6
nodes.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from genc.graph.blocks import Cut, Floats, Gains, best_cut
from genc.graph.chains import best_links, parts, tied_links
from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES


@dataclass(frozen=True, eq=False)
class Repaired:
    """A group, and where its nodes stand in the matrix that it was made from.

    Attributes:
        agent, event: of each node of the group, in canonical order, agents numbered by first appearance `[n]`.
        node: the row of the matrix that each node of the group is `[n]`; rows change places only within an event.
        changes: pairs of nodes whose edge differs from the one that `threshold` reads.
    """

    agent: Ints
    event: Ints
    node: Ints
    changes: int

    @cached_property
    def adjacency(self) -> NDArray[np.int8]:
        """The signed adjacency of the group, in its own order, `[n, n]`."""
        return _unlabelled(self.agent, self.event).adjacency

    @property
    def n_edges(self) -> int:
        """Edges of the group."""
        return int(np.count_nonzero(self.adjacency)) // 2

    @property
    def change_rate(self) -> float:
        """Edges put in, taken out or turned into the other kind, for each edge of the group.

        0 means that nothing had to be repaired; above 1, more was changed than there is. A group of one node has no
        edge: its rate is 0.
        """
        return self.changes / max(self.n_edges, 1)

    def labelled(self, action: Ints, category: Ints) -> CrowdGraph:
        """The group with what is done where, given for each row of the matrix `[n]`.

        All agents of an event do the same in each turn: the label of the first of them counts.
        """
        moment = self.event * len(self.event) + _unlabelled(self.agent, self.event).turn
        _, first, inverse = np.unique(moment, return_index=True, return_inverse=True)
        source = self.node[first[inverse]]
        return CrowdGraph(self.agent, self.event, action[source], category[source])


def threshold(adjacency: NDArray[np.floating]) -> NDArray[np.int8]:
    """The signed graph nearest to a matrix with no regard to validity: an edge where |entry| >= 0.5, `[n, n]`."""
    signed: NDArray[np.int8] = (np.sign(adjacency) * (np.abs(adjacency) >= 0.5)).astype(np.int8)
    return signed


def repair(adjacency: NDArray[np.floating], n_agents: int | None = None, n_events: int | None = None) -> Repaired:
    """The group nearest to a matrix, with exactly as many agents and events as asked for.

    Args:
        adjacency: `[n, n]`, symmetric, in [-1, 1], nodes in canonical order: near 1 for a sequence edge, near -1 for
            a share edge (Gen-C, VGAE Decoders, U + U^T).
        n_agents, n_events: None leaves them open: as many as come nearest.

    Raises:
        ValueError: if no group has these counts.

    The paper does not say how a decoded matrix becomes a graph.
    """
    n_nodes = len(adjacency)
    asked = [(n_nodes, MAX_NODES), (n_agents, MAX_AGENTS), (n_events, MAX_EVENTS)]
    found = None
    if all(count is None or 1 <= count <= most for count, most in asked):
        found = _nearest(_gains(np.asarray(adjacency, dtype=np.float64)), n_agents, n_events)
    if found is None:
        agents, events = ("any number of" if count is None else count for count in (n_agents, n_events))
        raise ValueError(
            f"no group has {n_nodes} nodes, {agents} agents and {events} events: ask for counts that a Brief takes"
        )
    return _repaired(adjacency, found)


@dataclass(frozen=True, eq=False)
class _Woven:
    """A cut and, for each of its runs, the next run of the same agent or -1; what both gain over no edges."""

    cut: Cut
    after: Ints
    gain: float

    @property
    def is_group(self) -> bool:
        n_chains = np.count_nonzero(self.after < 0)
        return bool(n_chains <= MAX_AGENTS and not parts(self.after, self.cut.event).any())


def _gains(adjacency: Floats) -> Gains:
    sequence = 2 * adjacency - 1
    earlier = np.triu(np.ones(adjacency.shape, dtype=bool), 1)
    return Gains(sequence, -2 * adjacency - 1, np.where(earlier, sequence, 0).max(0, initial=0))


def _nearest(gains: Gains, n_agents: int | None, n_events: int | None) -> _Woven | None:
    found = _woven(gains, n_agents, n_events)
    if n_agents is not None or found is None or found.is_group:
        return found
    # nothing makes links that cost something worth their while here; an exact number of agents does
    every = (_woven(gains, n, n_events) for n in range(1, min(MAX_AGENTS, len(gains.link)) + 1))
    return max((woven for woven in every if woven is not None), key=lambda woven: woven.gain)


def _woven(gains: Gains, n_agents: int | None, n_events: int | None) -> _Woven | None:
    """A group if the agents are counted; if they are open, it may be in parts or of too many agents."""
    cut = best_cut(gains, n_agents, n_events)
    if cut is None:
        return None
    event = cut.event
    gain = np.where(event[:, None] < event, gains.sequence[np.ix_(cut.last, cut.first)], -np.inf)
    after = best_links(gain) if n_agents is None else tied_links(gain, event, len(event) - n_agents)
    run = np.flatnonzero(after >= 0)
    hoped, linked = gains.link[cut.first].sum(), gain[run, after[run]].sum()
    return _Woven(cut, after, float(cut.gain - hoped + linked))


def _repaired(adjacency: NDArray[np.floating], woven: _Woven) -> Repaired:
    chain = np.full(len(woven.after), -1)
    for run, following in enumerate(woven.after):
        if chain[run] < 0:
            chain[run] = chain.max() + 1
        if following >= 0:
            chain[following] = chain[run]
    agent, event = np.repeat(chain, woven.cut.turns), np.repeat(woven.cut.event, woven.cut.turns)
    node = np.lexsort((np.arange(len(agent)), agent, event))
    agent, event = agent[node], event[node]
    differs = threshold(adjacency)[np.ix_(node, node)] != _unlabelled(agent, event).adjacency
    return Repaired(agent, event, node, int(np.count_nonzero(np.triu(differs, 1))))


def _unlabelled(agent: Ints, event: Ints) -> CrowdGraph:
    """The group with one label everywhere: its edges do not depend on labels."""
    nothing = np.zeros_like(agent)
    return CrowdGraph(agent, event, nothing, nothing)
