from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from small_world import ground

from genc.motion.kinematic import Kinematic
from genc.motion.steering import Target

points = st.tuples(st.floats(-3.0, 44.0), st.floats(0.0, 25.0))


def is_inside(point_m: np.ndarray) -> bool:
    low_m, high_m = ground().obstacles_m[:, :2], ground().obstacles_m[:, 2:]
    return bool(((point_m > low_m) & (point_m < high_m)).all(axis=1).any())


@given(points, points, st.floats(0.8, 1.8))
def test_a_walk_takes_as_long_as_its_shortest_path(start_m, goal_m, speed_mps):
    start, goal = ground().snap([start_m, goal_m])
    steering = Kinematic(1, ground())
    steering.add(0, (start[0], start[1]), speed_mps)
    steering.set_target(0, Target((goal[0], goal[1])))
    n_steps = 0
    while steering.walking[0]:
        before = steering.positions_m[0].copy()
        steering.step()
        n_steps += 1
        assert np.linalg.norm(steering.positions_m[0] - before) <= speed_mps * steering.dt_s + 1e-9
        assert not is_inside(steering.positions_m[0])
    legs = np.diff(ground().path(start, goal), axis=0)
    least = np.linalg.norm(legs, axis=1).sum() / speed_mps / steering.dt_s
    assert np.array_equal(steering.positions_m[0], goal)
    assert least - 1e-6 <= n_steps <= least + 1 + 1e-6


def test_many_walk_at_once_and_all_arrive():
    rng = np.random.default_rng(0)
    n = 300
    starts, goals = (
        ground().snap(rng.uniform((-2, 0), (44, 25), (n, 2))),
        ground().snap(rng.uniform((-2, 0), (44, 25), (n, 2))),
    )
    steering = Kinematic(n, ground())
    for agent in range(n):
        steering.add(agent, tuple(starts[agent]), 1.3)
        steering.set_target(agent, Target(tuple(goals[agent])))
    for _ in range(1000):
        steering.step()
    assert not steering.walking.any()
    assert np.allclose(steering.positions_m, goals)
