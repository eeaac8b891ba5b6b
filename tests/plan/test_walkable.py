from __future__ import annotations

import itertools

import numpy as np
import pytest
from crowds import HALL, environment
from hypothesis import given
from hypothesis import strategies as st

from genc.plan.walkable import BODY_RADIUS_M, Walkable, is_solid
from genc.scenario.corpus import load_corpus
from genc.words.vocabulary import Category

GROUND = Walkable.of(HALL)
POINTS = st.lists(st.tuples(st.floats(-5, 49), st.floats(-20, 20)), min_size=2, max_size=2)


def _length(way: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(way, axis=0), axis=1).sum())


def _inside(points: np.ndarray, clearance_m: float) -> np.ndarray:
    """Which points are in a footprint, grown by a clearance."""
    box = GROUND.obstacles_m + clearance_m * np.array([-1, -1, 1, 1])
    x, y = points[:, :1], points[:, 1:]
    return ((x > box[:, 0]) & (x < box[:, 2]) & (y > box[:, 1]) & (y < box[:, 3])).any(1)


@given(POINTS)
def test_a_way_goes_round_every_footprint(ends):
    start, goal = GROUND.snap(ends)
    way = GROUND.path(start, goal)
    assert np.allclose(way[[0, -1]], [start, goal])
    share = np.linspace(0, 1, 60)[:, None]
    for a, b in itertools.pairwise(way):
        assert not _inside(a + share * (b - a), BODY_RADIUS_M - 1e-3).any()


@given(POINTS)
def test_distances_are_the_lengths_of_ways_and_a_metric(ends):
    a, b = GROUND.snap(ends)
    via = np.array([30.0, 16.0])
    d = GROUND.distances([a, b, via], [a, b, via])
    assert d[0, 1] == pytest.approx(_length(GROUND.path(a, b)), abs=1e-6)
    assert np.allclose(d, d.T, atol=1e-6)
    assert d[0, 1] >= np.linalg.norm(a - b) - 1e-9
    assert d[0, 1] <= d[0, 2] + d[2, 1] + 1e-6


@given(POINTS)
def test_snapping_gives_free_ground_and_leaves_free_points_alone(points):
    snapped = GROUND.snap(points)
    assert GROUND.free(snapped).all()
    free = GROUND.free(points)
    assert np.array_equal(snapped[free], np.array(points)[free])


def test_a_detour_is_as_long_as_geometry_says():
    wall = environment(
        ("wall", Category.BUILDING, (0, 0), (2, 20)),
        ("a", Category.OUTDOOR_AREA, (-10, 0), (4, 4)),
        ("b", Category.OUTDOOR_AREA, (10, 0), (4, 4)),
    )
    half_width, height = 1 + BODY_RADIUS_M, 10 + BODY_RADIUS_M
    expected = 2 * np.hypot(10 - half_width, height) + 2 * half_width
    assert Walkable.of(wall).distances([[-10, 0]], [[10, 0]])[0, 0] == pytest.approx(expected, abs=0.01)


def test_buildings_are_solid_unless_something_lies_inside():
    office = ("office", Category.BUILDING, (0.0, 0.0), (20.0, 10.0))
    door = ("door", Category.ENTRANCE, (0.0, -5.0), (2.0, 1.0))
    desk = ("desk", Category.FURNITURE, (3.0, 0.0), (2.0, 1.0))
    assert is_solid(environment(office, door)).tolist() == [True, False]
    assert is_solid(environment(office, door, desk)).tolist() == [False, False, True]


def test_large_things_are_areas_with_such_things_in_them():
    stalls = environment(("hall", Category.ROOM, (0, 0), (60, 40)), ("stalls", Category.FURNITURE, (0, 0), (20, 8)))
    assert is_solid(stalls).tolist() == [False, False]


def test_ground_that_cannot_be_reached_is_not_free():
    walls = [
        ("north", Category.BUILDING, (0.0, 5.0), (14.0, 4.0)),
        ("south", Category.BUILDING, (0.0, -5.0), (14.0, 4.0)),
        ("west", Category.BUILDING, (-5.0, 0.0), (4.0, 10.0)),
        ("east", Category.BUILDING, (5.0, 0.0), (4.0, 10.0)),
    ]
    court = Walkable.of(environment(*walls))
    assert not court.free([[0.0, 0.0]])[0]
    assert court.free(court.snap([[0.0, 0.0]]))[0]


def test_every_authored_layout_hangs_together():
    for scenario in load_corpus()[::12]:
        ground = Walkable.of(scenario.environment)
        centres = ground.snap([place.position_m for place in scenario.environment.locations])
        assert ground.free(centres).all()
        d = ground.distances(centres, centres)
        ways = ground.paths(np.repeat(centres, len(centres), 0), np.tile(centres, (len(centres), 1)))
        assert np.allclose([_length(way) for way in ways], d.ravel(), atol=1e-6)
