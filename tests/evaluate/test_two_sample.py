from __future__ import annotations

import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import norm
from sklearn.metrics import roc_auc_score

from genc.errors import ExtraError
from genc.evaluate.measures import N_BINS, profile
from genc.evaluate.random_gin import RandomGin
from genc.evaluate.two_sample import _auc, _folds, classifier_two_sample, descriptors
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph


def fresh() -> np.random.Generator:
    return np.random.default_rng(0)


def test_samples_of_one_distribution_cannot_be_told_apart() -> None:
    rng = fresh()
    found = [classifier_two_sample(*rng.normal(size=(2, 100, 20)), rng) for _ in range(40)]
    assert np.mean([f.accuracy for f in found]) == pytest.approx(0.5, abs=0.02)
    assert np.mean([f.auc for f in found]) == pytest.approx(0.5, abs=0.03)
    assert np.mean([f.low < 0.5 < f.high for f in found]) > 0.9


@pytest.mark.parametrize("shift", [0.5, 1.0, 3.0])
def test_two_gaussians_are_told_apart_as_well_as_can_be(shift: float) -> None:
    rng = fresh()
    real, generated = rng.normal(size=(2, 3000, 2))
    generated[:, 1] += shift
    found = classifier_two_sample(real, generated, rng)
    assert found.accuracy == pytest.approx(norm.cdf(shift / 2), abs=0.02)
    assert found.auc == pytest.approx(norm.cdf(shift / 2**0.5), abs=0.02)
    assert found.low < norm.cdf(shift / 2) < found.high


def test_the_scale_of_a_column_has_no_influence() -> None:
    rng = fresh()
    real, generated = rng.normal(size=(2, 400, 3))
    generated[:, 0] += 1
    units = np.array([1e-4, 1.0, 1e4])
    plain = classifier_two_sample(real, generated, fresh())
    assert classifier_two_sample(real * units, generated * units, fresh()).auc == pytest.approx(plain.auc, abs=1e-3)


def test_the_interval_is_wilson_s() -> None:
    rng = fresh()
    real, generated = rng.normal(size=(2, 450, 2))
    found = classifier_two_sample(real, generated + 0.7, rng)
    n = 900 / 2.25  # the answers are worth 1 / (1 + 5 / 4) of as many independent ones
    for end in (found.low, found.high):
        assert abs(found.accuracy - end) == pytest.approx(1.959964 * (end * (1 - end) / n) ** 0.5, rel=1e-6)
    assert found.low < found.accuracy < found.high


def test_answers_of_one_cluster_count_as_little_as_they_are_worth() -> None:
    rng = fresh()
    real, generated = rng.normal(size=(2, 60, 2))
    generated += 0.7
    copies = [np.repeat(side, 10, axis=0) for side in (real, generated)]
    cluster = [np.repeat(np.arange(start, start + 60), 10) for start in (0, 60)]
    few = classifier_two_sample(real, generated, rng)
    many = classifier_two_sample(*copies, rng, (cluster[0], cluster[1]))
    assert many.high - many.low == pytest.approx(few.high - few.low, rel=0.1)


def test_a_cluster_is_never_recognised_by_its_own() -> None:
    """Both sides are alike, but each scenario is known by its place in 10 dimensions."""
    rng = fresh()
    places = 3 * rng.normal(size=(40, 10))
    cluster = np.concatenate([rng.permutation(np.repeat(c, 25)) for c in (np.arange(15), np.arange(15, 40))])
    rows = places[cluster] + 0.1 * rng.normal(size=(1000, 10))
    real, generated = rows[:375], rows[375:]  # of unequal size: names must follow the rows that are drawn
    names = [f"scenario {c}" for c in cluster]
    kept_whole = names[:375], names[375:]
    assert np.mean([classifier_two_sample(real, generated, rng).accuracy for _ in range(5)]) > 0.65
    assert np.mean([classifier_two_sample(real, generated, rng, kept_whole).accuracy for _ in range(5)]) < 0.55


def test_a_fold_of_one_side_alone_is_seen_on_the_scale_of_the_others() -> None:
    rng = fresh()
    real, generated = rng.normal(size=(2, 100, 2))
    generated[:, 0] += 5
    uneven = np.repeat(np.arange(5), [80, 5, 5, 5, 5])
    for _ in range(5):
        assert classifier_two_sample(real, generated, rng, (uneven, uneven + 5)).accuracy > 0.9


def test_copies_come_out_below_a_half_unless_they_are_kept_with_their_originals() -> None:
    rng = fresh()
    real = rng.normal(size=(200, 60))
    copies = rng.permutation(real)
    assert classifier_two_sample(real, copies, rng).high < 0.5
    names = np.arange(200)
    assert classifier_two_sample(real, real.copy(), rng, (names, names)).accuracy == 0.5


def test_of_the_larger_set_rows_from_all_over_it_are_taken() -> None:
    rng = fresh()
    few, many = rng.normal(size=(100, 3)), rng.normal(size=(1000, 3))
    many[:100] += 9
    for real, generated in ((few, many), (many, few)):
        assert classifier_two_sample(real, generated, rng).accuracy < 0.7


def test_one_seed_one_result() -> None:
    real, generated = fresh().normal(size=(2, 80, 5))
    found = [classifier_two_sample(real, generated[:70], np.random.default_rng(seed)) for seed in (3, 3, 4)]
    assert found[0] == found[1] != found[2]


sides = st.lists(st.integers(0, 8), min_size=2, max_size=60).filter(lambda side: len(set(side)) > 1)


@given(sides, sides, st.integers(0, 9), st.integers(0, 2**32 - 1))
def test_folds_keep_clusters_whole_and_leave_both_sides_to_learn_from(
    real: list[int], generated: list[int], apart: int, seed: int
) -> None:
    label = np.repeat([0, 1], [len(real), len(generated)])
    cluster = np.unique([*real, *(c + apart for c in generated)], return_inverse=True)[1]
    fold = _folds(label, cluster, np.random.default_rng(seed))
    assert all(len(set(fold[cluster == c])) == 1 for c in set(cluster))
    assert set(fold) == set(range(min(5, len(set(real)), len(set(generated)))))
    assert all(set(label[fold != k]) == {0, 1} for k in set(fold))


def test_rows_without_clusters_fall_evenly_into_five_folds() -> None:
    label, cluster = np.repeat([0, 1], 50), np.arange(100)
    fold = _folds(label, cluster, fresh())
    assert np.bincount(fold * 2 + label).tolist() == [10] * 10
    assert (np.diff(fold[:50]) < 0).sum() > 15  # by lot, not in order


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 6)), min_size=2, max_size=50))
def test_the_auc_is_that_of_sklearn(answers: list[tuple[bool, int]]) -> None:
    label, score = np.array(answers).T
    if 0 < label.sum() < len(label):
        assert _auc(label, score.astype(float)) == pytest.approx(roc_auc_score(label, score))


def test_too_little_to_hold_anything_out() -> None:
    with pytest.raises(ValueError, match="fewer than two rows or clusters"):
        classifier_two_sample(np.zeros((1, 2)), np.ones((9, 2)), fresh())
    with pytest.raises(ValueError, match="fewer than two rows or clusters"):
        classifier_two_sample(np.zeros((9, 2)), np.ones((9, 2)), fresh(), (np.zeros(9), np.arange(9)))


def test_without_scikit_learn_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sklearn.linear_model", None)
    with pytest.raises(ExtraError, match=r"genc\[evaluate\]"):
        classifier_two_sample(*fresh().normal(size=(2, 9, 2)), fresh())


def test_descriptors_are_the_features_and_the_profile(groups: list[CrowdGraph]) -> None:
    some = groups[:20]
    seen = descriptors(some, seed=3)
    assert seen.shape == (20, 105 + N_BINS)
    assert np.array_equal(seen[:, :105], RandomGin(3).features(some))
    assert np.array_equal(seen[:, 105:], profile(some))


def test_on_the_corpus_it_tells_shuffled_labels_from_authored_ones(groups: list[CrowdGraph]) -> None:
    rng = fresh()
    order = rng.permutation(len(groups))[:600]
    real, other = ([groups[i] for i in rows] for rows in (order[:300], order[300:]))
    pool = np.concatenate([[g.action, g.category] for g in groups[::7]], axis=1)
    random = [SignedGraph(g.adjacency, *(rng.choice(row, len(g.action)) for row in pool)) for g in other]
    seen = descriptors(real)
    alike = classifier_two_sample(seen, descriptors(other), rng)
    assert alike.low < 0.5 < alike.high
    assert classifier_two_sample(seen, descriptors(random), rng).accuracy > 0.9
