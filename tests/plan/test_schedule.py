"""Turns and seats, and what they make of people's time."""

from __future__ import annotations

import itertools
import math
from collections import defaultdict

import numpy as np
from crowds import HALL, alone, plan
from hypothesis import given
from hypothesis import strategies as st

from genc.plan.seating import ELBOW_M, Seating
from genc.plan.services import Services
from genc.plan.slots import places_of
from genc.plan.venue import Venue
from genc.plan.walkable import Walkable
from genc.scenario.record import Record, Step
from genc.words.vocabulary import Action, Category

GROUND = Walkable.of(HALL)
PLACES = places_of(HALL, GROUND)
KIOSK = HALL.locations.index(HALL["kiosk"])
CUSTOMERS = st.lists(st.tuples(st.floats(0, 60), st.floats(1, 90)), min_size=1, max_size=25)


@given(CUSTOMERS)
def test_turns_come_in_order_and_no_server_has_two_at_a_time(customers):
    services = Services(PLACES)
    now_s, turns = 0.0, []
    for number, (pause_s, lasts_s) in enumerate(customers):
        now_s += pause_s
        turn = services.turn(number, KIOSK, now_s, lasts_s)
        assert turn.start_s >= now_s
        assert services.turn(number, KIOSK, now_s + 99, lasts_s) == turn, "asked again, the same turn"
        turns.append((turn, lasts_s))
    busy = defaultdict(list)
    for turn, lasts_s in turns:
        busy[turn.server].append((turn.start_s, turn.start_s + lasts_s))
    assert len(busy) <= len(PLACES[KIOSK].service)
    for spans in busy.values():
        assert all(end_s <= start_s for (_, end_s), (start_s, _) in itertools.pairwise(spans))


@given(st.integers(2, 12))
def test_people_in_a_line_stand_behind_each_other_and_it_closes_up(n):
    services = Services(PLACES)
    for i in range(n):
        (slot,) = services.line(KIOSK, 1, 0.0)
        assert slot == PLACES[KIOSK].line[i]
        services.stand(KIOSK, 1, 0.0, 10.0 + i)
    assert services.line(KIOSK, 1, 10.5) == [PLACES[KIOSK].line[n - 1]]
    assert services.line(KIOSK, 1, 1000.0) == [PLACES[KIOSK].line[0]]


def test_who_stands_in_line_for_nothing_in_particular_stands_until_they_are_at_its_head():
    services = Services(PLACES)
    assert services.head_s(KIOSK, 5.0) == 5.0
    services.stand(KIOSK, 2, 0.0, 90.0)
    assert services.head_s(KIOSK, 5.0) == 90.0


@given(st.lists(st.tuples(st.integers(0, len(PLACES) - 1), st.integers(1, 5)), max_size=12), st.integers(0, 99))
def test_nobody_is_seated_within_an_arms_length_of_somebody(parties, seed):
    seating = Seating(Venue(HALL, PLACES, GROUND), np.random.default_rng(seed))
    held = [seat for location, n in parties for seat in seating.around(location, n, 0.0)]
    points = [seat.slot.position_m for seat in held]
    assert all(math.dist(a, b) >= ELBOW_M - 1e-9 for a, b in itertools.combinations(points, 2))
    assert GROUND.free(points).all()


def test_a_seat_is_free_again_when_its_time_is_over():
    seating = Seating(Venue(HALL, PLACES, GROUND), np.random.default_rng(0))
    seat = seating.any_spot(KIOSK, 0.0)
    assert not seating.is_free(seat.slot.position_m, 1e6)
    seat.until_s = 40.0
    assert not seating.is_free(seat.slot.position_m, 39.0)
    assert seating.is_free(seat.slot.position_m, 40.0)


def test_a_group_walks_at_one_speed_and_at_one_that_people_walk_at():
    pair = [
        Record(0, (Step(0, Action.MEET, Category.OUTDOOR_AREA, (1,)),)),
        Record(1, (Step(0, Action.MEET, Category.OUTDOOR_AREA, (0,)),)),
    ]
    people = plan([pair] * 50).people
    speeds = {person.group: set() for person in people}
    for person in people:
        speeds[person.group].add(person.speed_mps)
    assert all(len(of_group) == 1 for of_group in speeds.values())
    drawn_mps = np.array([min(of_group) for of_group in speeds.values()])
    assert ((drawn_mps >= 0.8) & (drawn_mps <= 1.8)).all()
    assert 1.15 < drawn_mps.mean() < 1.45


def test_people_come_in_one_group_after_another_and_leave_again():
    stroll = alone((Action.ENTER_EXIT, Category.ENTRANCE), (Action.WANDER, Category.OUTDOOR_AREA))
    people = plan([stroll] * 60).people
    begins_s = sorted(person.activities[0].leave_s for person in people)
    assert len(set(begins_s)) == 60
    assert begins_s[0] < 120
    assert begins_s[-1] > 240
    for person in people:
        last = person.activities[-1]
        assert person.leaves or last.end_s >= 600
        assert not person.leaves or (last.action is Action.ENTER_EXIT and last.implied)


def test_those_who_talk_face_each_other_and_stand_close():
    talk = [
        Record(i, (Step(0, Action.DISCUSS, Category.OUTDOOR_AREA, tuple(j for j in range(4) if j != i)),))
        for i in range(4)
    ]
    for seed in range(5):
        people = plan([talk], seed=seed).people
        slots = [next(a.slot for a in person.activities if a.action is Action.DISCUSS) for person in people]
        middle = np.mean([slot.position_m for slot in slots], axis=0)
        for slot in slots:
            away = middle - slot.position_m
            assert np.linalg.norm(away) < 3.0
            off_rad = math.atan2(away[1], away[0]) - slot.facing_rad
            assert abs(math.remainder(off_rad, 2 * math.pi)) < math.pi / 3
