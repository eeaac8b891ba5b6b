from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.errors import BriefError
from genc.model.paper.generator import completed_counts
from genc.words.brief import Brief

counts = st.one_of(st.none(), st.integers(1, 15)), st.one_of(st.none(), st.integers(1, 30))
known = st.tuples(st.integers(1, 15), st.integers(1, 30), st.integers(1, 100))


@given(*counts, st.one_of(st.none(), st.integers(1, 100)), known)
def test_completed_counts_keep_what_is_asked_and_can_be_met(
    n_agents: int | None, n_events: int | None, n_nodes: int | None, like: tuple[int, int, int]
) -> None:
    try:
        brief = Brief("x", n_agents, n_events, n_nodes)
    except BriefError:
        return
    found = completed_counts(brief, like)
    Brief("x", *found)  # refuses what no group can have
    for asked, value in zip((n_agents, n_events, n_nodes), found, strict=True):
        assert asked in (None, value)


def test_completed_counts_stay_near_the_group_they_are_like() -> None:
    assert completed_counts(Brief("x"), (3, 4, 20)) == (3, 4, 20)
    assert completed_counts(Brief("x", n_agents=5), (4, 4, 20)) == (5, 4, 20)
    assert completed_counts(Brief("x", n_nodes=2), (3, 4, 20)) == (2, 1, 2)


def test_labels_are_the_likeliest_or_drawn_from_their_distribution() -> None:
    from genc.model.paper.generator import choose

    rng = np.random.default_rng(0)
    probabilities = np.tile(np.array([[0.2, 0.5, 0.3]], dtype=np.float32), (20_000, 1))
    assert set(choose(probabilities, None).tolist()) == {1}
    shares = np.bincount(choose(probabilities, rng)) / 20_000
    assert shares == pytest.approx([0.2, 0.5, 0.3], abs=0.015)
    certain = np.eye(3, dtype=np.float32)
    assert choose(certain, rng).tolist() == [0, 1, 2]
