"""The assessment of a corpus: what follows what in it, and how various its lives are, beside another corpus.

The paper sets what a language model wrote against annotated video (Gen-C, Assessment of LLM-bootstrapped Data).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.deviations import Deviation, deviations
from genc.evaluate.lives import Lives, read_lives
from genc.evaluate.sequences import entropy_interval, normalised_entropy, rarefied_entropy
from genc.evaluate.transitions import transition_counts, transition_matrix

ENOUGH_CLUSTERS = 20
"""Fewer make intervals that are too narrow."""


@dataclass(frozen=True, eq=False)
class Side:
    """One of two corpora.

    Attributes:
        lives: as they were compared.
        entropy: of their sequences, normalised, to be expected of as many as the other side is reduced to.
        low, high: its 95 % interval; None where one cluster holds more than half of all.
    """

    lives: Lives
    entropy: float
    low: float | None
    high: float | None

    @cached_property
    def transitions(self) -> NDArray[np.float64]:
        """The share of each action (column) in what follows another (row), `[13, 13]`; nan where nothing does."""
        return transition_matrix(self.lives.sequences)

    def as_json(self) -> dict[str, Any]:
        """Counts, entropies and transitions, ready for `json`."""
        sequences = self.lives.sequences
        return {
            "name": self.lives.name,
            "annotated": self.lives.annotated,
            "n_clusters": self.lives.n_clusters,
            "n_agents": len(sequences),
            "n_steps": sum(map(len, sequences)),
            "n_distinct_sequences": len(set(sequences)),
            "entropy": {"mean": self.entropy, "low": self.low, "high": self.high},
            "entropy_of_all": normalised_entropy(sequences),
            "transition_counts": transition_counts(sequences).tolist(),
        }


@dataclass(frozen=True, eq=False)
class Assessment:
    """Two corpora side by side.

    Attributes:
        a, b: the two.
        size: sequences that both are reduced to before their entropies are compared.
        merged: whether repetitions of an action were made one.
        seed: of rehearsals and intervals.
        deviations: the transitions of either whose share is known in both, those first that differ surely by the most.
    """

    a: Side
    b: Side
    size: int
    merged: bool
    seed: int
    deviations: tuple[Deviation, ...]

    @property
    def sides(self) -> dict[str, Side]:
        """Both by their letters."""
        return {"A": self.a, "B": self.b}

    @property
    def difference(self) -> NDArray[np.float64]:
        """The shares of a less those of b, `[13, 13]`; nan where one of them is unknown."""
        return self.a.transitions - self.b.transitions

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader must know, one sentence each."""
        return tuple(_notes(self))

    def as_json(self) -> dict[str, Any]:
        """All figures, ready for `json`."""
        return {
            "size": self.size,
            "merged": self.merged,
            "seed": self.seed,
            **{letter: side.as_json() for letter, side in self.sides.items()},
            "deviations": [asdict(deviation) for deviation in self.deviations],
            "notes": list(self.notes),
        }


def assess(a: Lives | Path | str, b: Lives | Path | str, seed: int = 0, *, merge: bool = False) -> Assessment:
    """What follows what in two corpora, and how various the lives in them are.

    Args:
        a, b: lives, or where they are; see `read_lives`.
        seed: of rehearsals and intervals. Exchanging a and b changes no interval.
        merge: make repetitions of an action one, on both sides. Where either is annotated video this is done in any
            case: two of an action cannot be told from one that goes on over a border of windows.

    Raises:
        GencError: if one of them cannot be read or is too small; see `read_lives`.
    """
    pair = [place if isinstance(place, Lives) else read_lives(place, seed) for place in (a, b)]
    merge = merge or any(lives.annotated for lives in pair)
    if merge:
        pair = [lives.merged() for lives in pair]
    size = min(len(lives.sequences) for lives in pair) // 2
    of_a, of_b = (_side(lives, size, seed) for lives in pair)
    return Assessment(of_a, of_b, size, merge, seed, tuple(deviations(of_a.lives, of_b.lives)))


def _side(lives: Lives, size: int, seed: int) -> Side:
    if lives.largest_share > 0.5:
        return Side(lives, rarefied_entropy(lives.sequences, size), None, None)
    found = entropy_interval(lives.sequences, size, np.random.default_rng(seed), lives.cluster)
    return Side(lives, found.mean, found.low, found.high)


def _notes(assessment: Assessment) -> Iterator[str]:
    if assessment.merged:
        yield "Repetitions of an action were made one on both sides, so nothing follows itself."
    if len({side.lives.annotated for side in assessment.sides.values()}) > 1:
        yield (
            "Annotated people are followed while they are in view, authored ones from coming to going, and what takes "
            "less than a window is rarely labelled: action sequences of video are shorter, and so more alike."
        )
    for letter, side in assessment.sides.items():
        clusters = "clips" if side.lives.annotated else "scenarios"
        if side.low is None:
            yield f"{letter} has no interval of its entropy: one of its {clusters} holds more than half of its agents."
        elif side.lives.n_clusters < ENOUGH_CLUSTERS:
            yield f"{letter} has {side.lives.n_clusters} {clusters}: its intervals are too narrow."
