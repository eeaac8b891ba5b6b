"""The divergence against scipy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import entropy

from genc.evaluate.distances import kl_divergence

pairs = st.integers(2, 200).flatmap(
    lambda n: st.tuples(*[st.lists(st.integers(0, 10_000), min_size=n, max_size=n).map(np.array)] * 2)
)


@given(pairs, st.floats(0.01, 100))
def test_relative_entropy_of_smoothed_counts(counts: tuple[np.ndarray, np.ndarray], weight: float) -> None:
    authored, generated = counts
    share = weight / len(authored)
    wanted = entropy(authored + share, generated + share)  # scipy makes shares of both
    assert kl_divergence(authored, generated, weight) == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@given(pairs)
def test_without_empty_bins_hardly_smoothed_is_not_smoothed(counts: tuple[np.ndarray, np.ndarray]) -> None:
    authored, generated = counts[0] + 1, counts[1] + 1
    assert kl_divergence(authored, generated, 1e-9) == pytest.approx(entropy(authored, generated), rel=1e-6, abs=1e-9)
