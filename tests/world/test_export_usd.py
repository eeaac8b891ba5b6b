"""What was written is read back by the library of the format."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import odd_worlds
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Sdf, Usd, UsdGeom, UsdValidation

from genc.world.export import export_world
from genc.world.export.actions import ACTION_NAMES, PHASES, doings
from genc.world.export.keyframes import ERROR_M, ERROR_RAD
from genc.world.export.usd_scene import CROWD, ENVIRONMENT, TimeCodes, prim_names


@pytest.fixture(scope="module", params=["authored", "rare", "one frame", "nobody"])
def exported(request, short_world, tmp_path_factory):
    worlds = {
        "authored": lambda: short_world,
        "rare": odd_worlds.rare,
        "one frame": odd_worlds.one_frame,
        "nobody": odd_worlds.nobody,
    }
    world = worlds[request.param]()
    files = export_world(world, tmp_path_factory.mktemp("usd"), ["usd"])["usd"]
    return world, *(Usd.Stage.Open(str(file)) for file in files)


def sampled_frames(world) -> range:
    n_frames = len(world.motion.present)
    return range(0, n_frames, max(1, n_frames // 25))


def seconds(stage, code: float) -> float:
    return code / stage.GetTimeCodesPerSecond()


def test_both_stages_are_valid_and_say_axes_units_and_times(exported):
    world, *stages = exported
    for stage in stages:
        context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
        assert [error.GetErrorAsString() for error in context.Validate(stage)] == []
        assert UsdGeom.GetStageUpAxis(stage) == "Z"
        assert UsdGeom.GetStageMetersPerUnit(stage) == 1
        assert stage.GetDefaultPrim().GetPath() == "/World"
        last_s = (len(world.motion.present) - 1) * world.motion.dt_s
        assert seconds(stage, stage.GetEndTimeCode()) == pytest.approx(last_s)
        assert stage.GetDefaultPrim().GetCustomDataByKey("genc:text") == world.provenance.get("text")


def test_places_are_boxes_with_their_true_names(exported):
    world, *stages = exported
    for stage in stages:
        prims = [p for p in stage.GetPrimAtPath(ENVIRONMENT).GetChildren() if p.IsA(UsdGeom.Cube)]
        places = world.plan.environment.locations
        assert len(prims) == len(places)
        cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"])
        for prim, place in zip(prims, places, strict=True):
            assert prim.GetAttribute("genc:name").Get() == prim.GetDisplayName() == place.name
            assert prim.GetAttribute("genc:category").Get() == place.category
            box = cache.ComputeWorldBound(prim).ComputeAlignedRange()
            assert list(box.GetMidpoint())[:2] == pytest.approx(place.position_m, abs=1e-5)
            assert list(box.GetSize())[:2] == pytest.approx(place.size_m, abs=1e-5)
            assert box.GetMin()[2] == pytest.approx(0, abs=1e-6)
            assert len(UsdGeom.Gprim(prim).GetDisplayColorAttr().Get()) == 1


def test_instances_are_where_the_people_are(exported):
    world, stage, _ = exported
    motion, done = world.motion, doings(world)
    n_agents = motion.present.shape[1]
    crowd = UsdGeom.PointInstancer(stage.GetPrimAtPath(CROWD))
    times, primvars = TimeCodes.of(motion.dt_s), UsdGeom.PrimvarsAPI(crowd)
    action, phase = (primvars.GetPrimvar(f"genc:{name}") for name in ("action", "phase"))
    names = list(crowd.GetPrim().GetAttribute("genc:actionNames").Get())
    assert names == list(ACTION_NAMES)
    assert list(primvars.GetPrimvar("genc:group").Get()) == [person.group for person in world.plan.people]
    for frame in sampled_frames(world):
        code, present = times.at(frame), motion.present[frame]
        hidden = set(crowd.GetInvisibleIdsAttr().Get(code))
        assert hidden == set(np.flatnonzero(~present).tolist())
        assert list(crowd.ComputeMaskAtTime(code) or [True] * n_agents) == present.tolist()
        matrices = crowd.ComputeInstanceTransformsAtTime(code, code, applyMask=crowd.IgnoreMask)
        for agent in np.flatnonzero(present).tolist():
            assert matrices[agent].ExtractTranslation()[:2] == pytest.approx(motion.positions_m[frame, agent], abs=1e-4)
            forward = matrices[agent].TransformDir((1, 0, 0))
            heading_rad = motion.headings_rad[frame, agent]
            assert tuple(forward) == pytest.approx((np.cos(heading_rad), np.sin(heading_rad), 0), abs=2e-3)
        assert list(action.Get(code)) == done.action[frame].tolist()
        assert list(phase.Get(code)) == done.phase[frame].tolist()


def test_between_two_frames_instances_turn_the_short_way():
    """Nobody who turns across pi spins round on the way."""
    world = odd_worlds.rare()
    heading_rad = np.unwrap(world.motion.headings_rad[:, 0])
    assert np.abs(heading_rad).max() > 2 * np.pi
    times = TimeCodes.of(world.motion.dt_s)
    from genc.world.export.usd import _stage
    from genc.world.export.usd_instances import add_instances

    stage = _stage(world, times)
    add_instances(stage, world, times)
    crowd = UsdGeom.PointInstancer(stage.GetPrimAtPath(CROWD))
    for frame in range(len(heading_rad) - 1):
        code = times.at(frame) + times.per_frame / 2
        turn = crowd.GetOrientationsAttr().Get(code)[0]
        found_rad = 2 * np.arctan2(turn.imaginary[2], turn.real)
        between_rad = heading_rad[frame : frame + 2].mean()
        assert np.abs((found_rad - between_rad + np.pi) % (2 * np.pi) - np.pi) < 0.01
        before, after = (crowd.GetOrientationsAttr().Get(times.at(f))[0] for f in (frame, frame + 1))
        # so that it also holds for who blends the numbers
        assert before.real * after.real + before.imaginary[2] * after.imaginary[2] > 0


def test_people_are_prims_with_what_they_do(exported):
    world, _, stage = exported
    motion, done = world.motion, doings(world)
    times, prims = TimeCodes.of(motion.dt_s), stage.GetPrimAtPath(CROWD).GetChildren()
    places = world.plan.environment.locations
    assert len(prims) == len(world.plan.people)
    for agent, prim in enumerate(prims):
        person, figure = world.plan.people[agent], UsdGeom.Xformable(prim)
        assert prim.GetAttribute("genc:group").Get() == person.group
        (group_path,) = prim.GetRelationship("genc:groupPrim").GetTargets()
        group = stage.GetPrimAtPath(group_path)
        assert group.GetAttribute("genc:caption").Get() == world.plan.captions[person.group]
        assert prim.GetPath() in group.GetRelationship("genc:members").GetTargets()
        for frame in sampled_frames(world):
            code, row = times.at(frame), done.row[frame, agent]
            visible = figure.ComputeVisibility(code) == UsdGeom.Tokens.inherited
            assert visible == motion.present[frame, agent]
            said = {name: prim.GetAttribute(f"genc:{name}").Get(code) for name in ("action", "phase", "place")}
            assert said["action"] == ACTION_NAMES[done.action[frame, agent]]
            if row >= 0:
                activity = person.activities[motion.executed[row].step]
                assert said["phase"] == PHASES[done.phase[frame, agent]]
                assert said["place"] == places[activity.location].name
                assert tuple(prim.GetAttribute("genc:partners").Get(code)) == activity.partners
            if visible:
                matrix = figure.GetLocalTransformation(code)
                off_m = np.array(matrix.ExtractTranslation()[:2]) - motion.positions_m[frame, agent]
                assert np.hypot(*off_m) < ERROR_M + 1e-3
                forward = matrix.TransformDir((1, 0, 0))
                off_rad = np.arctan2(forward[1], forward[0]) - motion.headings_rad[frame, agent]
                assert np.abs((off_rad + np.pi) % (2 * np.pi) - np.pi) < ERROR_RAD + 1e-3


def test_what_people_do_is_written_only_when_it_changes(exported):
    _, _, stage = exported
    for prim in stage.GetPrimAtPath(CROWD).GetChildren():
        for name in ("genc:action", "genc:phase", "genc:place", "genc:partners", "visibility"):
            attribute = prim.GetAttribute(name)
            values = [attribute.Get(code) for code in attribute.GetTimeSamples()]
            assert values
            assert all(a != b for a, b in pairwise(values)), (prim.GetPath(), name)


def test_people_are_as_high_as_people(exported):
    world, _, stage = exported
    frame = len(world.motion.present) - 1
    cache = UsdGeom.BBoxCache(TimeCodes.of(world.motion.dt_s).at(frame), ["default"])
    for agent, prim in enumerate(stage.GetPrimAtPath(CROWD).GetChildren()):
        if world.motion.present[frame, agent]:
            box = cache.ComputeWorldBound(prim).ComputeAlignedRange()
            assert 1.6 < box.GetSize()[2] < 1.9
            assert box.GetMin()[2] == pytest.approx(0, abs=1e-6)


def test_the_figure_of_all_can_be_replaced_from_outside(tmp_path):
    file = export_world(odd_worlds.rare(), tmp_path, ["usd"])["usd"][1]
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/Shot").GetReferences().AddReference(str(file))
    UsdGeom.Cone.Define(stage, "/Shot/Person/Hat").GetPrim().GetParent().SetSpecifier(Sdf.SpecifierOver)
    for prim in stage.GetPrimAtPath("/Shot/Crowd").GetChildren():
        assert {child.GetName() for child in prim.GetPrototype().GetChildren()} == {"Body", "Head", "Nose", "Hat"}


@pytest.mark.parametrize("dt_s", [0.02, 0.04, 0.05, 0.1, 0.2, 0.25, 0.3, 0.5, 1.0, 3.0])
def test_frames_are_at_whole_time_codes_near_25_a_second(dt_s):
    times = TimeCodes.of(dt_s)
    assert isinstance(times.at(7), int)
    assert times.at(7) / times.per_second == pytest.approx(7 * dt_s)
    assert 15 <= times.per_second <= 50


# Names.


@given(st.lists(st.text(max_size=12) | st.sampled_from([*odd_worlds.NAMES, "", "_", "1", "É", "e"]), max_size=20))
def test_all_names_become_distinct_prim_names(names):
    found = prim_names(names)
    assert len({name.lower() for name in found}) == len(found) == len(names)
    assert all(Sdf.Path.IsValidIdentifier(name) and name.isascii() for name in found)


def test_plain_names_stay_readable():
    assert prim_names(["metro gate", "Café Zoë", "cafe zoe", "9th gate", "東京駅", "駅"]) == [
        *("metro_gate", "Cafe_Zoe", "cafe_zoe_2", "_9th_gate", "place", "place_2"),
    ]
