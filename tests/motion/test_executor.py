"""Single rules of carrying out a plan, on plans written by hand."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from small_world import (
    ARCH,
    BENCH,
    LAWN,
    LIBRARY,
    PLAZA,
    SPEED_MPS,
    VAN,
    Draft,
    at,
    done_by,
    ground,
    places,
    play,
)

from genc.motion.executor import Options, simulate
from genc.motion.kinematic import Kinematic
from genc.motion.motion import Status
from genc.plan.plan import Slot
from genc.words.vocabulary import Action

LEFT, RIGHT = at(16.0, 5.0), at(17.0, 5.0)
SERVED = places()[VAN].service[0]
LINE = places()[VAN].line


def frame_of(motion, time_s: float) -> int:
    return round(time_s / motion.dt_s)


# Meeting.


def test_early_ones_wait_for_the_late_and_all_begin_in_one_moment():
    plan = Draft(2).do([0], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 1.0, 4.0)
    plan = plan.do([1], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 30.0, 33.0)
    plan = plan.do([0, 1], Action.MEET, LAWN, [LEFT, RIGHT], 20.0, 30.0).plan()
    (_, early), (_, late) = done_by(play(plan), 0), done_by(play(plan), 1)
    assert early.arrive_s < 20 < late.arrive_s == early.start_s == late.start_s
    assert early.end_s - early.start_s == pytest.approx(10.0, abs=0.11)
    assert early.status is late.status is Status.DONE


def test_nothing_begins_before_the_plan_would_have_it():
    plan = Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0).do([0], Action.READ, LAWN, [RIGHT], 50.0, 60.0).plan()
    sits, reads = done_by(play(plan), 0)
    assert sits.start_s == 0.0
    assert reads.arrive_s < 7
    assert reads.start_s == pytest.approx(50.0, abs=0.11)


def test_who_does_not_come_is_waited_for_up_to_a_limit():
    plan = Draft(2).do([0], Action.WAIT, LAWN, [LEFT], 0.0, 5.0).do([1], Action.SIT, LAWN, [at(22.0, 5.0)], 0.0, 80.0)
    plan = plan.do([0, 1], Action.DISCUSS, LAWN, [LEFT, RIGHT], 10.0, 20.0).plan()
    motion = play(plan, options=Options(patience_s=30.0))
    patient, missing = done_by(motion, 0)[1], done_by(motion, 1)[1]
    assert patient.start_s == pytest.approx(40.0, abs=0.11)
    assert patient.end_s == pytest.approx(50.0, abs=0.21)
    assert missing.start_s == missing.end_s == missing.arrive_s > 80
    assert patient.status is missing.status is Status.TIMEOUT


def test_who_comes_late_to_a_doing_takes_part_in_what_is_left_of_it():
    plan = Draft(2).do([0], Action.WAIT, LAWN, [LEFT], 0.0, 5.0).do([1], Action.SIT, LAWN, [at(22.0, 5.0)], 0.0, 45.0)
    plan = plan.do([0, 1], Action.DISCUSS, LAWN, [LEFT, RIGHT], 10.0, 40.0).plan()
    motion = play(plan, options=Options(patience_s=20.0))
    patient, late = done_by(motion, 0)[1], done_by(motion, 1)[1]
    assert patient.start_s < late.start_s < late.end_s == patient.end_s


def test_a_slot_where_somebody_stands_is_not_taken_twice():
    plan = Draft(2).do([0], Action.SIT, LAWN, [LEFT], 0.0, 100.0)
    plan = plan.do([1], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 1.0, 4.0).do(
        [1], Action.SIT, LAWN, [LEFT], 20.0, 90.0
    )
    motion = play(plan.plan())
    first, second = done_by(motion, 0)[0], done_by(motion, 1)[1]
    assert first.position_m == LEFT.position_m
    assert 0.5 <= math.dist(second.position_m, LEFT.position_m) < 1.5
    assert second.facing_rad == LEFT.facing_rad


# Lines and services.


def queue_and_use(n: int, length_s: float) -> Draft:
    draft = Draft(n)
    for agent in range(n):
        draft.do([agent], Action.ENTER_EXIT, ARCH, [at(0.0, 9.0 + agent / 4)], 1.0 + 3 * agent, 2.0 + 3 * agent)
        draft.do([agent], Action.QUEUE, VAN, [LINE[agent]], 2.0 + 3 * agent, 4.0)
        draft.do([agent], Action.OBJECT_INTERACT, VAN, [SERVED], 4.0, 4.0 + length_s)
    return draft


def test_a_line_is_served_in_order_and_one_at_a_time():
    n, motion = 5, play(queue_and_use(5, 10.0).plan())
    queues, uses = [done_by(motion, a)[1] for a in range(n)], [done_by(motion, a)[2] for a in range(n)]
    assert sorted(range(n), key=lambda a: queues[a].arrive_s) == sorted(range(n), key=lambda a: uses[a].start_s)
    by_time = sorted(uses, key=lambda done: done.start_s)
    assert all(a.end_s <= b.start_s for a, b in pairwise(by_time))
    assert all(queue.end_s == use.leave_s for queue, use in zip(queues, uses, strict=True))
    assert all(done.status is Status.DONE for done in (*queues, *uses))
    assert all(math.dist(use.position_m, SERVED.position_m) < 0.01 for use in uses)


def test_nobody_lingers_at_a_free_counter():
    uses = sorted((done_by(play(queue_and_use(5, 10.0).plan()), a)[2] for a in range(5)), key=lambda done: done.start_s)
    gaps_s = [b.start_s - a.end_s for a, b in pairwise(uses)]
    assert max(gaps_s) < 3.0


def test_who_did_not_plan_to_queue_stands_in_line_while_the_counter_is_busy():
    draft = Draft(2).do([0], Action.OBJECT_INTERACT, VAN, [SERVED], 0.0, 40.0)
    draft.do([1], Action.WAIT, VAN, [at(20.0, 25.0)], 0.0, 2.0)
    plan = draft.do([1], Action.OBJECT_INTERACT, VAN, [SERVED], 4.0, 14.0).plan()
    motion = play(plan)
    first, second = done_by(motion, 0)[0], done_by(motion, 1)[1]
    assert second.arrive_s < 20 < first.end_s < second.start_s
    assert np.allclose(motion.positions_m[frame_of(motion, 20.0), 1], LINE[0].position_m, atol=0.01)


def test_friends_queue_together_and_go_to_the_counter_together():
    draft = Draft(3).do([2], Action.OBJECT_INTERACT, VAN, [SERVED], 0.0, 30.0)
    draft.do([0], Action.SIT, BENCH, [at(28.0, 13.0)], 0.0, 4.0).do([1], Action.SIT, LAWN, [at(15.0, 2.0)], 0.0, 4.0)
    draft.do([0, 1], Action.QUEUE, VAN, list(LINE[:2]), 8.0, 12.0)
    plan = draft.do([0, 1], Action.OBJECT_INTERACT, VAN, [SERVED, SERVED], 12.0, 22.0).plan()
    motion = play(plan)
    queues, uses = [done_by(motion, a)[1] for a in (0, 1)], [done_by(motion, a)[2] for a in (0, 1)]
    assert queues[0].start_s == queues[1].start_s == max(queue.arrive_s for queue in queues)
    assert queues[0].end_s == queues[1].end_s >= done_by(motion, 2)[0].end_s
    assert uses[0].start_s == uses[1].start_s
    assert math.dist(uses[0].position_m, uses[1].position_m) > 0.4


def test_who_waits_at_the_counter_for_a_friend_is_no_longer_in_line():
    """The served one is there first; the friend, who only stands beside, comes the long way round."""
    draft = Draft(3).do([0, 1], Action.QUEUE, VAN, list(LINE[:2]), 0.0, 2.0)
    draft.do([0, 1], Action.OBJECT_INTERACT, VAN, [SERVED, at(28.0, 20.0)], 2.0, 20.0)
    draft.do([0], Action.READ, LAWN, [LEFT], 40.0, 100.0)
    for k, start_s in enumerate((30.0, 50.0, 70.0)):  # the line goes on moving
        draft.do([2], Action.QUEUE, VAN, [LINE[0]], start_s, start_s + 1)
        draft.do([2], Action.SIT, BENCH, [at(28.0, 13.0)], start_s + 8, start_s + 9 + k)
    motion = play(draft.plan())
    reads = done_by(motion, 0)[2]
    assert reads.status is Status.DONE
    assert math.dist(reads.position_m, LEFT.position_m) < 0.1
    during = motion.positions_m[frame_of(motion, reads.start_s) : frame_of(motion, reads.end_s), 0]
    assert np.allclose(during, LEFT.position_m, atol=0.1)


def test_a_line_without_a_service_is_left_at_its_head():
    draft = Draft(2)
    for agent in (0, 1):
        draft.do([agent], Action.QUEUE, ARCH, [places()[ARCH].line[agent]], 0.0, 5.0)
        draft.do([agent], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 8.0, 10.0)
    motion = play(draft.plan(leaves=True))
    first, second = done_by(motion, 0)[0], done_by(motion, 1)[0]
    assert first.end_s == pytest.approx(5.0, abs=0.11)
    # The second first moves up to the head.
    assert first.end_s < second.end_s < first.end_s + 2.0


def test_who_wants_no_service_gives_up_a_line_that_does_not_move():
    draft = Draft(2).do([0], Action.QUEUE, VAN, [LINE[0]], 0.0, 100.0)
    plan = draft.do([1], Action.QUEUE, VAN, [LINE[1]], 0.0, 5.0).do([1], Action.SIT, LAWN, [LEFT], 20.0, 30.0).plan()
    motion = play(plan, options=Options(patience_in_line_s=20.0))
    gives_up, sits = done_by(motion, 1)
    assert gives_up.end_s == pytest.approx(25.0, abs=0.3)
    assert gives_up.status is Status.TIMEOUT
    assert sits.status is Status.DONE


def test_who_is_served_at_the_end_of_a_plan_makes_room():
    draft = Draft(2).do([0], Action.OBJECT_INTERACT, VAN, [SERVED], 0.0, 5.0)
    plan = draft.do([1], Action.QUEUE, VAN, [LINE[0]], 0.0, 3.0).do(
        [1], Action.OBJECT_INTERACT, VAN, [SERVED], 6.0, 9.0
    )
    motion = play(plan.plan())
    assert done_by(motion, 1)[1].status is Status.DONE
    assert all(math.dist(position_m, SERVED.position_m) > 0.4 for position_m in motion.positions_m[-1])


# Coming, going, doors.


def test_people_appear_and_vanish_at_their_times():
    plan = Draft(1).do([0], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 10.0, 13.0)
    motion = play(plan.do([0], Action.ENTER_EXIT, ARCH, [at(1.0, 10.0)], 20.0, 23.0).plan(leaves=True))
    there = np.flatnonzero(motion.present[:, 0]) * motion.dt_s
    assert (there[0], there[-1]) == (pytest.approx(10.0), pytest.approx(23.0, abs=0.25))
    assert np.all(motion.positions_m[: frame_of(motion, 10.0), 0] == (0.0, 10.0))


def test_who_does_not_leave_stays_to_the_end():
    motion = play(Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0).plan())
    assert motion.present.all()
    assert np.allclose(motion.positions_m[-1, 0], LEFT.position_m)


def test_who_goes_into_a_building_is_out_of_sight_until_they_go_elsewhere():
    door = places()[LIBRARY].door
    draft = Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0)
    draft.do([0], Action.ENTER_EXIT, LIBRARY, [door], 25.0, 28.0).do([0], Action.READ, LIBRARY, [door], 28.0, 50.0)
    motion = play(draft.do([0], Action.SIT, LAWN, [LEFT], 70.0, 80.0).plan())
    _, enters, reads, sits = done_by(motion, 0)
    hidden = np.flatnonzero(~motion.present[:, 0]) * motion.dt_s
    assert (hidden[0], hidden[-1]) == (pytest.approx(enters.start_s, abs=0.21), pytest.approx(reads.end_s, abs=0.21))
    assert np.allclose(motion.positions_m[frame_of(motion, sits.leave_s) + 1, 0], door.position_m, atol=0.6)


def test_a_building_is_left_by_going_through_its_door_again():
    door = places()[LIBRARY].door
    draft = Draft(1).do([0], Action.SIT, BENCH, [at(28.0, 13.0)], 0.0, 5.0)
    draft.do([0], Action.ENTER_EXIT, LIBRARY, [door], 20.0, 23.0)
    motion = play(draft.do([0], Action.ENTER_EXIT, LIBRARY, [door], 40.0, 43.0).plan())
    assert not motion.present[frame_of(motion, 30.0), 0]
    assert motion.present[frame_of(motion, 42.0), 0]


def test_a_life_may_begin_by_coming_out_of_a_building():
    draft = Draft(1).do([0], Action.ENTER_EXIT, LIBRARY, [places()[LIBRARY].door], 10.0, 13.0)
    motion = play(draft.do([0], Action.SIT, LAWN, [LEFT], 40.0, 50.0).plan())
    assert not motion.present[frame_of(motion, 9.0), 0]
    assert motion.present[frame_of(motion, 10.2) :, 0].all()


def test_friends_meet_inside_if_one_of_them_is_inside():
    door = places()[LIBRARY].door
    draft = Draft(2).do([0], Action.SIT, LAWN, [LEFT], 0.0, 2.0).do([1], Action.SIT, LAWN, [RIGHT], 0.0, 20.0)
    draft.do([0], Action.ENTER_EXIT, LIBRARY, [door], 22.0, 25.0)
    motion = play(draft.do([0, 1], Action.DISCUSS, LIBRARY, [door, door], 45.0, 60.0).plan())
    talk = done_by(motion, 1)[1]
    assert talk.status is Status.DONE
    assert not motion.present[frame_of(motion, talk.start_s) + 1].any()


# Wandering.


def test_who_wanders_moves_about_the_place_and_nowhere_else():
    plan = Draft(1).do([0], Action.WANDER, LAWN, [LEFT], 0.0, 100.0).plan()
    motion = play(plan)
    positions_m = motion.positions_m[:, 0]
    assert np.all((positions_m >= (14.0, 1.0)) & (positions_m <= (26.0, 9.0)))
    assert np.ptp(positions_m, axis=0).max() > 4.0
    assert np.allclose(positions_m[frame_of(motion, 100.0)], LEFT.position_m, atol=0.01)


def test_friends_wander_side_by_side():
    motion = play(Draft(2).do([0, 1], Action.WANDER, LAWN, [LEFT, RIGHT], 0.0, 100.0).plan())
    apart_m = np.linalg.norm(motion.positions_m[:, 0] - motion.positions_m[:, 1], axis=1)
    assert np.median(apart_m) < 1.5
    assert apart_m.max() < 4.0


def test_who_cannot_walk_through_a_thing_wanders_around_it():
    slot = places()[BENCH].spots[0]
    motion = play(Draft(1).do([0], Action.WANDER, BENCH, [slot], 0.0, 60.0).plan())
    off_m = np.abs(motion.positions_m[:, 0] - PLAZA.locations[BENCH].position_m)
    assert off_m.max() < 1.0 + 1.5 + 0.3
    assert ground().free(motion.positions_m[:, 0].astype(float)).mean() > 0.99


# The end of the world, and what cannot be helped.


def test_the_end_of_the_world_cuts_what_is_going_on():
    plan = Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 10.0).do([0], Action.WAIT, ARCH, [at(0.0, 10.0)], 25.0, 90.0)
    sits, waits = done_by(play(plan.plan(duration_s=30.0)), 0)
    assert (sits.status, waits.status) == (Status.DONE, Status.CUT)
    assert math.isnan(waits.end_s)
    assert not math.isnan(waits.start_s)
    (_, walks) = done_by(play(plan.plan(duration_s=12.0)), 0)
    assert math.isnan(walks.arrive_s)
    assert math.dist(walks.position_m, LEFT.position_m) < 12 * SPEED_MPS


def test_who_would_come_after_the_end_is_never_there():
    motion = play(Draft(1).do([0], Action.ENTER_EXIT, ARCH, [at(0.0, 10.0)], 50.0, 53.0).plan(duration_s=20.0))
    assert not motion.present.any()
    assert motion.executed == ()


class Stuck(Kinematic):
    """A steering whose people never get anywhere."""

    def step(self) -> None:
        pass


def test_a_way_that_is_lost_does_not_stop_a_life():
    draft = Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0).do([0], Action.READ, LAWN, [RIGHT], 7.0, 15.0)
    plan = draft.do([0], Action.WAIT, LAWN, [LEFT], 17.0, 20.0).plan(duration_s=300.0)
    motion = simulate(plan, ground(), places(), Stuck(1, ground()), Options(), np.random.default_rng(0))
    _, reads, waits = done_by(motion, 0)
    assert reads.status is Status.TIMEOUT
    assert reads.position_m == LEFT.position_m
    assert waits.status is Status.DONE


def test_a_person_with_nothing_to_do_is_no_obstacle():
    motion = play(Draft(2).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0).plan())
    assert motion.present[:, 0].all()
    assert not motion.present[:, 1].any()


# Frames.


def test_frames_are_evenly_spaced_from_the_beginning_to_the_end():
    plan = Draft(1).do([0], Action.SIT, LAWN, [LEFT], 0.0, 5.0).plan(duration_s=60.0)
    assert (play(plan).dt_s, len(play(plan).present)) == (0.2, 301)
    coarse = play(plan, options=Options(n_steps_a_frame=5))
    assert (coarse.dt_s, len(coarse.present)) == (0.5, 121)


def test_people_face_their_slot_when_they_stand_and_their_way_when_they_walk():
    slot = Slot((16.0, 5.0), -2.0)
    plan = Draft(1).do([0], Action.WAIT, LAWN, [at(24.0, 5.0)], 0.0, 2.0).do([0], Action.SIT, LAWN, [slot], 15.0, 20.0)
    motion = play(plan.plan())
    assert motion.headings_rad[0, 0] == 0.0
    assert abs(motion.headings_rad[frame_of(motion, 5.0), 0]) == pytest.approx(np.pi, abs=1e-3)
    assert motion.headings_rad[-1, 0] == pytest.approx(-2.0, abs=1e-4)
    turns = np.abs(np.angle(np.exp(1j * np.diff(motion.headings_rad[:, 0]))))
    assert turns.max() <= 2 * np.pi * motion.dt_s + 1e-4
