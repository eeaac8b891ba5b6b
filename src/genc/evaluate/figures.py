"""How near generated groups are to authored ones: every figure that compares crowds, beside its floor."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from genc.evaluate.comparison import NAMES, compare, floor
from genc.evaluate.crowd import FRECHET, MMD, PARTICIPATION, Crowd, Floats, Gauge, Lineup
from genc.evaluate.evaluation import CHARACTER, DISTANCE, Figure
from genc.evaluate.sequences import ActionSequence, Interval, entropy_interval
from genc.evaluate.two_sample import classifier_two_sample
from genc.graph.crowd_graph import Ints

N_FLOOR_DIVERGENCES = 1000
"""Half a millisecond each. The mean of a few is noisy: in one draw two or three large groups rule the degree."""
N_FLOOR_READINGS = 100
N_FEW = 5
"""Draws that a classifier is trained on and whose sequences are compared: slow, and alike from draw to draw."""
N_HALVES = 200
"""Behind the interval of a sequence entropy."""

ENTROPY, TWO_SAMPLE = "sequence entropy", "two-sample accuracy"


def _divergences(lineup: Lineup, rng: np.random.Generator) -> Iterator[Figure]:
    """The nine, and their sum."""
    test = lineup.test
    nats = {of: compare(test.profile, [draw.profile for draw in draws]).nats for of, draws in lineup.draws.items()}
    nats["floor"] = floor(lineup.train.profile, test.profile, N_FLOOR_DIVERGENCES, rng).nats
    for i, name in enumerate(NAMES):
        yield Figure(DISTANCE, name, "nats", "low", **{of: interval(rows[:, i]) for of, rows in nats.items()})
    yield Figure(DISTANCE, "total", "nats", "low", **{of: interval(rows.sum(1)) for of, rows in nats.items()})


def _readings(lineup: Lineup, rng: np.random.Generator) -> Iterator[Figure]:
    gauge = Gauge(lineup.train, lineup.test)
    told = {**lineup.draws, "floor": lineup.of_training(N_FLOOR_READINGS, rng)}
    found = {of: [gauge.readings(draw) for draw in draws] for of, draws in told.items()}
    columns = {
        name: {of: interval([reading[name] for reading in readings]) for of, readings in found.items()}
        for name in (FRECHET, MMD, PARTICIPATION)
    }
    yield Figure(DISTANCE, FRECHET, "sd²", "low", **columns[FRECHET])
    yield Figure(DISTANCE, MMD, "", "low", **columns[MMD])
    columns[PARTICIPATION]["authored"] = interval([gauge.readings(lineup.test)[PARTICIPATION]])
    shares = {of: percent(value) for of, value in columns[PARTICIPATION].items()}
    yield Figure(CHARACTER, PARTICIPATION, "%", "as authored", **shares)


def _entropy(lineup: Lineup, rng: np.random.Generator) -> Iterator[Figure]:
    """At one size for all: half of what the smallest has."""
    few = np.arange(N_FEW * len(lineup.test))
    told = {"authored": lineup.test, "floor": lineup.train}
    told |= {of: crowd[few[: len(crowd)]] for of, crowd in lineup.made.items()}
    rows = {of: _sequences(crowd) for of, crowd in told.items()}
    size = min(len(sequences) for sequences, _ in rows.values()) // 2
    columns = {
        of: entropy_interval(sequences, size, rng, cluster, N_HALVES) for of, (sequences, cluster) in rows.items()
    }
    yield Figure(CHARACTER, ENTROPY, "", "as authored", **columns)


def _sequences(crowd: Crowd) -> tuple[list[ActionSequence], Ints]:
    """The action sequences of all agents, and for each the cluster of its group.

    Where one scenario holds more than half of them, groups are the clusters, else agents: an interval needs halves.
    """
    n_agents = np.array(crowd.n_agents)
    clusters = (np.repeat(label, n_agents) for label in (crowd.cluster, np.arange(len(crowd))))
    alone = np.arange(n_agents.sum())
    halved = (cluster for cluster in clusters if 2 * np.bincount(cluster).max() <= len(alone))
    return [s for sequences in crowd.sequences for s in sequences], next(halved, alone)


def _two_sample(lineup: Lineup, rng: np.random.Generator) -> Iterator[Figure]:
    told = {"floor": lineup.of_training(N_FEW, rng), **lineup.draws}
    accuracy = {
        of: interval([_accuracy(lineup.test, draw, rng) for draw in draws[:N_FEW]]) for of, draws in told.items()
    }
    yield Figure(CHARACTER, TWO_SAMPLE, "%", "50 %", **{of: percent(value) for of, value in accuracy.items()})


def _accuracy(test: Crowd, draw: Crowd, rng: np.random.Generator) -> float:
    return classifier_two_sample(test.descriptors, draw.descriptors, rng, (test.cluster, draw.cluster)).accuracy


def interval(values: Sequence[float] | Floats) -> Interval:
    """The mean of draws, and where 95 % of them lie."""
    low, high = np.quantile(values, (0.025, 0.975))
    return Interval(float(np.mean(values)), float(low), float(high))


def percent(share: Interval) -> Interval:
    """The same in percent."""
    return Interval(100 * share.mean, 100 * share.low, 100 * share.high)


MEASURED: tuple[Callable[[Lineup, np.random.Generator], Iterator[Figure]], ...] = (
    _divergences,
    _readings,
    _entropy,
    _two_sample,
)
"""Each takes chance of its own, so that none hangs on what the others draw."""
