"""Which runs of the events make up one agent: an exact matching, and exchanges that tie the events together.

A run is what one agent does in one event. A link joins the last node of a run to the first node of a run in a later
event; runs that links join are one agent's chain. R runs in C chains have R - C links, and the group is connected
exactly if its events are, each link counting as an edge between two of them.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.sparse.csgraph import connected_components

from genc.graph.blocks import Floats
from genc.graph.crowd_graph import Ints


def best_links(gain: Floats) -> Ints:
    """The next run of the same agent for each run, or -1, `[r]`: all links that gain, the most in all.

    Args:
        gain: `[r, r]` of a link from a run to a run of a later event; -inf elsewhere.
    """
    run, following = linear_sum_assignment(np.maximum(gain, 0), maximize=True)
    return np.where(gain[run, following] > 0, following, -1)


def tied_links(gain: Floats, event: Ints, n_links: int) -> Ints:
    """The same with just so many links, whether they gain or not, exchanged until they tie all events together.

    The best links come from a matching. While they leave the events in parts, that exchange of links which loses
    least and makes one part of two follows; of several exchanges, each is the best one, not always all of them.

    Args:
        gain: as in `best_links`.
        event: of each run `[r]`.
        n_links: at least e - 1, and as many as are possible.

    An exchange drops a link i -> j that its part X can spare (it has one: with e - 1 links or more, the events of
    some part are on a cycle) and ties X to another part Y. One always exists: let i be in event a and j in event
    b > a. If Y has a chain that starts after a, link i to it; if Y has a chain that ends before b, link it to j. Else
    every chain of Y begins before a and ends after b: the link k -> l of one of them that passes over a can be
    crossed with i -> j to i -> l and k -> j.
    """
    after = _matched(gain, n_links)
    while (part := parts(after, event)).any():
        exchanges = (change(after, part, gain, run) for run in _spare(after, event) for change in (_moved, _crossed))
        _, after = max(exchanges, key=lambda exchange: exchange[0])
    return after


def _matched(gain: Floats, n_links: int) -> Ints:
    n_runs = len(gain)
    n_chains = n_runs - n_links
    padded = np.full((n_runs + n_chains,) * 2, -np.inf)
    padded[:n_runs, :n_runs] = gain
    padded[:n_runs, n_runs:] = padded[n_runs:, :n_runs] = 0  # the ends and the starts of the chains
    _, following = linear_sum_assignment(padded, maximize=True)
    return np.where(following < n_runs, following, -1)[:n_runs]


def parts(after: Ints, event: Ints) -> Ints:
    """The connected part of each run's event, `[r]`."""
    label: Ints = connected_components(_ties(after, event), directed=False)[1]
    return label[event]


def _ties(after: Ints, event: Ints) -> Floats:
    """How many links join two events, `[e, e]`, symmetric."""
    linked = after >= 0
    ties = np.zeros((event.max() + 1,) * 2)
    np.add.at(ties, (event[linked], event[after[linked]]), 1)
    return ties + ties.T


def _spare(after: Ints, event: Ints) -> Ints:
    """The runs whose link leaves no part broken if it is dropped.

    Were each link a resistor of one ohm, a link that alone ties its ends would have one ohm between them; on a cycle
    of c links there is at most (c - 1) / c.
    """
    ties = _ties(after, event)
    inverse = np.linalg.pinv(np.diag(ties.sum(0)) - ties, hermitian=True)
    run = np.flatnonzero(after >= 0)
    a, b = event[run], event[after[run]]
    ohm = inverse[a, a] + inverse[b, b] - 2 * inverse[a, b]
    spare: Ints = run[ohm < 1 - 0.5 / len(ties)]
    return spare


def _moved(after: Ints, part: Ints, gain: Floats, dropped: int) -> tuple[float, Ints]:
    """What it gains to put the best new link between two parts in the place of this one, and the links after that."""
    changed = after.copy()
    changed[dropped] = -1
    is_start = np.ones(len(after), dtype=bool)
    is_start[changed[changed >= 0]] = False
    possible = (changed < 0)[:, None] & is_start & (part[:, None] != part)
    total = np.where(possible, gain, -np.inf)
    run, following = np.unravel_index(total.argmax(), total.shape)
    changed[run] = following
    return float(total[run, following] - gain[dropped, after[dropped]]), changed


def _crossed(after: Ints, part: Ints, gain: Floats, dropped: int) -> tuple[float, Ints]:
    """What it gains to cross this link with the best one of another part, and the links after that."""
    others = np.flatnonzero((after >= 0) & (part != part[dropped]))
    if len(others) == 0:
        return -np.inf, after
    total = gain[dropped, after[others]] + gain[others, after[dropped]] - gain[others, after[others]]
    best = others[total.argmax()]
    changed = after.copy()
    changed[[dropped, best]] = after[[best, dropped]]
    return float(total.max() - gain[dropped, after[dropped]]), changed
