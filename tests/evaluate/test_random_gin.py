from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.evaluate.latent import mmd_squared
from genc.evaluate.random_gin import RandomGin, standardise
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.words.vocabulary import ACTIONS, CATEGORIES

GIN = RandomGin()


@st.composite
def drawn(draw: st.DrawFn) -> SignedGraph:
    """Any signed graph: a decoder of matrices may give every one of them."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n = draw(st.integers(1, 12))
    upper = np.triu(rng.choice([0, 0, 1, -1], (n, n)), 1).astype(np.int8)
    return SignedGraph(upper + upper.T, rng.integers(0, len(ACTIONS), n), rng.integers(0, len(CATEGORIES), n))


def graph(edges: dict[tuple[int, int], int], action: list[int], category: list[int] | None = None) -> SignedGraph:
    adjacency = np.zeros((len(action), len(action)), dtype=np.int8)
    for (i, j), sign in edges.items():
        adjacency[i, j] = adjacency[j, i] = sign
    return SignedGraph(adjacency, np.array(action), np.array(category or [0] * len(action)))


def chain(action: list[int]) -> SignedGraph:
    return graph({(i, i + 1): 1 for i in range(len(action) - 1)}, action)


def permuted(g: SignedGraph, order: np.ndarray) -> SignedGraph:
    return SignedGraph(g.adjacency[np.ix_(order, order)], g.action[order], g.category[order])


def differ(one: SignedGraph, other: SignedGraph) -> bool:
    a, b = GIN.features([one, other])
    return not np.allclose(a, b, rtol=1e-6)


@given(drawn(), st.integers(0, 2**32 - 1))
def test_the_order_of_nodes_has_no_influence(group: SignedGraph, seed: int) -> None:
    order = np.random.default_rng(seed).permutation(group.n_nodes)
    features = GIN.features([group, permuted(group, order)])
    assert features[0] == pytest.approx(features[1], rel=1e-9, abs=1e-9)


@given(st.lists(drawn(), min_size=1, max_size=6))
def test_groups_do_not_see_each_other(some: list[SignedGraph]) -> None:
    together = GIN.features(some)
    assert together.shape == (len(some), 3 * 35)
    for features, group in zip(together, some, strict=True):
        assert features == pytest.approx(GIN.features([group])[0], rel=1e-9, abs=1e-9)


@given(drawn())
def test_it_is_what_a_plain_loop_over_nodes_gives(group: SignedGraph) -> None:
    nodes = GIN._embedding[group.action] + GIN._embedding[len(ACTIONS) + group.category]
    sums = []
    for layer in GIN._layers:
        after = []
        for i in range(group.n_nodes):
            heard = nodes[i].copy()
            for j in np.flatnonzero(group.adjacency[i]):
                heard += np.maximum(nodes[j] + layer.edges[0 if group.adjacency[i, j] > 0 else 1], 0)
            after.append(np.maximum(np.maximum(heard @ layer.inner, 0) @ layer.outer, 0))
        nodes = np.array(after)
        sums.append(nodes.sum(0))
    assert GIN.features([group])[0] == pytest.approx(np.concatenate(sums), rel=1e-9, abs=1e-9)


def test_weights_are_orthonormal_and_of_the_seed() -> None:
    assert GIN._embedding.shape == (len(ACTIONS) + len(CATEGORIES), 35)
    for layer in GIN._layers:
        for weights in (layer.edges, layer.inner, layer.outer, GIN._embedding):
            assert weights @ weights.T == pytest.approx(np.eye(len(weights)), abs=1e-12)
    group = [chain([1, 2, 3])]
    assert np.array_equal(GIN.features(group), RandomGin(0).features(group))
    assert not np.allclose(GIN.features(group), RandomGin(1).features(group))
    maps = [m for layer in GIN._layers for m in (layer.inner, layer.outer)]
    assert not any(np.allclose(a, b) for i, a in enumerate(maps) for b in maps[:i])


@pytest.mark.parametrize("action", range(1, len(ACTIONS)))
def test_each_action_is_seen(action: int) -> None:
    assert differ(chain([0, 0, 0]), chain([0, action, 0]))


@pytest.mark.parametrize("category", range(1, len(CATEGORIES)))
def test_each_category_is_seen(category: int) -> None:
    links = {(0, 1): 1, (1, 2): 1}
    assert differ(graph(links, [0, 0, 0]), graph(links, [0, 0, 0], [0, category, 0]))


def test_edges_and_their_kinds_are_seen() -> None:
    nothing, sequence, share = (graph({(0, 1): sign}, [3, 3]) for sign in (0, 1, -1))
    assert differ(nothing, sequence)
    assert differ(nothing, share)
    assert differ(sequence, share)


def test_what_is_done_at_which_place_is_seen() -> None:
    assert differ(graph({}, [1, 2], [1, 2]), graph({}, [1, 2], [2, 1]))


def test_which_neighbour_is_tied_by_which_kind_of_edge_is_seen() -> None:
    for one in range(1, len(ACTIONS)):
        other = one % 12 + 1
        assert differ(graph({(0, 1): 1, (0, 2): -1}, [0, one, other]), graph({(0, 1): -1, (0, 2): 1}, [0, one, other]))


def test_the_order_in_a_life_is_seen_but_not_its_direction() -> None:
    assert differ(chain([1, 2, 3, 4]), chain([2, 1, 3, 4]))
    assert not differ(chain([1, 2, 3, 4]), chain([4, 3, 2, 1]))


def test_how_many_do_the_same_is_seen() -> None:
    assert differ(graph({}, [1]), graph({}, [1, 1]))
    assert differ(graph({(0, 1): -1}, [1, 1, 1]), graph({(0, 1): -1, (1, 2): -1, (0, 2): -1}, [1, 1, 1]))


def test_it_sees_three_edges_far() -> None:
    """Two marked nodes in a long chain: the third layer is the first to feel that they are 5 edges apart, not 7."""

    def marked(apart: int) -> SignedGraph:
        return chain([3 if i in (8, 8 + apart) else 0 for i in range(30)])

    features = np.split(GIN.features([marked(n) for n in (5, 7, 9)]), 3, axis=1)
    for layer, (five, seven, nine) in enumerate(features, start=1):
        assert np.allclose(five, seven, rtol=1e-9) == (layer < 3)
        assert np.allclose(seven, nine, rtol=1e-9)


def test_no_groups_have_no_features() -> None:
    assert GIN.features([]).shape == (0, 105)


def test_on_the_corpus_it_tells_altered_groups_from_authored_ones(groups: list[CrowdGraph]) -> None:
    rng = np.random.default_rng(0)
    order = rng.permutation(len(groups))
    train, test, other = ([groups[i] for i in rows] for rows in (order[:1000], order[1000:1500], order[1500:2000]))
    alone = [SignedGraph(np.maximum(g.adjacency, 0), g.action, g.category) for g in other]
    pool = np.concatenate([[g.action, g.category] for g in train], axis=1)
    random = [SignedGraph(g.adjacency, *(rng.choice(row, len(g.action)) for row in pool)) for g in other]
    scale = GIN.features(train)
    seen = [standardise(GIN.features(some), scale) for some in (test, other, alone, random)]
    ground, without_partners, shuffled = (mmd_squared(seen[0], features) for features in seen[1:])
    assert abs(ground) < 0.003
    assert without_partners > 0.01
    assert shuffled > 0.01


def test_standardised_is_in_units_of_the_training_set() -> None:
    train = np.random.default_rng(1).normal(5, 3, size=(500, 4))
    train[:, 3] = 0.1
    scaled = standardise(train, train)
    assert scaled.mean(0) == pytest.approx(0, abs=1e-9)
    assert scaled.std(0) == pytest.approx([1, 1, 1, 0], abs=1e-9)
    twice = train + 6
    assert standardise(twice, train).mean(0) == pytest.approx([*(6 / train[:, :3].std(0)), 6])
