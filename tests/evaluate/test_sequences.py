from __future__ import annotations

import math

import numpy as np
import pytest

from genc.evaluate.sequences import (
    ActionSequence,
    Interval,
    action_sequences,
    chains,
    entropy_interval,
    normalised_entropy,
    rarefied_entropy,
)
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.graph.weave import unfold
from genc.words.vocabulary import ACTION_INDEX

A, B, C, D = (4,), (4, 2), (2, 4), (1,)


def drawn(n: int, rng: np.random.Generator, n_kinds: int = 400) -> list[ActionSequence]:
    """Kinds of sequence by a law of Zipf: some often, most once or never."""
    shares = 1 / np.arange(1, n_kinds + 1)
    return [(int(i),) for i in rng.choice(n_kinds, n, p=shares / shares.sum())]


def in_clusters(n_clusters: int, rng: np.random.Generator) -> tuple[list[ActionSequence], list[str]]:
    """Clusters of 4 to 12 sequences, in half of which everybody does the same few things."""
    sizes = rng.integers(4, 13, n_clusters)
    narrow = rng.random(n_clusters) < 0.5
    sequences = [s for n, few in zip(sizes, narrow, strict=True) for s in drawn(n, rng, 3 if few else 400)]
    return sequences, [f"scenario {i}" for i, n in enumerate(sizes) for _ in range(n)]


def test_chains_of_authored_groups_are_their_agents(groups: list[CrowdGraph]) -> None:
    for group in groups:
        found = {tuple(nodes.tolist()) for nodes in chains(group)}
        assert found == {tuple(np.flatnonzero(group.agent == a).tolist()) for a in range(group.n_agents)}


def test_sequences_of_authored_groups_are_those_of_their_records(groups: list[CrowdGraph]) -> None:
    for group in groups[::10]:
        records = [tuple(ACTION_INDEX[step.action] for step in record.steps) for record in unfold(group)]
        assert sorted(action_sequences([group])) == sorted(records)


def test_agents_come_in_order_of_their_first_node_and_nodes_ascend() -> None:
    # sequence edges 0-3, 3-1, share edges 1-2, 2-4: agents {0, 1, 3}, {2}, {4}
    adjacency = np.zeros((5, 5), dtype=np.int8)
    for i, j, sign in ((0, 3, 1), (3, 1, 1), (1, 2, -1), (2, 4, -1)):
        adjacency[i, j] = adjacency[j, i] = sign
    graph = SignedGraph(adjacency, np.array([9, 8, 7, 6, 5]), np.zeros(5, dtype=np.int64))
    assert [nodes.tolist() for nodes in chains(graph)] == [[0, 1, 3], [2], [4]]
    assert action_sequences([graph, graph]) == [(9, 8, 6), (7,), (5,)] * 2


def test_entropy_by_hand() -> None:
    quarter = 0.25 * math.log(4) * 2 + 0.5 * math.log(2)  # shares 1/4, 1/4, 1/2
    assert normalised_entropy([A, B, C, C]) == pytest.approx(quarter / math.log(3))
    assert normalised_entropy([A, B, C, D]) == pytest.approx(1)
    assert normalised_entropy([A, A, A]) == normalised_entropy([A]) == 0


def test_order_of_actions_tells_sequences_apart() -> None:
    assert normalised_entropy([B, C]) == pytest.approx(1)
    assert normalised_entropy([B, B]) == 0


def test_rarefied_entropy_by_hand() -> None:
    # two of A, A, B: once A A (H = 0, 1 kind), twice A B (H = log 2, 2 kinds)
    assert rarefied_entropy([A, A, B], 2) == pytest.approx(2 / 3 * math.log(2) / math.log(5 / 3))
    assert rarefied_entropy([A, A, B], 1) == rarefied_entropy([A, A, A], 2) == 0


def test_rarefied_entropy_does_not_depend_on_how_large_the_whole_is() -> None:
    small = np.mean([rarefied_entropy(drawn(150, np.random.default_rng(i)), 60) for i in range(60)])
    large = np.mean([rarefied_entropy(drawn(3000, np.random.default_rng(i)), 60) for i in range(10)])
    plain = [np.mean([normalised_entropy(drawn(n, np.random.default_rng(i))) for i in range(10)]) for n in (150, 3000)]
    assert small == pytest.approx(large, abs=0.002)
    assert plain[0] - plain[1] > 0.02


@pytest.mark.parametrize("size", [0, 4])
def test_nothing_can_be_drawn_that_is_not_there(size: int) -> None:
    with pytest.raises(ValueError, match=f"cannot draw {size} of 3"):
        rarefied_entropy([A, B, C], size)


def test_the_interval_covers_the_truth_as_often_as_it_says() -> None:
    truth = rarefied_entropy(drawn(100_000, np.random.default_rng(0)), 50)
    found = []
    for i in range(120):
        rng = np.random.default_rng([1, i])
        found.append(entropy_interval(drawn(200, rng), 50, rng, n_resamples=60, level=0.8))
    assert np.mean([f.low <= truth <= f.high for f in found]) == pytest.approx(0.8, abs=0.1)
    assert np.mean([f.mean for f in found]) == pytest.approx(truth, abs=0.002)
    widths, spread = [f.high - f.low for f in found], np.std([f.mean for f in found])
    assert np.mean(widths) == pytest.approx(2 * 1.2816 * spread, rel=0.15)


def test_the_interval_of_clusters_is_as_wide_as_clusters_vary() -> None:
    found, apart = [], []
    for i in range(120):
        rng = np.random.default_rng([2, i])
        sequences, clusters = in_clusters(12, rng)
        found.append(entropy_interval(sequences, 25, rng, clusters, n_resamples=60, level=0.8))
        apart.append(entropy_interval(sequences, 25, rng, n_resamples=60, level=0.8))
    widths, too_narrow = (np.mean([f.high - f.low for f in some]) for some in (found, apart))
    spread = np.std([f.mean for f in found])
    assert widths == pytest.approx(2 * 1.2816 * spread, rel=0.2)
    assert too_narrow < 0.75 * widths


def test_a_bootstrap_with_replacement_would_miss_even_its_own_value(groups: list[CrowdGraph]) -> None:
    sequences = action_sequences(groups[:500])
    n, rng = len(sequences), np.random.default_rng(0)
    found = entropy_interval(sequences, n // 2, rng, n_resamples=100)
    again = [rarefied_entropy([sequences[i] for i in rng.integers(0, n, n)], n // 2) for _ in range(100)]
    assert found.low < found.mean < found.high
    assert max(again) < found.low


def test_the_interval_follows_its_seed_its_mean_does_not_and_a_higher_level_is_wider() -> None:
    sequences = drawn(200, np.random.default_rng(0))

    def interval(seed: int, level: float = 0.95) -> Interval:
        return entropy_interval(sequences, 50, np.random.default_rng(seed), n_resamples=50, level=level)

    assert interval(1) == interval(1)
    assert interval(1) != interval(2)
    assert interval(1).mean == interval(2).mean == rarefied_entropy(sequences, 50)
    assert interval(1, 0.5).low > interval(1).low
    assert interval(1, 0.5).high < interval(1).high


def test_an_interval_never_leaves_what_an_entropy_can_be() -> None:
    twins = [(i,) for i in (0, 0, 1, 1, *range(2, 58))]  # each two of the same in one cluster
    high = entropy_interval(twins, 30, np.random.default_rng(0), np.arange(60) // 2, level=0.98)
    assert 0 < high.low < high.mean < high.high == 1
    alike = [A] * 29 + [B]  # without which all are the same
    low = entropy_interval(alike, 10, np.random.default_rng(0), ["x"] * 14 + ["y"] * 15 + ["z"], level=0.8)
    assert 0 == low.low < low.mean < low.high < 1


def test_a_half_counts_by_the_share_that_it_holds() -> None:
    # of three clusters of ten, two make a half: it varies by half as much (in variance) as the whole does
    clusters = np.repeat(["x", "y", "z"], 10)
    sequences = [*((i,) for i in range(10)), *((i // 3,) for i in range(20, 30)), *((i // 5,) for i in range(60, 70))]
    found = entropy_interval(sequences, 10, np.random.default_rng(0), clusters, n_resamples=2000, level=0.9)
    halves = [rarefied_entropy([s for s, c in zip(sequences, clusters, strict=True) if c != out], 10) for out in "xyz"]
    assert found.low - found.mean == pytest.approx(math.sqrt(2) * (min(halves) - np.mean(halves)), rel=0.05)
    assert found.high - found.mean == pytest.approx(math.sqrt(2) * (max(halves) - np.mean(halves)), rel=0.05)


@pytest.mark.parametrize("size", [0, 3])
def test_a_half_must_hold_as_many_as_are_drawn(size: int) -> None:
    with pytest.raises(ValueError, match=f"size {size} of 5 .* 1 to 2"):
        entropy_interval([A, B, C, D, D], size, np.random.default_rng(0))


def test_one_cluster_cannot_be_halved() -> None:
    with pytest.raises(ValueError, match="one cluster holds 4 of 6"):
        entropy_interval([A, B, C, D, A, B], 2, np.random.default_rng(0), ["x", "x", "x", "x", "y", "z"])
    halves = entropy_interval([A, B, C, D, A, B], 2, np.random.default_rng(0), ["x", "x", "x", "y", "y", "y"])
    assert halves.low <= halves.mean <= halves.high


def test_authored_scenarios(groups: list[CrowdGraph]) -> None:
    sequences = action_sequences(groups)
    group = [i for i, g in enumerate(groups) for _ in range(g.n_agents)]
    found = entropy_interval(sequences, 200, np.random.default_rng(0), group, n_resamples=50)
    assert 0.99 < found.low < found.mean < found.high < 1
    assert found.mean > normalised_entropy(sequences)
