from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from genc.evaluate.measures import MEASURES, Profile, histograms
from genc.evaluate.sequences import ActionSequence, action_sequences
from genc.evaluate.transitions import transition_counts, transition_matrix
from genc.graph.crowd_graph import CrowdGraph

SEQUENCES = st.lists(st.lists(st.integers(0, 12), min_size=1, max_size=6).map(tuple), max_size=20)


def test_by_hand() -> None:
    sequences = [(4, 2, 4), (4, 2, 2, 12), (4, 7), (9,)]
    counts, matrix = transition_counts(sequences), transition_matrix(sequences)
    assert {(int(i), int(j)): int(counts[i, j]) for i, j in np.argwhere(counts)} == {
        (4, 2): 2,
        (4, 7): 1,
        (2, 4): 1,
        (2, 2): 1,
        (2, 12): 1,
    }
    assert np.allclose(matrix[4, [2, 7, 4]], [2 / 3, 1 / 3, 0])
    assert np.allclose(matrix[2, [4, 2, 12]], [1 / 3, 1 / 3, 1 / 3])
    assert set(np.flatnonzero(np.isnan(matrix).all(1))) == set(range(13)) - {2, 4}  # 12, 7 and 9 only end


@given(SEQUENCES)
def test_against_a_loop(sequences: list[ActionSequence]) -> None:
    wanted = np.zeros((13, 13))
    for sequence in sequences:
        for i in range(len(sequence) - 1):
            wanted[sequence[i], sequence[i + 1]] += 1
    assert np.array_equal(transition_counts(sequences), wanted)
    for row, counts in zip(transition_matrix(sequences), wanted, strict=True):
        if counts.sum():
            assert np.allclose(row, counts / counts.sum())
        else:
            assert np.isnan(row).all()


def test_they_are_those_of_the_profile(groups: list[CrowdGraph], authored: Profile) -> None:
    at = [measure.name for measure in MEASURES].index("action transition")
    assert np.array_equal(transition_counts(action_sequences(groups)).ravel(), histograms(authored.sum(0))[at])
