"""Who is there, who comes when, and what people do with time that they have to spare."""

from __future__ import annotations

import math

import numpy as np
import pytest
from crowds import HALL, alone, environment, plan

from genc.plan.arrivals import Cast, Outline
from genc.plan.occasion import occasions_of
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.record import Record, Step
from genc.words.vocabulary import Action, Category

LAWN = Category.OUTDOOR_AREA
SITTING = alone((Action.SIT, Category.FURNITURE))
GROUND = Walkable.of(HALL)


def _outline(groups: list[list[Record]], lasts_s: list[float], stretch_s: float = 0.0, triggers=None) -> Outline:
    """An outline in which nobody has to walk."""
    occasions = occasions_of(groups)
    cast = Cast(occasions, [0] * len(occasions), triggers or {})
    return Outline(cast, lasts_s, [stretch_s] * len(occasions), np.zeros((1, 1)))


def _timetable(outline: Outline, duration_s: float = 600.0, staff=(), seed: int = 0):
    return outline.timetable(duration_s, staff, np.random.default_rng(seed))


def _meeting(*, enters: bool) -> list[Record]:
    """Person 0 does one thing and person 1 another; then they meet."""
    first = (Action.ENTER_EXIT, Category.ENTRANCE) if enters else (Action.SIT, LAWN)
    return [
        Record(0, (Step(0, *first), Step(2, Action.MEET, LAWN, (1,)))),
        Record(1, (Step(1, *first), Step(2, Action.MEET, LAWN, (0,)))),
    ]


def test_the_longer_a_group_stays_the_likelier_it_is_there_from_the_beginning():
    def share(lasts_s: float) -> float:
        comes_s = _timetable(_outline([SITTING] * 400, [lasts_s] * 400)).comes_s
        return sum(at_s is None for at_s in comes_s) / 400

    assert share(60.0) == pytest.approx(0.1, abs=0.06)
    assert share(300.0) == pytest.approx(0.5, abs=0.1)
    assert share(600.0) == 1.0


def test_who_comes_in_has_time_for_everything():
    comes_s = _timetable(_outline([SITTING] * 200, [150.0] * 200)).comes_s
    latest_s = max(at_s for at_s in comes_s if at_s is not None)
    assert 400 < latest_s <= 450


@pytest.mark.parametrize("seed", range(10))
def test_a_world_does_not_begin_empty(seed):
    comes_s = _timetable(_outline([SITTING], [10.0]), seed=seed).comes_s
    assert comes_s[0] in (None, 0.0)


def test_staff_are_there_from_the_beginning():
    assert _timetable(_outline([SITTING] * 50, [10.0] * 50), staff=range(50)).comes_s == [None] * 50


def test_who_would_come_too_early_comes_later():
    early, late = _timetable(_outline([_meeting(enters=True)], [3.0, 200.0, 10.0])).comes_s
    assert early - late == pytest.approx(197)


def test_who_is_there_takes_time_until_the_others_are_free():
    table = _timetable(_outline([_meeting(enters=False)], [10.0, 200.0, 10.0], stretch_s=500.0), duration_s=100.0)
    assert table.comes_s[1] is None
    assert table.comes_s[0] == pytest.approx(190), "nobody is there before there is something to do"

    stays = [
        Record(0, (Step(0, Action.SIT, LAWN), Step(1, Action.MEET, LAWN, (1,)), Step(3, Action.MEET, LAWN, (1,)))),
        Record(1, (Step(1, Action.MEET, LAWN, (0,)), Step(2, Action.SIT, LAWN), Step(3, Action.MEET, LAWN, (0,)))),
    ]
    table = _timetable(_outline([stays], [10.0, 20.0, 200.0, 5.0], stretch_s=500.0), duration_s=100.0)
    assert table.comes_s == [None, None]
    assert table.lasts_s == [10.0, 20.0, 200.0, 5.0], "what others wait for is not drawn out"


def test_a_solitary_doing_is_drawn_out_and_no_further_than_it_may_be():
    pair = [
        Record(0, tuple(Step(e, Action.SIT, LAWN, p) for e, p in ((0, (1,)), (1, ()), (3, (1,))))),
        Record(1, tuple(Step(e, Action.SIT, LAWN, p) for e, p in ((0, (0,)), (2, ()), (3, (0,))))),
    ]
    for stretch_s, expected_s in ((500.0, 100.0), (30.0, 40.0), (0.0, 10.0)):
        lasts_s = _timetable(_outline([pair], [5.0, 10.0, 100.0, 5.0], stretch_s)).lasts_s
        assert lasts_s == pytest.approx([5.0, expected_s, 100.0, 5.0])


def test_a_group_that_waits_for_another_comes_when_that_has_ended():
    groups = [[Record(0, (Step(0, Action.SIT, LAWN),))], [Record(0, (Step(1, Action.SIT, LAWN),))]]
    first, second = _timetable(_outline(groups, [250.0, 400.0], triggers={1: 0})).comes_s
    assert second == pytest.approx((first or 0.0) + 250, abs=1e-6)


def test_those_who_stay_behind_go_on_with_what_they_all_did():
    def step(event: int, action: Action, *partners: int, at: Category = LAWN) -> Step:
        return Step(event, action, at, partners)

    groups = [
        [
            Record(0, (step(0, Action.DISCUSS, 1, 2), step(2, Action.MEET, 1, 2))),
            Record(1, (step(0, Action.DISCUSS, 0, 2), step(2, Action.MEET, 0, 2))),
            Record(
                2,
                (
                    step(0, Action.DISCUSS, 0, 1),
                    *[step(1, Action.OBJECT_INTERACT, at=Category.SERVICE_AREA)] * 2,
                    step(2, Action.MEET, 0, 1),
                ),
            ),
        ]
    ]
    people = plan(groups).people
    for agent, other in ((0, 1), (1, 0)):
        row = [a for a in people[agent].activities if a.action is not Action.ENTER_EXIT]
        talk, on, meet = row[:3]
        assert on.implied
        assert (on.action, on.slot, on.partners) == (Action.DISCUSS, talk.slot, (other,))
        assert meet.start_s - meet.leave_s < 60


def test_staff_work_to_the_end_and_are_no_more_than_a_counter_needs():
    clerk = alone((Action.OBJECT_INTERACT, Category.SERVICE_AREA), (Action.CARRY, Category.SERVICE_AREA))
    made = plan([clerk] * 20)
    service = {slot for place in places_of(HALL, GROUND) for slot in place.service}
    at_work = [p for p in made.people if p.activities[0].slot not in service and p.activities[0].leave_s == 0.0]
    staying = [p for p in made.people if p.activities[-1].implied and not p.leaves]
    assert 1 <= len(staying) <= 4
    assert all(person in at_work for person in staying)
    assert all(p.activities[-1].action is Action.OBJECT_INTERACT for p in staying)
    assert all(p.activities[-1].end_s == pytest.approx(600) for p in staying)


def test_people_who_do_things_together_come_and_go_by_one_door():
    yard = environment(
        ("west gate", Category.ENTRANCE, (-20, 0), (3, 3)),
        ("east gate", Category.ENTRANCE, (20, 0), (3, 3)),
        ("yard", LAWN, (0, 0), (8, 30)),
    )
    party = [Record(i, (Step(0, Action.MEET, LAWN, tuple(j for j in range(12) if j != i)),)) for i in range(12)]
    for seed in range(6):
        people = plan([party], yard, seed, duration_s=2000.0).people
        for at in (0, -1):
            used = {p.activities[at].location for p in people if p.activities[at].action is Action.ENTER_EXIT}
            assert len(used) <= 1
    assert all(math.isfinite(p.activities[-1].end_s) for p in people)
