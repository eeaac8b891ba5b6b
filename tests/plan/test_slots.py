from __future__ import annotations

import math

import numpy as np
import pytest
from crowds import HALL
from scipy.spatial.distance import pdist

from genc.plan.slots import Places, circle, more_spots, places_of
from genc.plan.walkable import Walkable, box_of
from genc.scenario.corpus import load_corpus
from genc.words.vocabulary import Category

GROUND = Walkable.of(HALL)
PLACES = dict(zip((place.name for place in HALL.locations), places_of(HALL, GROUND), strict=True))


def _points(slots) -> np.ndarray:
    return np.array([slot.position_m for slot in slots]).reshape(-1, 2)


def _faces(slot, target) -> float:
    """Cosine of the angle between a facing and the way to a target."""
    away = np.array(target) - slot.position_m
    return float(away @ [math.cos(slot.facing_rad), math.sin(slot.facing_rad)] / np.linalg.norm(away))


def _check(places: Places, ground: Walkable) -> None:
    assert len(places.line) >= 12
    assert places.spots
    assert ground.free([places.door.position_m])[0]
    for slots in (places.service, places.line, places.spots):
        points = _points(slots)
        assert ground.free(points).all()
        assert len(points) < 2 or pdist(points).min() >= 0.6


def test_every_slot_of_authored_layouts_is_free_and_apart():
    for scenario in load_corpus()[::12]:
        ground = Walkable.of(scenario.environment)
        for places in places_of(scenario.environment, ground):
            _check(places, ground)


def test_a_line_goes_backwards_from_the_counter():
    kiosk = PLACES["kiosk"]
    counter = HALL["kiosk"].position_m
    away = np.linalg.norm(_points(kiosk.line) - counter, axis=1)
    assert away[0] == pytest.approx(np.min(away))
    gaps = np.linalg.norm(np.diff(_points(kiosk.line), axis=0), axis=1)
    assert gaps.max() < 1.6
    for slot, ahead in zip(kiosk.line[1:8], kiosk.line, strict=False):
        assert _faces(slot, ahead.position_m) == pytest.approx(1)


def test_people_face_what_they_use():
    for name in ("kiosk", "bench"):
        place = HALL[name]
        slots = PLACES[name].service or PLACES[name].spots
        assert all(_faces(slot, place.position_m) > 0.5 for slot in slots)


def test_capacity_grows_with_the_counter():
    wide = type(HALL)(
        tuple(type(p)(p.name, p.category, p.position_m, (2.0, 8.0)) if p.name == "kiosk" else p for p in HALL.locations)
    )
    ground = Walkable.of(wide)
    assert len(PLACES["kiosk"].service) == 1
    assert len(places_of(wide, ground)[1].service) == 5


def test_areas_have_no_service_and_spots_inside():
    lawn = PLACES["lawn"]
    assert not lawn.service
    x0, y0, x1, y1 = box_of(HALL["lawn"])
    points = _points(lawn.spots)
    assert ((points >= [x0, y0]) & (points <= [x1, y1])).all()
    assert len(points) > 200


@pytest.mark.parametrize("n", [2, 3, 6, 12])
def test_a_talking_circle_faces_inward(n):
    ring = circle(HALL["lawn"], GROUND, (8.0, 6.0), n)
    points = _points(ring)
    assert len(points) == n
    assert pdist(points).min() >= 0.6
    assert all(_faces(slot, (8.0, 6.0)) > 0.9 for slot in ring)


@pytest.mark.parametrize("margin_m", [0.0, 8.0])
def test_more_spots_are_free_and_within_their_margin(margin_m):
    for place in HALL.locations:
        spots = more_spots(place, GROUND, margin_m, 100, np.random.default_rng(0))
        points = _points(spots)
        assert 1 <= len(spots) <= 100
        assert GROUND.free(points).all()
        beyond_m = np.abs(points - place.position_m) - np.array(place.size_m) / 2
        assert beyond_m.max() <= max(margin_m, 1.0)
    assert len(more_spots(HALL["lawn"], GROUND, margin_m, 100, np.random.default_rng(0))) > 80


def test_a_building_is_entered_where_it_faces_the_rest():
    door = PLACES["tower"].door
    assert door.position_m[0] < 36
    assert HALL["tower"].category is Category.BUILDING
