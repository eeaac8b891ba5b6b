"""The best cut of a row of nodes into events: an exact dynamic programme over blocks.

In canonical order an event of m agents and t turns is a block of m * t consecutive nodes, agent after agent: m runs
of t nodes. Sequence edges join neighbours within a run, share edges join equal places of different runs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.graph.crowd_graph import Ints
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Gains:
    """What each edge or run takes off the squared error, compared with no edge.

    Attributes:
        sequence, share: `[n, n]` for an edge between two nodes, the lower index first.
        link: `[n]` hoped-for gain of the sequence edge that leads into a node from an earlier event.
    """

    sequence: Floats
    share: Floats
    link: Floats


@dataclass(frozen=True, eq=False)
class Cut:
    """A row of nodes as blocks, one for each event, and these as runs, one for each agent who takes part.

    Attributes:
        event: of each run, ascending `[r]`.
        turns: nodes of each run `[r]`; equal within an event.
        gain: of the edges within events, and what is hoped for from links to the first nodes of the runs.
    """

    event: Ints
    turns: Ints
    gain: float

    @property
    def first(self) -> Ints:
        """The first node of each run `[r]`."""
        return self.last - self.turns + 1

    @property
    def last(self) -> Ints:
        """The last node of each run `[r]`."""
        last: Ints = np.cumsum(self.turns) - 1
        return last


def best_cut(gains: Gains, n_agents: int | None, n_events: int | None) -> Cut | None:
    """The cut of greatest gain from which a group of these counts can be made, or None where there is none.

    A cut into blocks of m_e agents can be linked into one connected group of A agents exactly if every m_e <= A and
    the surplus sum(m_e - 1) is at least A - 1. Necessary: each event that joins the others brings at most m_e - 1 new
    agents. Sufficient: let each later event take one known agent, as many new ones as are left, and known ones for
    the rest. (One event: both together say m = A.) Where the agents are free, A = max(m_e) always fits.
    """
    n_nodes, most = len(gains.link), min(n_agents or MAX_AGENTS, MAX_AGENTS)
    value = _block_gains(gains, min(most, n_nodes))
    n_members, n_turns = _shapes(n_nodes, most)
    length = n_members * n_turns
    needs = np.arange(n_agents or 1)
    before = np.maximum(needs - (n_members[:, None] - 1), 0)
    # best[p, r, e]: greatest gain of the first p nodes as e events with a surplus of at least r
    best = np.full((n_nodes + 1, len(needs), (n_events or min(MAX_EVENTS, n_nodes)) + 1), -np.inf)
    chosen = np.zeros(best.shape, dtype=np.int64)
    best[0, 0, 0] = 0
    for end in range(1, n_nodes + 1):
        n_fit = np.searchsorted(length, end, side="right")
        start = end - length[:n_fit]
        total = best[start[:, None], before[:n_fit], :-1]
        total += value[n_members[:n_fit], n_turns[:n_fit], start][:, None, None]
        chosen[end, :, 1:] = total.argmax(0)
        best[end, :, 1:] = total.max(0)
    events = n_events or int(best[n_nodes, -1].argmax())
    if best[n_nodes, -1, events] == -np.inf:
        return None
    picks = _picks(chosen[:, :, : events + 1], length, before)
    sizes = n_members[picks]
    return Cut(np.repeat(np.arange(events), sizes), np.repeat(n_turns[picks], sizes), float(best[n_nodes, -1, events]))


def _picks(chosen: Ints, length: Ints, before: Ints) -> list[int]:
    """The shapes of the blocks of the best cut, in order."""
    end, need, events = (n - 1 for n in chosen.shape)
    picks: list[int] = []
    for left in range(events, 0, -1):
        picks.append(int(chosen[end, need, left]))
        end, need = end - int(length[picks[-1]]), int(before[picks[-1], need])
    return picks[::-1]


def _shapes(n_nodes: int, most: int) -> tuple[Ints, Ints]:
    """All (members, turns) of at most so many nodes and members, by number of nodes."""
    members, turns = np.indices((min(most, n_nodes) + 1, n_nodes + 1))
    fits = (members * turns > 0) & (members * turns <= n_nodes)
    members, turns = members[fits], turns[fits]
    order = np.argsort(members * turns, kind="stable")
    return members[order], turns[order]


def _block_gains(gains: Gains, most: int) -> Floats:
    """`[m, t, start]`: what a block of m agents and t turns gains; meaningless where it does not fit."""
    n_nodes = len(gains.link)
    turns, start = np.arange(n_nodes + 1)[:, None], np.arange(n_nodes + 1)
    after = np.minimum(start + turns, n_nodes)
    along = np.r_[0, np.cumsum(np.diagonal(gains.sequence, 1)), 0][: n_nodes + 1]
    value = np.zeros((most + 1, n_nodes + 1, n_nodes + 1))
    value[1] = along[np.maximum(after - 1, 0)] - along[np.minimum(start, n_nodes - 1)] + np.r_[gains.link, 0]
    apart = _shares_apart(gains.share)
    for m in range(2, most + 1):
        # all pairs of runs but the first with the last: those of two shorter blocks, less what both have
        gap = np.minimum((m - 1) * turns, n_nodes)
        pair = apart[gap, after] - apart[gap, start]
        value[m] = value[m - 1] + np.take_along_axis(value[m - 1] - value[m - 2], after, 1) + pair
    return value


def _shares_apart(share: Floats) -> Floats:
    """`[gap, i]`: the sum of share[j, j + gap] over j < i."""
    n_nodes = len(share)
    gap, first = np.indices((n_nodes + 1, n_nodes))
    second = gap + first
    inside = second < n_nodes
    entries = np.where(inside, share[first, np.where(inside, second, 0)], 0)
    return np.pad(np.cumsum(entries, axis=1), ((0, 0), (1, 0)))
