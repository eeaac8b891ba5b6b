from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
from crowds import HALL, alone, environment, plan
from hypothesis import given
from hypothesis import strategies as st

from genc.plan.occasion import occasions_of
from genc.plan.place import SUBSTITUTES, WAY_IN, Chooser, with_way_in
from genc.plan.plan import CrowdPlan
from genc.plan.slots import places_of
from genc.plan.venue import Venue
from genc.plan.walkable import Walkable
from genc.scenario.record import Record
from genc.scenario.scenario import Environment
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category

STEPS = st.lists(st.tuples(st.sampled_from(ACTIONS), st.sampled_from(CATEGORIES)), min_size=1, max_size=8)
GROUND = Walkable.of(HALL)
PLACES = places_of(HALL, GROUND)


def _chosen(groups: list[list[Record]], seed: int = 0, affinity: np.ndarray | None = None) -> list[str]:
    chooser = Chooser(Venue(HALL, PLACES, GROUND), affinity)
    indices, _ = chooser.choose(occasions_of(groups), np.random.default_rng(seed))
    return [HALL.locations[i].name for i in indices]


def _wishing(record: Record, *names: str | None) -> Record:
    return Record(record.agent, tuple(replace(s, location=n) for s, n in zip(record.steps, names, strict=True)))


def _places(made: CrowdPlan) -> list[str]:
    row = made.people[0].activities
    return [made.environment.locations[a.location].name for a in row if not a.implied]


@given(STEPS)
def test_everything_happens_where_the_category_is_or_at_what_stands_in_for_it(steps):
    there = {place.category for place in HALL.locations}
    for (action, category), name in zip(steps, _chosen([alone(*steps)]), strict=True):
        if category in there:
            assert HALL[name].category is category
        elif action is Action.ENTER_EXIT:
            assert HALL[name].category is Category.ENTRANCE
        else:
            assert HALL[name].category is next(c for c in SUBSTITUTES[category] if c in there)


@given(STEPS, st.integers(0, 5))
def test_the_same_seed_chooses_the_same_places(steps, seed):
    assert _chosen([alone(*steps)] * 3, seed) == _chosen([alone(*steps)] * 3, seed)


def test_what_belongs_to_one_thing_is_done_at_one_thing():
    visit = alone(
        (Action.QUEUE, Category.SERVICE_AREA),
        (Action.OBJECT_INTERACT, Category.SERVICE_AREA),
        (Action.WAIT, Category.SERVICE_AREA),
    )
    for seed in range(20):
        assert len(set(_chosen([visit], seed))) == 1


def test_a_place_that_the_author_named_is_kept_and_one_that_is_not_there_is_replaced():
    (record,) = alone((Action.QUEUE, Category.SERVICE_AREA), (Action.SIT, Category.FURNITURE))
    for name in ("kiosk", "stand"):
        assert _chosen([[_wishing(record, name, "bench")]]) == [name, "bench"]
    assert _chosen([[_wishing(record, None, "throne")]])[1] == "bench"


def test_places_share_the_load_even_if_one_suits_everybody_better():
    liking = np.zeros((40, len(HALL.locations)))
    liking[:, HALL.locations.index(HALL["kiosk"])] = 0.3
    used = Counter(_chosen([alone((Action.OBJECT_INTERACT, Category.SERVICE_AREA))] * 40, affinity=liking))
    assert used["kiosk"] > used["stand"] >= 12


def test_people_take_the_nearer_of_two_places():
    two = environment(
        ("gate", Category.ENTRANCE, (0, 0), (3, 3)),
        ("near", Category.FURNITURE, (12, 0), (4, 1)),
        ("far", Category.FURNITURE, (400, 0), (4, 1)),
    )
    sitting = alone((Action.ENTER_EXIT, Category.ENTRANCE), (Action.SIT, Category.FURNITURE))
    assert all(_places(plan([sitting], two, seed))[1] == "near" for seed in range(20))


def test_every_category_has_a_stand_in_that_is_not_itself():
    assert set(SUBSTITUTES) == set(CATEGORIES)
    assert all(category not in others and len(set(others)) == len(others) for category, others in SUBSTITUTES.items())


def test_a_way_in_is_added_only_where_there_is_none_and_under_a_name_of_its_own():
    assert with_way_in(HALL) is HALL
    closed = Environment(tuple(p for p in HALL.locations if p.category is not Category.ENTRANCE))
    added = with_way_in(closed)
    assert added.locations[:-1] == closed.locations
    assert added.locations[-1].category is Category.ENTRANCE
    assert with_way_in(added) is added
    taken = environment((WAY_IN, Category.ROOM, (0, 0), (9, 9)), ("desk", Category.ITEM, (3, 0), (1, 1)))
    assert with_way_in(taken).locations[-1].name != WAY_IN
