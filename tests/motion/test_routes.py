from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.motion.routes import Order, find_routes
from genc.motion.steering import Target
from genc.plan.ground import ground_polygon, on_ground
from genc.plan.walkable import Walkable

WALL = Walkable(np.array([[10.0, -5.0, 12.0, 5.0]]), (-20.0, -20.0, 40.0, 20.0))
GROUND = ground_polygon(WALL)
FIELD = Walkable(np.empty((0, 4)), (-20.0, -20.0, 60.0, 20.0))


def orders(n: int, goal_m: tuple[float, float], company: object = "party") -> list[Order]:
    """n people in a row who go to another row."""
    x_m, y_m = goal_m
    return [
        Order(i, (0.0, 0.8 * i), Target((x_m, y_m + 0.8 * i), company=company), 1.3 + 0.01 * (i % 2)) for i in range(n)
    ]


def at(route, time_s: float) -> np.ndarray:
    """Where somebody on a route is at a time."""
    times_s = np.concatenate([[0.0], np.cumsum(route.durations_s)])
    return np.array([np.interp(time_s, times_s, route.points_m[:, axis]) for axis in (0, 1)])


@given(st.integers(1, 9), st.floats(-15, 35), st.floats(-15, 5))
def test_everybody_gets_from_start_to_goal_clear_of_the_footprints(n, x_m, y_m):
    asked = orders(n, (x_m, y_m))
    routes = find_routes(WALL, asked)
    assert sorted(routes) == list(range(n))
    for order in asked:
        route = routes[order.agent]
        assert np.allclose(route.points_m[0], order.start_m)
        assert np.allclose(route.points_m[-1], WALL.snap(order.target.point_m)[0])
        assert route.speeds_mps.max() <= order.speed_mps + 1e-9
        times_s = np.linspace(0, route.durations_s.sum(), 80)
        assert on_ground(GROUND, [at(route, time_s) for time_s in times_s]).all()


def test_two_walk_side_by_side_at_one_speed():
    routes = find_routes(FIELD, orders(2, (40.0, 6.0)))
    for time_s in np.arange(3.0, 27.0, 0.5):
        apart_m = np.linalg.norm(at(routes[0], time_s) - at(routes[1], time_s))
        assert apart_m == pytest.approx(0.75, abs=0.06)
    assert routes[0].durations_s.sum() == pytest.approx(routes[1].durations_s.sum(), rel=0.02)


def test_a_class_walks_in_rows_and_keeps_together_round_a_corner():
    routes = find_routes(WALL, orders(9, (22.0, -4.0)))
    for time_s in np.arange(3.0, 14.0, 0.5):
        where_m = np.array([at(routes[i], time_s) for i in range(9)])
        assert np.linalg.norm(where_m - where_m.mean(axis=0), axis=1).max() < 4.5


def test_who_has_no_company_takes_the_shortest_way_at_full_speed():
    asked = orders(3, (20.0, 0.0), None)
    found = find_routes(WALL, asked).values()
    for order, route in zip(asked, found, strict=True):
        shortest_m = WALL.path(order.start_m, order.target.point_m)
        assert np.allclose(route.points_m, shortest_m)
        assert np.allclose(route.speeds_mps, order.speed_mps)
