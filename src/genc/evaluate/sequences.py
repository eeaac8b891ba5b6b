"""What each agent does one after the other, and how various these action sequences are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse.csgraph import connected_components
from scipy.stats import hypergeom

from genc.graph.crowd_graph import Ints
from genc.graph.signed_graph import Labelled

ActionSequence = tuple[int, ...]
"""The actions of one agent in order, as vocabulary indices."""


@dataclass(frozen=True)
class Interval:
    """A mean, and the ends of a confidence interval around it."""

    mean: float
    low: float
    high: float


def chains(graph: Labelled) -> list[Ints]:
    """The nodes of each agent, ascending; agents in order of their first node.

    An agent is what sequence edges hold together: a chain in a crowd scenario graph, any shape in other graphs.
    """
    _, agent = connected_components(graph.adjacency > 0, directed=False)
    nodes = np.argsort(agent, kind="stable")
    parts = np.split(nodes, np.flatnonzero(np.diff(agent[nodes])) + 1)
    return sorted(parts, key=lambda part: int(part[0]))


def action_sequences(groups: Sequence[Labelled]) -> list[ActionSequence]:
    """What each agent of these groups does in order, group by group, agents in order of their first node."""
    return [tuple(group.action[nodes].tolist()) for group in groups for nodes in chains(group)]


def normalised_entropy(sequences: Sequence[ActionSequence]) -> float:
    """H / log |S|: 0 if one sequence is all there is, 1 if all that occur are equally frequent; no units.

    H is the entropy of the shares of the |S| distinct sequences; where |S| is 1 the quotient is 0 / 0, and 0 is given
    back. Higher is more various, but only at equal sample size: a small sample of rare things looks as if all were
    equally frequent. `rarefied_entropy` and `entropy_interval` compare samples of different size. (Gen-C, Assessment
    of LLM-bootstrapped Data; H_seq of Rationale for a Dedicated Learned Generator.)
    """
    counts = np.bincount(_numbered(sequences))
    if len(counts) < 2:
        return 0.0
    shares = counts / counts.sum()
    return float(-(shares * np.log(shares)).sum() / np.log(len(counts)))


def rarefied_entropy(sequences: Sequence[ActionSequence], size: int) -> float:
    """The normalised entropy to be expected of `size` of these sequences, drawn without replacement.

    E[H] / log E[|S|], both expectations exact (Chao et al. 2014, Rarefaction and extrapolation with Hill numbers), so
    that nothing hangs on the luck of a draw. At `size == len(sequences)` it is `normalised_entropy`.

    Raises:
        ValueError: if there are fewer than `size` sequences, or `size` is less than 1.
    """
    if not 1 <= size <= len(sequences):
        raise ValueError(f"cannot draw {size} of {len(sequences)} sequences without replacement")
    return _rarefied(np.bincount(_numbered(sequences)), size)


def entropy_interval(
    sequences: Sequence[ActionSequence],
    size: int,
    rng: np.random.Generator,
    clusters: ArrayLike | None = None,
    n_resamples: int = 1000,
    level: float = 0.95,
) -> Interval:
    """The rarefied entropy at `size`, and how far it can be trusted; for two samples take one size for both.

    The interval comes of halves of the data, taken without replacement, and not of a bootstrap with replacement. Most
    sequences occur once, and a bootstrap sample repeats a third of them where a new sample would bring others: nearly
    all of its entropies lie below the value that they are to surround. A half repeats nothing, and halves vary about
    the whole as the whole varies about the truth: S^2 (1/b - 1/n) is S^2 / n at b = n/2. A half that holds the share f
    counts by sqrt(f / (1 - f)). (Shao and Wu 1989, A general theory for jackknife variance estimation; Wu 1990, On the
    asymptotic properties of the jackknife histogram.)

    Halves are of clusters, because agents who share events, or a scenario, are no independent observations. In a half,
    agents of one cluster meet more often, so that its entropies lie slightly lower; therefore it is their deviations
    from their own mean that are put around the value. Below some twenty clusters the interval is too narrow, as all
    such are.

    Args:
        sequences: of a whole corpus.
        size: at most half of them, as each half must hold so many: `min(len(a), len(b)) // 2` for corpora a and b.
        rng: draws the halves; the mean does not depend on it.
        clusters: for each sequence a label of what must not be parted, its scenario or its clip, `[n]`; None if each
            sequence stands alone.
        n_resamples: halves.
        level: of confidence.

    Raises:
        ValueError: if `size` is less than 1 or more than half, or if one cluster holds more than half.
    """
    n = len(sequences)
    if not 1 <= size <= n // 2:
        raise ValueError(f"size {size} of {n} sequences: halves must hold so many, so take 1 to {n // 2}")
    cluster = np.unique(np.arange(n) if clusters is None else clusters, return_inverse=True)[1]
    largest = np.bincount(cluster).max()
    if 2 * largest > n:
        raise ValueError(f"one cluster holds {largest} of {n} sequences: no other half can be set beside it")
    kind = _numbered(sequences)
    mean = _rarefied(np.bincount(kind), size)
    halves = [_half(cluster, rng) for _ in range(n_resamples)]
    values = np.array([_rarefied(np.bincount(kind[half]), size) for half in halves])
    share = np.array([half.mean() for half in halves])
    deviations = (values - values.mean()) * np.sqrt(share / (1 - share))
    low, high = np.clip(mean + np.quantile(deviations, [(1 - level) / 2, (1 + level) / 2]), 0, 1)
    return Interval(mean, float(low), float(high))


def _numbered(sequences: Sequence[ActionSequence]) -> Ints:
    """A number for each sequence, equal for equal ones."""
    number: dict[ActionSequence, int] = {}
    return np.array([number.setdefault(sequence, len(number)) for sequence in sequences], dtype=np.int64)


def _half(cluster: Ints, rng: np.random.Generator) -> NDArray[np.bool_]:
    """Which sequences are in a random half: whole clusters, as few as hold half of all."""
    sizes = np.bincount(cluster)
    order = rng.permutation(len(sizes))
    n_before = np.cumsum(sizes[order]) - sizes[order]
    taken = np.zeros(len(sizes), dtype=bool)
    taken[order] = 2 * n_before < len(cluster)
    return taken[cluster]


def _rarefied(counts: Ints, size: int) -> float:
    """E[H] / log E[|S|] of `size` things drawn without replacement from kinds of these counts."""
    count, n_kinds = np.unique(counts[counts > 0], return_counts=True)
    if size == 1 or n_kinds.sum() == 1:
        return 0.0
    drawn = np.arange(1, min(size, int(count[-1])) + 1)
    chance = hypergeom.pmf(drawn, counts.sum(), count[:, None], size)  # [count, drawn]
    entropy = n_kinds @ chance @ (drawn / size * np.log(size / drawn))
    return float(entropy / np.log(n_kinds @ chance.sum(1)))
