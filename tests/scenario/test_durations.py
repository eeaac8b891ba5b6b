from __future__ import annotations

import numpy as np
import pytest

from genc.scenario.durations import ANYWHERE, THERE, Duration, median_s, sample_durations
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category


def test_every_action_has_a_duration_that_makes_sense() -> None:
    assert set(ANYWHERE) == set(ACTIONS)
    for duration in (*ANYWHERE.values(), *THERE.values()):
        assert 0 < duration.shortest_s < duration.median_s < duration.longest_s <= 300
        assert 3 <= duration.median_s <= 120


@pytest.mark.parametrize("action", ACTIONS)
@pytest.mark.parametrize("category", CATEGORIES)
def test_samples_follow_the_table(action: Action, category: Category) -> None:
    n = 4000
    actions, categories = np.full(n, ACTIONS.index(action)), np.full(n, CATEGORIES.index(category))
    drawn_s = sample_durations(actions, categories, np.random.default_rng(1))
    duration: Duration = THERE.get((action, category), ANYWHERE[action])
    assert drawn_s.min() >= duration.shortest_s
    assert drawn_s.max() <= duration.longest_s
    assert np.median(drawn_s) == pytest.approx(median_s(action, category), rel=0.1)
    assert np.log(drawn_s).std() == pytest.approx(duration.spread, rel=0.25)


def test_a_place_can_matter() -> None:
    assert median_s(Action.OBJECT_INTERACT, Category.SERVICE_AREA) == 45
    assert median_s(Action.READ, Category.ITEM) < median_s(Action.READ, Category.ROOM)


def test_shape_is_kept_and_the_seed_decides() -> None:
    actions, categories = np.arange(12).reshape(3, 4), np.zeros((3, 4), dtype=np.int64)
    first, again, other = (sample_durations(actions, categories, np.random.default_rng(s)) for s in (5, 5, 6))
    assert first.shape == (3, 4)
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)
