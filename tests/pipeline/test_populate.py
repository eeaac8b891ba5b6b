"""From a sentence to a world, with a tiny untrained generator: what holds must hold for any groups."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
import torch

from genc.errors import BriefError, LayoutError
from genc.model.codec import CodecConfig, CodecModel
from genc.model.generator import CodecGenerator
from genc.pipeline import populate, stage
from genc.plan.walkable import box_of, is_solid
from genc.scenario.corpus import load_theme
from genc.scenario.scenario import Environment, Location
from genc.words.embed import Hashing
from genc.words.vocabulary import Category
from genc.world.world import World
from genc.world.world_file import write_world

TEXT = "Families wait for the tour, look at the bones and read in the hall"


def generator() -> CodecGenerator:
    torch.manual_seed(0)
    shape = CodecConfig(Hashing.dimension, 16, 2, 4, 8, encoder_depth=1, structure_depth=1, feature_depth=1)
    return CodecGenerator(CodecModel(shape).eval(), Hashing(), "0" * 16)


def make(**wishes) -> World:
    return populate(**{"text": TEXT, "minutes": 4.0, "n_agents": 40, "generator": generator()} | wishes)


def hall(*sizes_m: float) -> Environment:
    return Environment(
        tuple(Location(f"hall {i}", Category.ROOM, (0.0, 0.0), (size_m, 10.0)) for i, size_m in enumerate(sizes_m))
    )


@pytest.fixture(scope="module")
def world() -> World:
    return make()


def test_partners_are_partners_of_each_other_and_begin_together(world):
    people = world.plan.people
    occasions = {}
    for agent, person in enumerate(people):
        for activity in person.activities:
            assert agent not in activity.partners
            assert all(people[other].group == person.group for other in activity.partners)
            occasions.setdefault(activity.occasion, []).append((agent, activity))
    assert any(len(rows) > 1 for rows in occasions.values())
    for rows in occasions.values():
        everybody = {agent for agent, _ in rows}
        assert len(everybody) == len(rows)
        assert all({agent, *activity.partners} == everybody for agent, activity in rows)
        assert len({(activity.start_s, activity.action, activity.location) for _, activity in rows}) == 1


def test_nobody_is_in_two_places_at_once(world):
    for person in world.plan.people:
        assert all(before.end_s == after.leave_s for before, after in pairwise(person.activities))
    done = world.motion.executed
    assert sorted(done, key=lambda row: (row.agent, row.step)) == list(done)
    for before, after in pairwise(done):
        if before.agent == after.agent:
            assert before.step < after.step
            assert not after.leave_s < before.end_s


def test_nobody_does_anything_before_having_come(world):
    for row in world.motion.executed:
        times_s = [t for t in (row.leave_s, row.arrive_s, row.start_s, row.end_s) if not math.isnan(t)]
        assert times_s == sorted(times_s)
        assert times_s[-1] <= world.plan.duration_s + world.motion.dt_s


def test_nobody_is_inside_a_solid_footprint(world):
    places = world.plan.environment.locations
    at = world.motion.positions_m[world.motion.present]
    assert len(at)
    for place, solid in zip(places, is_solid(world.plan.environment), strict=True):
        if solid:
            low, high = np.array(box_of(place)).reshape(2, 2)
            assert not ((at > low + 0.05) & (at < high - 0.05)).all(1).any(), place.name


@pytest.mark.parametrize("n_agents", [1, 2, 15, 16, 31])
def test_the_crowd_has_exactly_as_many_people_as_asked_for(n_agents):
    world = make(n_agents=n_agents, minutes=0.5, environment=hall(30, 20))
    assert len(world.plan.people) == world.motion.present.shape[1] == n_agents
    groups = [person.group for person in world.plan.people]
    assert sorted(set(groups)) == list(range(len(world.plan.captions)))
    assert max(groups.count(group) for group in groups) <= 15


def test_one_seed_one_file(tmp_path):
    for name, seed in (("a", 4), ("b", 4), ("c", 5)):
        write_world(make(seed=seed, n_agents=9, minutes=1), tmp_path / name)
    first, again, other = ((tmp_path / name).read_bytes() for name in "abc")
    assert first == again
    assert first != other


def test_a_theme_narrows_the_choice_of_layout():
    world = make(theme="Hospital", n_agents=3, minutes=0.5)
    assert {p.name for p in world.plan.environment.locations} in [
        {p.name for p in scenario.environment.locations} for scenario in load_theme("hospital")
    ]


@pytest.mark.parametrize(
    "wish",
    [
        {"text": "\t\n"},
        {"text": "caf\udce9"},
        {"text": "x" * 20_001},
        {"n_agents": 0},
        {"n_agents": -3},
        {"n_agents": 1_000_000},
        {"minutes": 0.0},
        {"minutes": -1.0},
        {"minutes": math.nan},
        {"minutes": math.inf},
        {"theme": "the moon"},
        {"theme": ""},
    ],
    ids=repr,
)
def test_what_no_world_can_be_is_refused(wish):
    with pytest.raises(BriefError) as refused:
        make(**wish)
    assert len(str(refused.value).splitlines()) == 1
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize("environment", [hall(20), hall(20, 1001), hall(20, 1e9)])
def test_a_layout_that_holds_nobody_is_refused(environment):
    with pytest.raises(LayoutError):
        make(environment=environment)


def test_a_written_scenario_is_staged_with_everybody_in_it():
    scenario = load_theme("museum")[0]
    world = stage(scenario, minutes=3)
    assert len(world.plan.people) == sum(len(group.agents) for group in scenario.groups)
    assert sorted(world.plan.captions) == sorted(group.caption for group in scenario.groups)
    assert world.provenance["model"] is None
    with pytest.raises(BriefError, match="0 minutes"):
        stage(scenario, minutes=0)
