"""What every `Steering` must do; a new implementation joins `STEERINGS`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from genc.motion.jupedsim_steering import JuPedSim
from genc.motion.kinematic import Kinematic
from genc.motion.steering import Steering, Target
from genc.plan.walkable import Walkable

WALL = Walkable(np.array([[4.0, -5.0, 6.0, 5.0]]), (-20.0, -20.0, 20.0, 20.0))
SPEED_MPS = 1.3

STEERINGS: dict[str, Callable[[int], Steering]] = {
    "kinematic": lambda n: Kinematic(n, WALL),
    "jupedsim": lambda n: JuPedSim(n, WALL),
}


@pytest.fixture(params=sorted(STEERINGS))
def make(request) -> Callable[[int], Steering]:
    return STEERINGS[request.param]


def walk(steering: Steering, agent: int, most_s: float = 60.0) -> list[np.ndarray]:
    """Steps until an agent has arrived; its positions on the way."""
    trace = [steering.positions_m[agent].copy()]
    while steering.walking[agent]:
        steering.step()
        trace.append(steering.positions_m[agent].copy())
        assert len(trace) * steering.dt_s < most_s, "never arrived"
    return trace


def test_arrays_have_one_entry_for_each_agent(make):
    steering = make(3)
    assert steering.positions_m.shape == (3, 2)
    assert steering.headings_rad.shape == steering.walking.shape == (3,)


def test_who_is_added_stands_there_until_sent(make):
    steering = make(2)
    steering.add(1, (2.0, 3.0), SPEED_MPS)
    for _ in range(20):
        steering.step()
    assert np.allclose(steering.positions_m[1], (2.0, 3.0), atol=1e-6)
    assert not steering.walking[1]


def test_who_is_sent_arrives_at_the_target_and_stands_still(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((3.0, 8.0)))
    assert steering.walking[0]
    walk(steering, 0)
    assert np.linalg.norm(steering.positions_m[0] - (3.0, 8.0)) < 0.3
    still = steering.positions_m[0].copy()
    for _ in range(20):
        steering.step()
    assert np.array_equal(steering.positions_m[0], still)


def test_nobody_is_faster_than_their_speed_nor_much_slower(make):
    steering = make(1)
    steering.add(0, (-8.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((2.0, 0.0)))
    trace = walk(steering, 0)
    steps_m = np.linalg.norm(np.diff(trace, axis=0), axis=1)
    assert steps_m.max() <= SPEED_MPS * steering.dt_s * 1.05
    assert len(steps_m) * steering.dt_s < 1.5 * 10.0 / SPEED_MPS


def test_a_pace_slows_down_one_walk_only(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((0.0, 4.0), pace=0.5))
    slow = len(walk(steering, 0))
    steering.set_target(0, Target((0.0, 0.0)))
    assert slow > 1.6 * len(walk(steering, 0))


def test_the_way_leads_round_obstacles(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((10.0, 0.0)))
    trace = np.array(walk(steering, 0))
    assert np.linalg.norm(trace[-1] - (10.0, 0.0)) < 0.3
    inside = (trace > (4.0, -5.0)).all(axis=1) & (trace < (6.0, 5.0)).all(axis=1)
    assert not inside.any()


def test_walkers_face_where_they_walk(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((0.0, 5.0)))
    for _ in range(10):
        steering.step()
    assert steering.headings_rad[0] == pytest.approx(np.pi / 2, abs=0.2)


def test_a_new_target_replaces_the_old_one_on_the_way(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((3.0, 0.0)))
    for _ in range(5):
        steering.step()
    steering.set_target(0, Target((-5.0, 0.0)))
    walk(steering, 0)
    assert np.linalg.norm(steering.positions_m[0] - (-5.0, 0.0)) < 0.3


def test_who_is_held_stops_where_they_are(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((3.0, 0.0)))
    for _ in range(5):
        steering.step()
    steering.hold(0)
    held = steering.positions_m[0].copy()
    steering.step()
    assert not steering.walking[0]
    assert np.allclose(steering.positions_m[0], held, atol=1e-6)


def test_a_target_on_a_footprint_stands_for_ground_beside_it(make):
    steering = make(1)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((4.3, 0.0)))
    walk(steering, 0)
    assert WALL.free(steering.positions_m[:1])[0]
    assert steering.positions_m[0, 0] == pytest.approx(4.0 - 0.25, abs=0.35)


def test_who_is_removed_can_be_added_elsewhere(make):
    steering = make(2)
    steering.add(0, (0.0, 0.0), SPEED_MPS)
    steering.set_target(0, Target((3.0, 0.0)))
    steering.step()
    steering.remove(0)
    assert not steering.walking[0]
    steering.step()
    steering.add(0, (-9.0, -9.0), SPEED_MPS)
    steering.step()
    assert np.allclose(steering.positions_m[0], (-9.0, -9.0), atol=1e-6)


def test_who_is_where_they_are_sent_arrives_soon(make):
    steering = make(1)
    steering.add(0, (1.0, 1.0), SPEED_MPS)
    steering.set_target(0, Target((1.0, 1.0)))
    assert len(walk(steering, 0)) <= 3


def test_equal_orders_give_equal_ways(make):
    traces = []
    for _ in range(2):
        steering = make(2)
        steering.add(0, (0.0, 0.0), SPEED_MPS)
        steering.add(1, (10.0, 0.3), SPEED_MPS)
        steering.set_target(0, Target((10.0, 0.0)))
        steering.set_target(1, Target((0.0, 0.0)))
        traces.append(np.array(walk(steering, 0)))
    assert np.array_equal(*traces)
