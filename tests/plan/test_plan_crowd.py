"""What must hold of every plan."""

from __future__ import annotations

import itertools
from collections import defaultdict

import numpy as np
import pytest
from crowds import HALL, alone, authored, environment, plan

from genc.errors import LayoutError
from genc.plan.plan import CrowdPlan, begins_on_the_way
from genc.plan.seating import reach_m
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.corpus import load_corpus
from genc.scenario.record import Record, Step
from genc.words.vocabulary import Action, Category

TIGHT = "coffee-cart-monday"
"""Parties of several are served here close upon each other."""
SCENARIOS = [scenario for i, scenario in enumerate(load_corpus()) if i % 24 == 0 or scenario.slug == TIGHT]
PLANS = {scenario.slug: authored(scenario) for scenario in SCENARIOS}
EVERY = pytest.mark.parametrize("slug", PLANS)


def _named(made: CrowdPlan, activity) -> str:
    return made.environment.locations[activity.location].name


@EVERY
def test_rows_are_gapless_and_in_order(slug):
    for person in PLANS[slug][1].people:
        row = person.activities
        assert all(a.leave_s <= a.start_s <= a.end_s for a in row)
        assert all(after.leave_s == before.end_s for before, after in itertools.pairwise(row))


@EVERY
def test_every_step_of_every_record_is_planned_once(slug):
    rehearsal, made = PLANS[slug]
    for record, person in zip(rehearsal.records, made.people, strict=True):
        wanted = [activity for activity in person.activities if not activity.implied]
        assert [a.action for a in wanted] == [s.action for s in record.steps]
        assert [a.partners for a in wanted] == [s.partners for s in record.steps]
        assert [_named(made, a) for a in wanted] == [s.location for s in record.steps]


@EVERY
def test_partners_begin_together_and_share_their_occasion_with_nobody_else(slug):
    shared = defaultdict(list)
    for agent, person in enumerate(PLANS[slug][1].people):
        for activity in person.activities:
            shared[activity.occasion].append((agent, activity))
    for members in shared.values():
        agents = [agent for agent, _ in members]
        assert len({activity.start_s for _, activity in members}) == 1
        assert all({agent, *activity.partners} == set(agents) for agent, activity in members)


@EVERY
def test_nobody_shares_a_slot_and_every_slot_is_free_ground(slug):
    made = PLANS[slug][1]
    stays = defaultdict(list)
    for agent, person in enumerate(made.people):
        for activity in person.activities:
            if activity.action not in (Action.ENTER_EXIT, Action.QUEUE):
                stays[activity.slot.position_m].append((activity.start_s, activity.end_s, agent))
    assert Walkable.of(made.environment).free(list(stays)).all()
    for spans in stays.values():
        spans.sort()
        for (_, end_s, one), (start_s, _, other) in itertools.pairwise(spans):
            assert start_s >= end_s - 1e-6 or one == other


@EVERY
def test_walks_take_as_long_as_the_way_is(slug):
    made = PLANS[slug][1]
    ground = Walkable.of(made.environment)
    for person in made.people[::5]:
        for before, after in zip(person.activities[:-1], person.activities[1:], strict=True):
            way_m = ground.distances([before.slot.position_m], [after.slot.position_m])[0, 0]
            until_s = after.end_s if begins_on_the_way(before, after) else after.start_s
            assert until_s - after.leave_s >= way_m / person.speed_mps - 1e-6


@EVERY
def test_triggers_are_honoured(slug):
    rehearsal, made = PLANS[slug]
    begins, ends = defaultdict(lambda: np.inf), defaultdict(float)
    for record, person in zip(rehearsal.records, made.people, strict=True):
        wanted = [activity for activity in person.activities if not activity.implied]
        for step, activity in zip(record.steps, wanted, strict=True):
            begins[step.event] = min(begins[step.event], activity.start_s)
            ends[step.event] = max(ends[step.event], activity.end_s)
    for event, trigger in rehearsal.triggers.items():
        assert begins[event] >= ends[trigger] - 1e-6


@EVERY
def test_who_is_done_well_before_the_end_goes_home(slug):
    made = PLANS[slug][1]
    for person in made.people:
        last = person.activities[-1]
        if not person.leaves and last.end_s < made.duration_s:
            door_m = 200.0
            assert made.duration_s - last.end_s < door_m / person.speed_mps
        assert not person.leaves or last.action is Action.ENTER_EXIT


def test_the_same_seed_gives_the_same_plan_and_another_seed_another():
    scenario = SCENARIOS[2]
    assert authored(scenario)[1] == PLANS[scenario.slug][1]
    assert authored(scenario, seed=1)[1] != PLANS[scenario.slug][1]


BUYING = alone(
    (Action.ENTER_EXIT, Category.ENTRANCE),
    (Action.QUEUE, Category.SERVICE_AREA),
    (Action.OBJECT_INTERACT, Category.SERVICE_AREA),
)


def test_people_use_the_service_they_have_queued_at_one_after_the_other():
    made = plan([BUYING] * 30)
    places = places_of(made.environment, Walkable.of(made.environment))
    served = defaultdict(list)
    for person in made.people:
        queue, use = (
            next(a for a in person.activities if a.action is act) for act in (Action.QUEUE, Action.OBJECT_INTERACT)
        )
        assert queue.location == use.location
        assert use.start_s >= queue.end_s
        served[use.location].append((queue.start_s, use.start_s, use.end_s))
    assert len(served) == 2, "equal places share the load"
    for location, turns in served.items():
        turns.sort()
        starts = [start for _, start, _ in turns]
        assert starts == sorted(starts), "first come, first served"
        capacity = len(places[location].service)
        for _, start, _ in turns:
            assert sum(s <= start < e for _, s, e in turns) <= capacity


def test_who_works_at_a_service_takes_no_customers_turn():
    clerk = alone((Action.OBJECT_INTERACT, Category.SERVICE_AREA), (Action.WAIT, Category.SERVICE_AREA))
    made = plan([clerk])
    service = [s for place in places_of(HALL, Walkable.of(HALL)) for s in place.service]
    row = made.people[0].activities
    assert row[0].slot not in service
    assert not made.people[0].leaves
    assert row[-1].end_s == pytest.approx(600)


def test_friends_of_people_who_come_in_come_in_too():
    pair = [
        Record(0, (Step(0, Action.ENTER_EXIT, Category.ENTRANCE), Step(1, Action.MEET, Category.OUTDOOR_AREA, (1,)))),
        Record(1, (Step(1, Action.MEET, Category.OUTDOOR_AREA, (0,)),)),
    ]
    first, second = plan([pair]).people
    assert second.activities[0].implied
    assert second.activities[0].action is Action.ENTER_EXIT
    assert second.activities[1].start_s == first.activities[1].start_s


def test_who_would_be_early_stays_longer_at_what_they_did_before():
    pair = [
        Record(0, (Step(0, Action.SIT, Category.FURNITURE), Step(2, Action.MEET, Category.OUTDOOR_AREA, (1,)))),
        Record(
            1,
            (
                *(Step(1, Action.OBJECT_INTERACT, Category.OUTDOOR_AREA) for _ in range(4)),
                Step(2, Action.MEET, Category.OUTDOOR_AREA, (0,)),
            ),
        ),
    ]
    sits, meets = plan([pair]).people[0].activities[:2]
    way_m = Walkable.of(HALL).distances([sits.slot.position_m], [meets.slot.position_m])[0, 0]
    speed_mps = plan([pair]).people[0].speed_mps
    waited_s = meets.start_s - meets.leave_s - way_m / speed_mps
    assert waited_s == pytest.approx(0, abs=1e-6) or sits.end_s - sits.start_s > 240


def test_an_environment_without_an_entrance_gets_one_and_the_plan_says_so():
    layout = environment(("hall", Category.ROOM, (0, 0), (20, 10)), ("desk", Category.ITEM, (3, 0), (1, 1)))
    made = plan([BUYING], layout)
    assert made.environment.locations[-1].category is Category.ENTRANCE
    assert any("no entrance" in note for note in made.notes)
    assert any("no service area: item" in note for note in made.notes)


def test_an_environment_of_one_location_is_refused():
    with pytest.raises(LayoutError, match="at least one more"):
        plan([BUYING], environment(("gate", Category.ENTRANCE, (0, 0), (3, 3))))


def test_meaning_decides_between_equal_places():
    affinity = np.zeros((2, len(HALL.locations)))
    affinity[:, 2] = 1.0
    made = [plan([BUYING] * 2, seed=seed, affinity=affinity) for seed in range(20)]
    used = [_named(m, a) for m in made for p in m.people for a in p.activities if a.action is Action.OBJECT_INTERACT]
    assert used.count("stand") > 30


@EVERY
def test_partners_stand_near_each_other(slug):
    made = PLANS[slug][1]
    where = defaultdict(list)
    for person in made.people:
        for activity in person.activities:
            if activity.action not in (Action.QUEUE, Action.ENTER_EXIT, Action.WANDER, Action.CARRY):
                where[activity.occasion].append(np.array(activity.slot.position_m))
    shared = [slots for slots in where.values() if len(slots) > 1]
    far = [
        slots
        for slots in shared
        if any(min(np.linalg.norm(a - b) for b in slots if b is not a) > reach_m(len(slots)) + 1e-6 for a in slots)
    ]
    assert len(far) <= 0.06 * len(shared)


def test_some_carry_and_telephone_on_the_way():
    on_the_way = [
        after.action
        for _, made in PLANS.values()
        for person in made.people
        for before, after in itertools.pairwise(person.activities)
        if begins_on_the_way(before, after)
    ]
    assert {Action.CARRY, Action.TALK_ON_PHONE} == set(on_the_way)


@EVERY
def test_those_who_did_the_last_thing_together_leave_together(slug):
    for person in PLANS[slug][1].people:
        *_, before, last = person.activities if len(person.activities) > 1 else (None, *person.activities)
        if last.implied and last.action is Action.ENTER_EXIT and before is not None:
            assert set(last.partners) <= set(before.partners)
