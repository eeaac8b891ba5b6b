from __future__ import annotations

import math

import pytest

from genc.errors import BriefError
from genc.words.brief import Brief
from genc.words.vocabulary import ACTIONS, CATEGORIES, Category, parse_action, parse_category, vocabulary_hash

EVEN = (1 / 13,) * 13


def test_the_vocabulary_is_that_of_the_paper():
    assert (len(ACTIONS), len(CATEGORIES)) == (13, 8)
    # trained weights mean nothing under another order: whoever changes it must train anew
    assert vocabulary_hash() == "cd5a45975cd67ebb"


def test_the_paper_calls_a_service_area_a_service_station_too():
    assert parse_category("service station") is Category.SERVICE_AREA
    assert parse_category("service area") is Category.SERVICE_AREA
    assert parse_category("shop") is None
    assert parse_action("dance") is None


@pytest.mark.parametrize(
    ("wish", "said"),
    [
        ({"text": ""}, "sentence is empty"),
        ({"text": " \n\t "}, "sentence is empty"),
        ({"text": "x" * 20_001}, "20001 characters"),
        ({"text": "x", "n_agents": 0}, "0 agents"),
        ({"text": "x", "n_agents": 16}, "1 to 15"),
        ({"text": "x", "n_events": 31}, "1 to 30"),
        ({"text": "x", "n_nodes": 101}, "1 to 100"),
        ({"text": "x", "n_agents": 5, "n_events": 3, "n_nodes": 6}, "at least 7"),
        ({"text": "x", "action_frequencies": EVEN[:12]}, "12 action frequencies"),
        ({"text": "x", "action_frequencies": (0.5,) * 13}, "sum to 1"),
        ({"text": "x", "action_frequencies": (math.nan, *EVEN[1:])}, "sum to 1"),
    ],
)
def test_a_brief_that_no_group_can_meet_cannot_exist(wish, said):
    with pytest.raises(BriefError, match=said):
        Brief(**wish)


def test_counts_that_fit_one_event_only_in_whole_turns_are_checked():
    with pytest.raises(BriefError, match="one event"):
        Brief("x", n_agents=3, n_events=1, n_nodes=10)
    assert Brief("x", n_agents=3, n_events=1, n_nodes=9).n_nodes == 9
