from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.evaluate.distances import js_divergence, kl_divergence

counts = st.lists(st.integers(0, 500), min_size=2, max_size=60).filter(any).map(np.array)


@given(counts, st.randoms())
def test_never_negative_and_blind_to_the_order_of_bins(authored: np.ndarray, chance: object) -> None:
    order = np.arange(len(authored))
    chance.shuffle(order)  # type: ignore[attr-defined]
    generated = authored[order]
    assert kl_divergence(authored, generated) >= -1e-12
    again = np.argsort(authored, kind="stable")
    assert kl_divergence(authored[again], generated[again]) == pytest.approx(kl_divergence(authored, generated))


@given(counts)
def test_equal_histograms_are_at_no_distance(authored: np.ndarray) -> None:
    assert kl_divergence(authored, authored) == pytest.approx(0, abs=1e-12)


def test_what_the_generator_lacks_costs_more_than_what_it_adds() -> None:
    full, lacking = [50, 50, 50], [75, 75, 0]
    assert kl_divergence(full, lacking) > 2 * kl_divergence(lacking, full)


def test_one_group_never_generated_costs_what_is_documented() -> None:
    authored, generated = np.zeros(100), np.zeros(100)
    authored[:5], generated[:5] = [50, 50, 50, 50, 50], [50, 50, 50, 50, 50]
    authored[4], authored[90] = 49, 1
    assert kl_divergence(authored, generated) == pytest.approx(0.0186 - 1 / 251, abs=5e-4)


def test_the_smoothing_fades_as_data_grow() -> None:
    authored, generated = np.array([3, 5, 2]), np.array([2, 4, 4])
    exact = sum(p * math.log(p / q) for p, q in zip([0.3, 0.5, 0.2], [0.2, 0.4, 0.4], strict=True))
    errors = [abs(kl_divergence(n * authored, n * generated) - exact) for n in (1, 10, 100, 1000)]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-4


@given(counts, counts)
def test_jensen_and_shannon_s_is_symmetric_and_blind_to_totals(one: np.ndarray, other: np.ndarray) -> None:
    n = min(len(one), len(other))
    p, q = one[:n] + 1, other[:n] + 1
    divergence = js_divergence(p, q)
    assert js_divergence(q, p) == pytest.approx(divergence)
    assert js_divergence(7 * p, q / 3) == pytest.approx(divergence, abs=1e-12)
    assert -1e-12 <= divergence < 1


def test_jensen_and_shannon_s_is_in_bits() -> None:
    assert js_divergence([1, 2, 0], [2, 4, 0]) == 0
    assert js_divergence([1, 0, 0], [0, 1, 1]) == 1
    assert js_divergence([1, 0], [1, 1]) == pytest.approx(0.311278, abs=1e-6)  # H(3/4) - H(1/2) / 2
