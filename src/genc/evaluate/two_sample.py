"""Can a classifier tell generated groups from authored ones? (C2ST; Lopez-Paz and Oquab 2017, "Revisiting Classifier
Two-Sample Tests", arXiv 1610.06545)

One figure with an absolute scale: 0.5 is "cannot be told apart", 1 is "never mistaken". Well below 0.5 is a sign of
copying: a copy sits in another fold than its original, which teaches the classifier the wrong answer. It needs
scikit-learn (the extra `evaluate`).

The classifier is a logistic regression on standardised features. On the authored corpus against seven kinds of
altered and generated groups, gradient boosting and random forests found the same within 0.02 at 1,000 groups a side
(0.04 more where the generated set was too narrow); at 150 none was ahead throughout. They took 30 to 80 times as long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from genc.errors import ExtraError
from genc.evaluate.measures import profile
from genc.evaluate.random_gin import RandomGin, standardise
from genc.graph.crowd_graph import Ints
from genc.graph.signed_graph import Labelled

Floats = NDArray[np.float64]

N_FOLDS = 5
INVERSE_PENALTY = 0.01
"""The penalty must be strong: 736 descriptors, and often fewer groups."""
_Z95 = 1.959964


@dataclass(frozen=True)
class TwoSample:
    """How well real and generated are told apart.

    Attributes:
        accuracy: share of held-out samples that are recognised for what they are; 0.5 is best, 1 worst.
        auc: the probability that of a real and a generated sample the generated one is taken for it.
        low, high: 95% interval of the accuracy; of two samples of one distribution it covers 0.5 in 19 of 20 cases.
    """

    accuracy: float
    auc: float
    low: float
    high: float


def descriptors(groups: Sequence[Labelled], seed: int = 0) -> Floats:
    """What the classifier sees of each group `[n, d]`: the features of `RandomGin(seed)`, then its `profile`."""
    return np.hstack([RandomGin(seed).features(groups), profile(groups)])


def classifier_two_sample(
    real: Floats,
    generated: Floats,
    rng: np.random.Generator,
    clusters: tuple[ArrayLike, ArrayLike] | None = None,
) -> TwoSample:
    """How well a classifier, cross-validated, tells real features `[n, d]` from generated ones `[m, d]`.

    Of the larger set as many rows as the smaller has are drawn.

    Args:
        real, generated: features, such as `descriptors`.
        rng: draws the rows and the folds.
        clusters: for each real and each generated row the scenario that it is of, or was asked to be of. All of one
            scenario then fall into one fold. Else the classifier gets to know scenarios, and finds authored groups
            of some scenarios unlike those of others: 0.55 and 0.56 for the paper's two themes, not 0.50 and 0.51.

    Raises:
        ExtraError: if scikit-learn is not installed.
        ValueError: if a side has fewer than two rows or clusters: nothing could be held out.
    """
    size = min(len(real), len(generated))
    rows = [np.sort(rng.choice(len(side), size, replace=False)) for side in (real, generated)]
    features = np.concatenate([real[rows[0]], generated[rows[1]]])
    label = np.repeat([0, 1], size)
    cluster: Ints = np.arange(2 * size)
    if clusters is not None:
        named = [np.asarray(side)[chosen] for side, chosen in zip(clusters, rows, strict=True)]
        cluster = np.unique(np.concatenate(named), return_inverse=True)[1]
    return _judge(label, _held_out(features, label, _folds(label, cluster, rng)), cluster)


def _folds(label: Ints, cluster: Ints, rng: np.random.Generator) -> Ints:
    """The fold of each row: clusters whole, and those of each side dealt out in turn, so that no fold lacks a side in
    what is left to learn from."""
    within = [np.bincount(cluster[label == side], minlength=cluster.max() + 1) > 0 for side in (0, 1)]
    n_folds = min(N_FOLDS, *(int(there.sum()) for there in within))
    if n_folds < 2:
        raise ValueError("a side of fewer than two rows or clusters; the test holds out whole clusters")
    shared = within[0] & within[1]
    order = rng.permutation(len(shared))
    fold = np.zeros(len(shared), dtype=np.int64)
    for there in within:
        dealt = np.concatenate([order[shared[order]], order[(there & ~shared)[order]]])
        fold[dealt] = np.arange(len(dealt)) % n_folds
    return fold[cluster]


def _held_out(features: Floats, label: Ints, fold: Ints) -> Floats:
    """For each row the probability of being generated, by a classifier that has seen nothing of its fold."""
    try:
        from sklearn.linear_model import LogisticRegression
    except ImportError:
        raise ExtraError("the classifier two-sample test", "evaluate") from None
    probability = np.empty(len(label))
    for k in range(int(fold.max()) + 1):
        held, seen = features[fold == k], features[fold != k]
        classifier = LogisticRegression(C=INVERSE_PENALTY, max_iter=2000, class_weight="balanced")
        classifier.fit(standardise(seen, seen), label[fold != k])
        probability[fold == k] = classifier.predict_proba(standardise(held, seen))[:, 1]
    return probability


def _judge(label: Ints, generated: Floats, cluster: Ints) -> TwoSample:
    right = (generated > 0.5) == (label == 1)
    low, high = _interval(right, cluster)
    return TwoSample(float(right.mean()), _auc(label, generated), low, high)


def _auc(label: Ints, score: Floats) -> float:
    """Mann and Whitney's: ties count half."""
    real, generated = np.sort(score[label == 0]), score[label == 1]
    below = np.searchsorted(real, generated, "left") + np.searchsorted(real, generated, "right")
    return float(below.mean() / (2 * len(real)))


def _interval(right: NDArray[np.bool_], cluster: Ints) -> tuple[float, float]:
    """Wilson's interval for as many independent answers as the answers are worth.

    They are worth less than their number because a cluster answers alike, and because classifiers of different folds
    learned from nearly the same rows (the correction of Nadeau and Bengio 2003 for k folds: 1 + k / (k - 1)).
    """
    share = right.mean()
    n_answers = float(cluster.max() + 1)
    variance = np.square(np.bincount(cluster, right - share)).sum() / len(right) ** 2
    if variance > 0:
        n_answers = min(share * (1 - share) / variance, len(right))
    n_answers /= 1 + N_FOLDS / (N_FOLDS - 1)
    centre = share + _Z95**2 / (2 * n_answers)
    half = _Z95 * np.sqrt(share * (1 - share) / n_answers + _Z95**2 / (4 * n_answers**2))
    whole = 1 + _Z95**2 / n_answers
    return float((centre - half) / whole), float((centre + half) / whole)
