"""Worlds in which people walk round each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial import KDTree
from test_authored_motion import planned

from genc.motion.executor import Options, simulate
from genc.motion.jupedsim_steering import JuPedSim
from genc.motion.motion import Status
from genc.motion.steering import Target
from genc.plan.ground import ground_polygon, on_ground
from genc.plan.plan import ON_THE_WAY, ROAMING
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.corpus import load_corpus
from genc.words.vocabulary import Action

FIELD = Walkable(np.empty((0, 4)), (-20.0, -20.0, 20.0, 20.0))
THEMES = ("train station", "hospital")


def play(plan):
    ground = Walkable.of(plan.environment)
    steering = JuPedSim(len(plan.people), ground)
    places = places_of(plan.environment, ground)
    return simulate(plan, ground, places, steering, Options(), np.random.default_rng(0))


@pytest.fixture(scope="module", params=THEMES)
def played(request):
    scenarios = load_corpus([request.param])
    plan = planned(scenarios[len(scenarios) // 2], 300.0)
    return plan, play(plan)


def test_nobody_is_ever_off_the_ground(played):
    plan, motion = played
    ground = ground_polygon(Walkable.of(plan.environment))
    assert on_ground(ground, motion.positions_m[motion.present]).all()


def test_bodies_hardly_ever_overlap(played):
    _, motion = played
    n_overlap = n_seen = 0
    for positions_m, present in zip(motion.positions_m, motion.present, strict=True):
        n_seen += int(present.sum())
        if present.any():
            n_overlap += len(np.unique(KDTree(positions_m[present]).query_pairs(0.3, output_type="ndarray")))
    assert n_overlap < 0.01 * n_seen


def test_nobody_jumps_or_runs(played):
    _, motion = played
    steps_m = np.linalg.norm(np.diff(motion.positions_m, axis=0), axis=2)
    assert (steps_m[motion.present[1:] & motion.present[:-1]] / motion.dt_s).max() < 2.4


def test_hardly_anything_is_given_up(played):
    _, motion = played
    timeouts = sum(done.status is Status.TIMEOUT for done in motion.executed)
    assert timeouts <= 0.01 * len(motion.executed)


def test_everything_is_done_where_it_was_planned_or_close_by(played):
    plan, motion = played
    for done in motion.executed:
        activity = plan.people[done.agent].activities[done.step]
        if done.status is Status.DONE and activity.action not in (Action.QUEUE, *ROAMING, *ON_THE_WAY):
            assert math.dist(done.position_m, activity.slot.position_m) < 8.0, (done, activity)


def test_no_position_is_on_an_edge_of_the_ground_when_written_to_the_centimetre(played):
    plan, motion = played
    positions_m = np.round(motion.positions_m[motion.present].astype(float), 2)
    assert on_ground(ground_polygon(Walkable.of(plan.environment)), positions_m).all()


def test_the_same_plan_gives_the_same_motion(played):
    plan, motion = played
    again = play(plan)
    assert np.array_equal(motion.positions_m, again.positions_m)
    assert motion.executed == again.executed


def walk(steering: JuPedSim, agents, most_s: float = 90.0) -> np.ndarray:
    """`[step, agent, 2]`, until these have arrived."""
    trace = [steering.positions_m.copy()]
    while steering.walking[agents].any():
        steering.step()
        trace.append(steering.positions_m.copy())
        assert len(trace) * steering.dt_s < most_s, "never arrived"
    return np.array(trace)


def test_two_who_meet_head_on_pass_each_other_without_touching():
    steering = JuPedSim(2, FIELD)
    for agent, x_m in enumerate((-5.0, 5.0)):
        steering.add(agent, (x_m, 0.0), 1.3)
        steering.set_target(agent, Target((-x_m, 0.0)))
    trace = walk(steering, [0, 1], 20.0)
    assert np.linalg.norm(trace[:, 0] - trace[:, 1], axis=1).min() > 0.38


def test_a_row_of_people_who_stand_is_squeezed_through():
    n_standing = 41
    steering = JuPedSim(n_standing + 1, FIELD)
    for i in range(n_standing):
        steering.add(i, (0.0, 0.75 * (i - n_standing // 2)), 1.3)
    steering.add(n_standing, (-4.0, 0.0), 1.3)
    steering.set_target(n_standing, Target((4.0, 0.0)))
    trace = walk(steering, [n_standing], 30.0)
    assert np.allclose(trace[0, :n_standing], trace[-1, :n_standing]), "who stands is not pushed"


def test_who_comes_where_somebody_stands_is_there_and_walks_on():
    steering = JuPedSim(2, FIELD)
    for agent in (0, 1):
        steering.add(agent, (1.0, 1.0), 1.3)
    steering.step()
    assert np.allclose(steering.positions_m, (1.0, 1.0))
    steering.set_target(1, Target((9.0, 1.0)))
    assert np.allclose(walk(steering, [1])[-1, 1], (9.0, 1.0), atol=0.06)


def test_two_who_walk_together_stay_together_among_others():
    steering = JuPedSim(22, FIELD)
    rng = np.random.default_rng(0)
    for agent in range(2, 22):
        x_m, y_m = rng.uniform((-10, -8), (10, 8)).tolist()
        steering.add(agent, (x_m, y_m), 1.3)
    for agent in (0, 1):
        steering.add(agent, (-18.0, 0.8 * agent), 1.3)
        steering.set_target(agent, Target((18.0, 0.8 * agent), company="friends"))
    trace = walk(steering, [0, 1])
    apart_m = np.linalg.norm(trace[:, 0] - trace[:, 1], axis=1)
    assert np.median(apart_m) < 1.2
    assert apart_m.max() < 3.0
