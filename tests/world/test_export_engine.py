from __future__ import annotations

import json
import math

import numpy as np
import odd_worlds
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genc.world.export import export_world
from genc.world.export.engine import NEVER_S, SCHEMA, Axes
from genc.world.export.keyframes import ERROR_M, ERROR_RAD
from genc.world.export.unity import UNITY
from genc.world.export.unreal import UNREAL

lengths_m = st.floats(-500, 500)


@pytest.fixture(scope="module", params=["authored", "rare", "one frame"])
def exported(request, short_world, tmp_path_factory):
    worlds = {"authored": lambda: short_world, "rare": odd_worlds.rare, "one frame": odd_worlds.one_frame}
    world = worlds[request.param]()
    folder = tmp_path_factory.mktemp("engines")
    export_world(world, folder, ["unity", "unreal"])
    return world, {name: json.loads((folder / f"{name}.json").read_text("utf-8")) for name in ("unity", "unreal")}


# From the axes of an engine back to ours, written apart from the code.


def from_unity(x: float, y: float, z: float) -> tuple[float, float, float]:
    return x, z, y


def from_unreal(x: float, y: float, z: float) -> tuple[float, float, float]:
    return x / 100, -y / 100, z / 100


BACK = {"unity": from_unity, "unreal": from_unreal}
HEADING = {"unity": lambda yaw_deg: np.radians(90 - yaw_deg), "unreal": lambda yaw_deg: np.radians(-yaw_deg)}


@pytest.mark.parametrize(
    ("axes", "point", "heading_deg", "yaw_deg"),
    [
        (UNITY, [1, 3, 2], 0, 90),
        (UNITY, [1, 3, 2], 90, 0),
        (UNITY, [1, 3, 2], 180, -90),
        (UNREAL, [100, -200, 300], 0, 0),
        (UNREAL, [100, -200, 300], 90, -90),
        (UNREAL, [100, -200, 300], -45, 45),
    ],
)
def test_known_points_and_headings(axes: Axes, point, heading_deg, yaw_deg):
    assert axes.points([(1.0, 2.0, 3.0)]) == point
    assert axes.points([(1.0, 2.0)]) == axes.points([(1.0, 2.0, 0.0)])
    assert axes.yaws_deg(math.radians(heading_deg)) == [yaw_deg]


@given(lengths_m, lengths_m, lengths_m)
def test_points_come_back(x, y, z):
    for axes, back in ((UNITY, from_unity), (UNREAL, from_unreal)):
        assert back(*axes.points([(x, y, z)])) == pytest.approx((x, y, z), abs=6e-4)


@pytest.mark.parametrize("axes", [UNITY, UNREAL])
def test_both_engines_are_left_handed_and_walkers_walk_where_they_look(axes):
    assert np.linalg.det(np.array(axes.rows)) < 0
    for heading_rad in np.linspace(-3, 3, 13):
        ahead = np.array(axes.points([(np.cos(heading_rad), np.sin(heading_rad))]), dtype=float)
        yaw_rad = math.radians(axes.yaws_deg(heading_rad)[0])
        zero, quarter = (2, 0) if axes is UNITY else (0, 1)
        # clockwise from above: Unity from +z to +x, Unreal from +x to +y
        expected = np.zeros(3)
        expected[zero], expected[quarter] = math.cos(yaw_rad), math.sin(yaw_rad)
        assert ahead / np.linalg.norm(ahead) == pytest.approx(expected, abs=0.01)


# The files.


@pytest.mark.parametrize("engine", ["unity", "unreal"])
def test_the_head_says_what_the_numbers_mean(exported, engine):
    world, files = exported
    head = files[engine]
    assert (head["format"], head["schema"], head["engine"].lower()) == ("genc engine", SCHEMA, engine)
    assert head["axes"]["handedness"] == "left"
    assert head["units"]["length"] == {"unity": "m", "unreal": "cm"}[engine]
    assert head["duration_s"] == world.plan.duration_s
    assert head["provenance"] == dict(world.provenance)


@pytest.mark.parametrize("engine", ["unity", "unreal"])
def test_places_are_boxes_on_the_ground(exported, engine):
    world, files = exported
    places, back = world.plan.environment.locations, BACK[engine]
    assert [box["name"] for box in files[engine]["environment"]] == [place.name for place in places]
    for box, place in zip(files[engine]["environment"], places, strict=True):
        centre_m, size_m = back(*box["center"]), [abs(extent) for extent in back(*box["size"])]
        assert centre_m[:2] == pytest.approx(place.position_m, abs=1e-3)
        assert size_m[:2] == pytest.approx(place.size_m, abs=1e-3)
        assert centre_m[2] == pytest.approx(size_m[2] / 2, abs=1e-3)
        assert (size_m[2] > 0.2) == box["solid"]


@pytest.mark.parametrize("engine", ["unity", "unreal"])
def test_paths_are_within_the_error_that_is_said(exported, engine):
    world, files = exported
    motion, data = world.motion, files[engine]
    assert data["max_error"]["position_m"] == ERROR_M
    for agent in data["agents"]:
        present = np.zeros(len(motion.present), dtype=bool)
        for stay in agent["stays"]:
            times_s, yaws_deg = np.array(stay["times_s"]), np.array(stay["yaws_deg"])
            points_m = np.array([BACK[engine](*point) for point in np.reshape(stay["points"], (-1, 3))])
            assert (np.diff(times_s) > 0).all()
            assert not points_m[:, 2].any()
            frames = np.arange(round(times_s[0] / motion.dt_s), round(times_s[-1] / motion.dt_s) + 1)
            present[frames] = True
            t_s = frames * motion.dt_s
            at_m = np.column_stack([np.interp(t_s, times_s, points_m[:, i]) for i in range(2)])
            assert np.linalg.norm(at_m - motion.positions_m[frames, agent["id"]], axis=1).max() < ERROR_M + 2e-3
            off_rad = HEADING[engine](np.interp(t_s, times_s, yaws_deg)) - motion.headings_rad[frames, agent["id"]]
            assert np.abs((off_rad + np.pi) % (2 * np.pi) - np.pi).max() < ERROR_RAD + 2e-3
        assert np.array_equal(present, motion.present[:, agent["id"]])


def test_activities_are_what_was_done_in_order_with_partners(exported):
    world, files = exported
    for engine, data in files.items():
        executed = iter(world.motion.executed)
        for agent in data["agents"]:
            assert [row["step"] for row in agent["activities"]] == list(range(len(agent["activities"])))
            for row in agent["activities"]:
                done = next(executed)
                activity = world.plan.people[done.agent].activities[done.step]
                assert (done.agent, row["step"], row["action"]) == (agent["id"], done.step, activity.action)
                assert row["location"] == activity.location
                assert tuple(row["partners"]) == activity.partners
                assert row["status"] == done.status
                for name in ("leave_s", "arrive_s", "start_s", "end_s"):
                    t_s = getattr(done, name)
                    assert row[name] == (NEVER_S if math.isnan(t_s) else pytest.approx(t_s, abs=1e-3))
                assert BACK[engine](*row["point"])[:2] == pytest.approx(done.position_m, abs=1e-3)
        assert next(executed, None) is None


def test_groups_hold_everybody_once(exported):
    world, files = exported
    for data in files.values():
        assert [group["caption"] for group in data["groups"]] == list(world.plan.captions)
        members = sorted(agent for group in data["groups"] for agent in group["agents"])
        assert members == list(range(len(world.plan.people)))
        for agent in data["agents"]:
            assert agent["id"] in data["groups"][agent["group"]]["agents"]


def test_nothing_is_written_that_simple_readers_of_json_do_not_know(exported):
    """No null, no NaN, no list in a list: such as the reader that comes with Unity."""

    def check(value: object, within_list: bool = False) -> None:
        if isinstance(value, dict):
            for item in value.values():
                check(item)
        elif isinstance(value, list):
            assert not within_list
            for item in value:
                check(item, within_list=True)
        else:
            assert value is not None
            assert value == value

    for data in exported[1].values():
        check({key: value for key, value in data.items() if key != "provenance"})


def test_files_stay_small(world, tmp_path):
    """A person takes about as much room as 200 frames of it would."""
    (file,) = export_world(world, tmp_path, ["unity"])["unity"]
    assert file.stat().st_size < 8_000 * len(world.plan.people)
