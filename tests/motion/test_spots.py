from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from small_world import VAN, at, ground, places

from genc.motion.spots import Spots


@given(st.lists(st.tuples(st.floats(14.0, 18.0), st.floats(2.0, 6.0)), min_size=1, max_size=25))
def test_nobody_is_given_ground_on_which_somebody_stands(wishes):
    spots = Spots(len(wishes), ground(), [])
    taken = [spots.take(agent, at(*wish)).position_m for agent, wish in enumerate(wishes)]
    assert ground().free(np.array(taken)).all()
    assert all(math.dist(a, b) >= 0.5 for i, a in enumerate(taken) for b in taken[i + 1 :])


def test_what_is_given_back_can_be_taken_again():
    spots = Spots(2, ground(), [])
    wish = at(16.0, 5.0)
    assert spots.take(0, wish) is wish
    assert spots.take(1, wish) is not wish
    spots.give_back(0)
    assert spots.take(1, wish) is wish


def test_service_slots_are_kept_free():
    spots = Spots(1, ground(), places()[VAN].service)
    given_m = spots.take(0, places()[VAN].service[0]).position_m
    assert all(math.dist(given_m, slot.position_m) >= 0.5 for slot in places()[VAN].service)


def test_a_crowd_at_one_slot_finds_room_around_it():
    line = places()[VAN].line
    spots = Spots(60, ground(), ())
    spots.hold(0, line[-1])
    points_m = np.array([line[-1].position_m, *(spots.take(agent, line[-1]).position_m for agent in range(1, 60))])
    assert ground().free(points_m).all()
    apart_m = np.linalg.norm(points_m[:, None] - points_m, axis=2) + 9 * np.eye(len(points_m))
    assert apart_m.min() >= 0.5
