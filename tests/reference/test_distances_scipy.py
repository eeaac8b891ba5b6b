"""The distances against scipy, and against their definitions written out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import sqrtm
from scipy.spatial.distance import cdist, jensenshannon
from scipy.stats import entropy

from genc.evaluate.distances import js_divergence, kl_divergence
from genc.evaluate.latent import frechet_distance, mmd_squared

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


@given(pairs)
def test_jensen_and_shannon_s_divergence_is_the_square_of_the_distance_of_scipy(
    counts: tuple[np.ndarray, np.ndarray],
) -> None:
    p, q = counts[0] + 0.0, counts[1] + 0.0
    if p.any() and q.any():
        assert js_divergence(p, q) == pytest.approx(jensenshannon(p, q, 2) ** 2, rel=1e-9, abs=1e-12)


samples = st.tuples(st.integers(0, 2**32 - 1), st.integers(20, 60), st.integers(20, 60), st.integers(1, 8)).map(
    lambda drawn: _two_clouds(*drawn)
)


def _two_clouds(seed: int, n: int, m: int, d: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    x, y = (rng.normal(size=(size, d)) @ rng.normal(size=(d, d)) + rng.normal(size=d) for size in (n, m))
    return x, y


@given(samples)
def test_frechet_distance_with_the_matrix_root_of_scipy(clouds: tuple[np.ndarray, np.ndarray]) -> None:
    x, y = clouds
    s, t = (np.atleast_2d(np.cov(z, rowvar=False)) for z in clouds)
    wanted = ((x.mean(0) - y.mean(0)) ** 2).sum() + np.trace(s + t - 2 * sqrtm(s @ t).real)
    assert frechet_distance(x, y) == pytest.approx(wanted, rel=1e-5, abs=1e-5)


@given(samples, st.floats(0.01, 2))
def test_mmd_with_every_pair_written_out(clouds: tuple[np.ndarray, np.ndarray], gamma: float) -> None:
    def mean(a: np.ndarray, b: np.ndarray) -> float:
        return float(np.mean([np.exp(-gamma * ((p - q) ** 2).sum()) for p in a for q in b if p is not q]))

    x, y = ([*z[:12]] for z in clouds)
    wanted = mean(x, x) + mean(y, y) - 2 * mean(x, y)
    assert mmd_squared(np.array(x), np.array(y), gamma) == pytest.approx(wanted, rel=1e-9, abs=1e-12)


def test_mmd_of_more_rows_than_a_block_holds() -> None:
    x, y = np.random.default_rng(0).normal(size=(2, 1300, 3))
    y = y[:700] + 0.3
    xx, yy, xy = (np.exp(-0.2 * cdist(a, b, "sqeuclidean")) for a, b in ((x, x), (y, y), (x, y)))
    within = [(k.sum() - len(k)) / (len(k) * (len(k) - 1)) for k in (xx, yy)]
    assert mmd_squared(x, y, 0.2) == pytest.approx(sum(within) - 2 * xy.mean(), rel=1e-8)
