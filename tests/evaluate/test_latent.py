from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ortho_group

from genc.evaluate.latent import bandwidth, frechet_distance, mmd, mmd_squared

seeds = st.integers(0, 2**32 - 1).map(np.random.default_rng)


@given(seeds, st.integers(2, 30), st.integers(1, 40))
def test_of_equal_covariances_the_frechet_distance_is_the_squared_shift(
    rng: np.random.Generator, n: int, d: int
) -> None:
    x, shift = rng.normal(size=(n, d)), rng.normal(size=d)
    assert frechet_distance(x, x) == pytest.approx(0, abs=1e-10)
    assert frechet_distance(x, rng.permutation(x) + shift) == pytest.approx(shift @ shift, rel=1e-9, abs=1e-9)


@given(seeds, st.integers(2, 30), st.integers(1, 40), st.floats(0.1, 10))
def test_of_one_cloud_scaled_it_is_the_trace_times_the_squared_change(
    rng: np.random.Generator, n: int, d: int, scale: float
) -> None:
    x = rng.normal(size=(n, d))
    x -= x.mean(0)
    expected = (1 - scale) ** 2 * x.var(0, ddof=1).sum()
    assert frechet_distance(x, scale * x) == pytest.approx(expected, rel=1e-8, abs=1e-8)


@given(seeds, st.integers(2, 20), st.integers(2, 20), st.floats(0.01, 100))
def test_symmetric_and_grows_with_the_square_of_the_latent_scale(
    rng: np.random.Generator, n: int, m: int, scale: float
) -> None:
    x, y = rng.normal(size=(n, 6)), 1 + 2 * rng.normal(size=(m, 6))
    distance = frechet_distance(x, y)
    assert distance > 0
    assert frechet_distance(y, x) == pytest.approx(distance)
    assert frechet_distance(scale * x, scale * y) == pytest.approx(scale**2 * distance, rel=1e-8)


@given(seeds)
def test_fewer_samples_than_dimensions_are_no_trouble(rng: np.random.Generator) -> None:
    x, y = rng.normal(size=(9, 4)), rng.normal(size=(12, 4)) @ rng.normal(size=(4, 4))
    turned = ortho_group.rvs(30, random_state=rng)[:4]  # the same clouds, in a corner of a larger space
    assert frechet_distance(x @ turned, y @ turned) == pytest.approx(frechet_distance(x, y), rel=1e-9)


def test_mmd_squared_is_nothing_on_average_between_halves_of_one_distribution() -> None:
    rng = np.random.default_rng(0)
    sample = rng.normal(size=(4000, 3))
    estimates = np.array([mmd_squared(x[:10], x[10:]) for x in sample.reshape(-1, 20, 3)])
    error = estimates.std() / len(estimates) ** 0.5
    assert abs(estimates.mean()) < 3 * error < 0.03  # the biased estimate would be 0.1 on average
    assert (estimates < 0).mean() > 0.3


@pytest.mark.parametrize("shift", [0.5, 1.0, 2.0])
def test_mmd_squared_between_two_gaussians_is_as_in_the_books(shift: float) -> None:
    rng, d, gamma = np.random.default_rng(1), 4, 0.1
    x, y = rng.normal(size=(2, 2500, d))
    y[:, 0] += shift
    spread = 1 + 4 * gamma
    expected = 2 * spread ** (-d / 2) * (1 - np.exp(-gamma * shift**2 / spread))
    assert mmd_squared(x, y, gamma) == pytest.approx(expected, rel=0.1)
    assert mmd(x, y, gamma) == mmd_squared(x, y, gamma) ** 0.5


def test_mmd_in_the_table_of_the_paper_is_nearer_to_the_square() -> None:
    """The figures of the docstring: 32 dimensions, unit variance, gamma 1 over the median squared distance of 64."""
    gamma = 1 / 64
    spread = 1 + 4 * gamma
    squares = [2 * spread**-16 * (1 - np.exp(-gamma * fid / spread)) for fid in (1.95, 9.29)]
    assert [round(s, 2) for s in squares] == [0.02, 0.10]
    assert [round(s**0.5, 2) for s in squares] == [0.15, 0.31]


def test_mmd_is_never_the_root_of_less_than_nothing() -> None:
    x = np.array([[0.0], [1.0], [2.0]])
    assert mmd_squared(x, x) < 0
    assert mmd(x, x) == 0


@given(seeds)
def test_the_bandwidth_comes_from_the_real_set_alone(rng: np.random.Generator) -> None:
    x, y = rng.normal(size=(15, 3)), 9 * rng.normal(size=(20, 3))
    distances = [((a - b) ** 2).sum() for i, a in enumerate(x) for b in x[:i]]
    assert bandwidth(x) == pytest.approx(1 / np.median(distances))
    assert mmd_squared(x, y) == mmd_squared(x, y, bandwidth(x)) != mmd_squared(x, y, bandwidth(y))


def test_points_that_coincide_say_nothing_of_the_scale() -> None:
    assert bandwidth(np.array([[0.0]] * 9 + [[2.0]])) == 0.25
    assert bandwidth(np.zeros((5, 3))) == 1


def test_the_bandwidth_of_a_large_set_is_that_of_rows_from_all_over_it() -> None:
    drifting = np.random.default_rng(2).normal(size=(5000, 2)) + np.linspace(0, 50, 5000)[:, None]
    some = drifting[np.random.default_rng(3).permutation(5000)[:1000]]
    assert bandwidth(drifting) == pytest.approx(bandwidth(some), rel=0.1)


def test_far_from_the_origin_nothing_is_lost() -> None:
    x, y = np.random.default_rng(4).normal(size=(2, 60, 3))
    assert mmd_squared(x + 1e6, y + 1e6, 0.5) == pytest.approx(mmd_squared(x, y, 0.5), abs=1e-8)
    assert frechet_distance(x + 1e6, y + 1e6) == pytest.approx(frechet_distance(x, y), rel=1e-6)


def test_thousands_of_points_do_not_fill_the_memory() -> None:
    x, y = np.random.default_rng(5).normal(size=(2, 4000, 2))
    tracemalloc.start()
    mmd_squared(x, y)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4000 * 4000 * 8 * 0.75  # less than one matrix of all pairs


@pytest.mark.parametrize("distance", [frechet_distance, mmd_squared, mmd])
def test_one_point_is_no_distribution(distance: object) -> None:
    for sizes in ((1, 5), (5, 1)):
        with pytest.raises(ValueError, match="needs two of each"):
            distance(*(np.zeros((n, 2)) for n in sizes))  # type: ignore[operator]
