"""The generator that comes with the package hears what a sentence says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from genc.graph.codec import group_fault
from genc.model.checkpoint import SHIPPED, load_generator
from genc.words.brief import Brief
from genc.words.vocabulary import ACTION_INDEX, Action

pytestmark = pytest.mark.text

READING = "Students read in the library"
LOOKING = "In the museum, visitors look at the paintings"
PHONING = "Commuters wait for a delayed train while talking on their phones"
SITTING = "In the park, friends sit on the grass and talk with each other"


@pytest.fixture(scope="module")
def groups():
    generator = replace(load_generator(), guidance=2.0)
    asked = [Brief(text) for text in (READING, LOOKING, PHONING, SITTING) for _ in range(150)]
    drawn = generator.sample(asked, np.random.default_rng(0))
    return {text: drawn[150 * i : 150 * (i + 1)] for i, text in enumerate((READING, LOOKING, PHONING, SITTING))}


def test_every_group_is_valid(groups):
    assert [fault for drawn in groups.values() for group in drawn if (fault := group_fault(group))] == []


@pytest.mark.parametrize(
    ("text", "action"),
    [
        (READING, Action.READ),
        (LOOKING, Action.LOOK_AT),
        (PHONING, Action.TALK_ON_PHONE),
        (SITTING, Action.SIT),
    ],
)
def test_what_the_sentence_names_is_done_most_where_it_is_named(groups, text, action):
    share = {
        said: float(np.mean(np.concatenate([group.action for group in drawn]) == ACTION_INDEX[action]))
        for said, drawn in groups.items()
    }
    assert max(share, key=lambda said: share[said]) == text, share


def test_it_is_small_and_ships_with_its_card():
    assert sum(file.stat().st_size for file in SHIPPED.iterdir()) < 5_000_000
    assert (SHIPPED / "README.md").is_file()
