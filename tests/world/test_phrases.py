from __future__ import annotations

import pytest

from genc.scenario.corpus import load_corpus
from genc.scenario.scenario import Location
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category
from genc.world.phrases import Setting, clock, doing, names, passing, said_of, span, with_article


@pytest.mark.parametrize("category", CATEGORIES)
@pytest.mark.parametrize("action", [action for action in ACTIONS if action is not Action.ENTER_EXIT])
@pytest.mark.parametrize("within", [True, False])
def test_every_action_has_a_phrase_at_every_kind_of_place(action, category, within):
    place = Location("corner", category, (0.0, 0.0), (1.0, 1.0))
    phrase = doing(action, Setting(place, within), "Person 3")
    assert "the corner" in phrase
    assert "{" not in phrase
    again = doing(action, Setting(place, within, named=True), "Person 3")
    assert "corner" not in again
    assert said_of(phrase, plural=False) != said_of(phrase, plural=True)


def test_people_do_with_things_what_things_are_for():
    board = Setting(Location("departure board", Category.ITEM, (0, 0), (1, 1)), within=False)
    hall = Setting(Location("hall", Category.ROOM, (0, 0), (9, 9)), within=True)
    assert said_of(doing(Action.READ, board), plural=False) == "reads the departure board"
    assert said_of(doing(Action.LOOK_AT, hall), plural=False) == "looks around in the hall"
    assert said_of(doing(Action.OBJECT_INTERACT, hall), plural=True) == "are busy with something in the hall"
    assert said_of(doing(Action.DISCUSS, hall, "each other"), plural=True) == "talk with each other in the hall"


def test_coming_and_going_depend_on_the_way():
    arch = Location("arch", Category.ENTRANCE, (0, 0), (1, 1))
    library = Location("library", Category.BUILDING, (0, 0), (9, 9))
    assert [passing(arch, way) for way in ("first", "through", "last")] == [
        "come in by the arch",
        "go through the arch",
        "leave by the arch",
    ]
    assert [passing(library, way) for way in ("first", "in", "out")] == [
        "come out of the library",
        "go into the library",
        "leave the library",
    ]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("pizza van", "the pizza van"),
        ("platform 2", "platform 2"),
        ("gate B12", "gate B12"),
        ("hall b", "hall b"),
        ("Old Main", "Old Main"),
        ("the deck", "the deck"),
    ],
)
def test_names_take_an_article_where_english_does(name, told):
    assert with_article(name) == told


def test_no_place_of_the_corpus_has_two_articles():
    for scenario in load_corpus():
        for location in scenario.environment.locations:
            assert not with_article(location.name).lower().startswith(("the the ", "the a ", "the an "))


def test_names_are_listed_and_the_rest_counted():
    assert names([3]) == "Person 3"
    assert names([3, 4]) == "Persons 3 and 4"
    assert names([1, 2, 3, 4, 5]) == "Persons 1, 2, 3, 4 and 5"
    assert names([1, 2, 3, 4, 5, 6]) == "Persons 1, 2, 3, 4 and 2 others"
    assert names(range(20), most=15).endswith("14 and 5 others")


def test_times_are_read_off_a_clock():
    assert [clock(t) for t in (0, 59.6, 61, 3600)] == ["00:00", "01:00", "01:01", "60:00"]
    assert [span(t) for t in (7.4, 59.4, 60, 125)] == ["7 s", "59 s", "1:00 min", "2:05 min"]
