from __future__ import annotations

import numpy as np
import pytest

from genc.evaluate.comparison import NAMES, Divergences, compare, floor
from genc.evaluate.distances import kl_divergence
from genc.evaluate.measures import Profile

SIZE = 300


def test_the_test_set_itself_is_at_no_distance(authored: Profile) -> None:
    test = authored[:SIZE]
    assert compare(test, [test, test[::-1]]).nats == pytest.approx(np.zeros((2, 9)), abs=1e-12)


def test_each_draw_has_its_row(authored: Profile) -> None:
    test, one, two = authored[:SIZE], authored[SIZE : 2 * SIZE], authored[2 * SIZE : 3 * SIZE]
    both = compare(test, [one, two])
    assert both.nats.shape == (2, len(NAMES))
    assert np.array_equal(both.nats[1], compare(test, [two]).nats[0])
    assert both.means["joint"] == pytest.approx(both.nats[:, NAMES.index("joint")].mean())
    assert both.spreads["joint"] == pytest.approx(both.nats[:, NAMES.index("joint")].std())


def test_the_direction_is_from_the_test_set(authored: Profile) -> None:
    test, draw = authored[:SIZE], authored[SIZE : 2 * SIZE]
    diameter = slice(37, 137)  # after 17 bins of degree and 20 of clustering
    wanted = kl_divergence(test.sum(0)[diameter], draw.sum(0)[diameter])
    assert compare(test, [draw]).means["diameter"] == pytest.approx(wanted)
    assert compare(draw, [test]).means["diameter"] != pytest.approx(wanted)


def test_the_floor_follows_its_seed(authored: Profile) -> None:
    def drawn(seed: int) -> Divergences:
        return floor(authored[SIZE:], authored[:SIZE], 5, np.random.default_rng(seed))

    assert np.array_equal(drawn(1).nats, drawn(1).nats)
    assert not np.array_equal(drawn(1).nats, drawn(2).nats)


def test_the_floor_sinks_as_the_sets_grow(authored: Profile) -> None:
    mixed = np.random.default_rng(0).permutation(authored)
    floors = [floor(mixed[2000:], mixed[:n], 20, np.random.default_rng(0)).nats.mean(0) for n in (100, 400, 1600)]
    assert np.all(floors[0] > floors[1])
    assert np.all(floors[1] > floors[2])


def test_a_floor_needs_a_training_set_as_large_as_the_test_set(authored: Profile) -> None:
    with pytest.raises(ValueError, match="larger sample"):
        floor(authored[:10], authored[10:30], 1, np.random.default_rng(0))


def test_large_groups_alone_are_far_above_the_floor(authored: Profile) -> None:
    mixed = np.random.default_rng(0).permutation(authored)
    test, rest = mixed[:SIZE], mixed[SIZE:]
    n_nodes = rest[:, :17].sum(1)
    large = rest[np.argsort(n_nodes)[-SIZE:]]
    ground = floor(rest, test, 50, np.random.default_rng(0))
    found = compare(test, [large])
    assert found.total_ratio(ground) > 5
    assert found.ratios(ground)["diameter"] > 5


def test_ratios_are_of_means_and_the_total_is_of_sums() -> None:
    ground = Divergences(np.array([[1.0] * 8 + [2.0], [3.0] * 8 + [2.0]]))  # means: 2 everywhere
    found = Divergences(np.array([[1.0] * 8 + [12.0]]))
    assert found.ratios(ground) == dict(zip(NAMES, [0.5] * 8 + [6.0], strict=True))
    assert found.total_ratio(ground) == pytest.approx(20 / 18)
