from __future__ import annotations

import math

import numpy as np
import odd_worlds
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from genc.words.vocabulary import ACTION_INDEX
from genc.world.export.actions import ACTION_NAMES, NO_ACTION, PHASES, changes, doings
from genc.world.export.keyframes import ERROR_M, ERROR_RAD, kept_points, stays

# What people are doing at every frame.


def _by_hand(world, agent: int, t_s: float) -> tuple[int, str]:
    """The row and the phase by looking at every row in turn."""
    row, phase = -1, "walk"
    for i, done in enumerate(world.motion.executed):
        if done.agent == agent:
            moments = (done.leave_s, "walk"), (done.arrive_s, "wait"), (done.start_s, "do"), (done.end_s, "wait")
            for moment_s, begins in moments:
                if not math.isnan(moment_s) and moment_s <= t_s + 1e-6:
                    row, phase = i, begins
    return row, phase


def _check(world, agents, frames) -> None:
    found = doings(world)
    for agent in agents:
        for frame in frames:
            row, phase = _by_hand(world, agent, frame * world.motion.dt_s)
            assert (found.row[frame, agent], PHASES[found.phase[frame, agent]]) == (row, phase), (agent, frame)


def test_doings_are_those_of_the_activity_table(world):
    n_frames, n_agents = world.motion.present.shape
    _check(world, range(n_agents), range(0, n_frames, 37))


def test_doings_of_rare_lives():
    world = odd_worlds.rare()
    _check(world, range(5), range(odd_worlds.N_FRAMES))
    found = doings(world)
    assert (found.action[:, 2] == NO_ACTION).all()
    assert ACTION_NAMES[found.action[20, 3]] == "enter/exit"
    assert not doings(odd_worlds.nobody()).row.size


def test_everybody_in_the_scene_is_at_something_of_their_own_plan(world):
    found, present = doings(world), world.motion.present
    assert (found.row[present] >= 0).all()
    owner = np.array([done.agent for done in world.motion.executed])
    actions = [world.plan.people[e.agent].activities[e.step].action for e in world.motion.executed]
    for agent in range(present.shape[1]):
        rows = found.row[present[:, agent], agent]
        assert (owner[rows] == agent).all()
        assert (np.diff(rows) >= 0).all()
        assert [ACTION_INDEX[actions[row]] for row in rows] == found.action[present[:, agent], agent].tolist()


def test_who_does_a_thing_stands_and_who_walks_moves(world):
    found, motion = doings(world), world.motion
    speed_mps = np.linalg.norm(np.diff(motion.positions_m, axis=0), axis=2) / motion.dt_s
    steady = motion.present[1:] & motion.present[:-1] & (found.row[1:] == found.row[:-1])
    steady &= found.phase[1:] == found.phase[:-1]
    sits = steady & (found.action[1:] == ACTION_INDEX["sit"])
    assert np.median(speed_mps[sits & (found.phase[1:] == PHASES.index("do"))]) == 0
    assert np.median(speed_mps[steady & (found.phase[1:] == PHASES.index("walk"))]) > 0.8


def test_changes_are_where_something_differs():
    assert changes(np.array([3, 3, 4, 4, 3])).tolist() == [0, 2, 4]
    assert changes(np.array([[1, 2], [1, 2], [1, 3]])).tolist() == [0, 2]
    assert changes(np.zeros((0, 4))).tolist() == []
    assert changes(np.zeros((3, 0))).tolist() == [0]


# Keyframes.


@given(arrays(np.float64, st.tuples(st.integers(1, 60), st.just(3)), elements=st.floats(-20, 20)))
def test_no_kept_path_is_off_by_more_than_was_said(points):
    kept = kept_points(points)
    assert kept[0] == 0
    assert kept[-1] == len(points) - 1
    found = np.column_stack([np.interp(np.arange(len(points)), kept, points[kept, i]) for i in range(3)])
    assert np.hypot(*(found - points)[:, :2].T).max() <= 1 + 1e-9
    assert np.abs(found - points)[:, 2].max() <= 1 + 1e-9


def test_a_straight_walk_is_two_keyframes_and_a_stop_is_kept():
    walk = np.column_stack([np.linspace(0, 900, 50), np.linspace(0, 450, 50), np.zeros(50)])
    assert kept_points(walk).tolist() == [0, 49]
    stop = np.concatenate([walk, np.repeat(walk[-1:], 30, axis=0)])
    assert kept_points(stop).tolist() == [0, 49, 79]


def test_stays_are_the_times_in_the_scene_and_close_to_the_frames(world):
    motion, n_frames = world.motion, 0
    for agent in range(motion.present.shape[1]):
        seen = np.zeros(len(motion.present), dtype=bool)
        for stay in stays(motion, agent):
            frames = np.arange(stay.frames[0], stay.frames[-1] + 1)
            seen[frames] = True
            n_frames += len(stay.frames)
            at_m = np.column_stack([np.interp(frames, stay.frames, stay.positions_m[:, i]) for i in range(2)])
            assert np.linalg.norm(at_m - motion.positions_m[frames, agent], axis=1).max() < ERROR_M + 2e-4
            off_rad = np.interp(frames, stay.frames, stay.headings_rad) - motion.headings_rad[frames, agent]
            assert np.abs((off_rad + np.pi) % (2 * np.pi) - np.pi).max() < ERROR_RAD + 2e-5
        assert np.array_equal(seen, motion.present[:, agent])
    assert n_frames < 0.15 * motion.present.sum()


def test_stays_of_rare_lives():
    motion = odd_worlds.rare().motion
    assert [len(stays(motion, agent)) for agent in range(5)] == [1, 1, 0, 2, 1]
    (turning,) = stays(motion, 0)
    frames = np.arange(turning.frames[0], turning.frames[-1] + 1)
    every_rad = np.interp(frames, turning.frames, turning.headings_rad)
    assert np.diff(every_rad) == pytest.approx(1.1 * odd_worlds.DT_S, abs=2 * ERROR_RAD)  # no jump at pi
    assert every_rad[-1] - every_rad[0] > 4 * np.pi
    (moment,) = stays(motion, 1)
    assert moment.frames.tolist() == [17]
