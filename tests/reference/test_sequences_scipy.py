"""Entropies of action sequences against scipy, and rarefaction against drawing."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import entropy

from genc.evaluate.sequences import ActionSequence, normalised_entropy, rarefied_entropy

SAMPLES = st.lists(st.lists(st.integers(0, 2), min_size=1, max_size=3).map(tuple), min_size=2, max_size=60)


@given(SAMPLES)
def test_normalised_entropy(sequences: list[ActionSequence]) -> None:
    counts = list(Counter(sequences).values())
    wanted = entropy(counts, base=len(counts)) if len(counts) > 1 else 0
    assert normalised_entropy(sequences) == pytest.approx(wanted)


@given(SAMPLES.map(lambda sequences: sequences[:8]), st.data())
def test_rarefied_entropy_is_of_all_draws_there_are(sequences: list[ActionSequence], data: st.DataObject) -> None:
    size = data.draw(st.integers(1, len(sequences)))
    draws = [list(Counter(draw).values()) for draw in combinations(sequences, size)]
    mean_entropy, mean_distinct = np.mean([entropy(c) for c in draws]), np.mean([len(c) for c in draws])
    wanted = mean_entropy / np.log(mean_distinct) if mean_distinct > 1 else 0
    assert rarefied_entropy(sequences, size) == pytest.approx(wanted, abs=1e-9)


@given(SAMPLES)
def test_a_sample_of_all_is_no_sample(sequences: list[ActionSequence]) -> None:
    assert rarefied_entropy(sequences, len(sequences)) == pytest.approx(normalised_entropy(sequences), abs=1e-9)
