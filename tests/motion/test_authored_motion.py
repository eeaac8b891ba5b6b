"""What must hold for everybody in every world, on worlds of the authored corpus with the real plan room."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

from genc.motion.executor import Options, simulate
from genc.motion.kinematic import Kinematic
from genc.motion.motion import Executed, Motion, Status
from genc.plan.crowd import PlanRequest, plan_crowd
from genc.plan.plan import ON_THE_WAY, Activity, CrowdPlan
from genc.plan.slots import Places, places_of
from genc.plan.walkable import Walkable
from genc.scenario.corpus import load_corpus, themes
from genc.scenario.rehearse import rehearse
from genc.scenario.scenario import Scenario
from genc.words.vocabulary import Action, Category


@dataclass(frozen=True)
class Case:
    plan: CrowdPlan
    ground: Walkable
    places: tuple[Places, ...]
    motion: Motion

    def activity(self, done: Executed) -> Activity:
        return self.plan.people[done.agent].activities[done.step]


def planned(scenario: Scenario, duration_s: float) -> CrowdPlan:
    rng = np.random.default_rng(1)
    rehearsal = rehearse(scenario, rng)
    pairs = list(zip(rehearsal.records, rehearsal.group_of, strict=True))
    groups = [[record for record, of in pairs if of == group] for group in range(len(rehearsal.captions))]
    request = PlanRequest(duration_s, rehearsal.captions, triggers=rehearsal.triggers)
    return plan_crowd(groups, scenario.environment, request, rng)


def played(plan: CrowdPlan, seed: int = 0) -> Case:
    ground = Walkable.of(plan.environment)
    places = places_of(plan.environment, ground)
    steering = Kinematic(len(plan.people), ground)
    return Case(plan, ground, places, simulate(plan, ground, places, steering, Options(), np.random.default_rng(seed)))


@pytest.fixture(scope="module", params=themes())
def case(request) -> Case:
    """One authored scenario of each theme, ten minutes long."""
    scenarios = load_corpus([request.param])
    return played(planned(scenarios[len(scenarios) // 2], 600.0))


def test_nobody_is_inside_a_solid_footprint(case):
    positions_m = case.motion.positions_m[case.motion.present].astype(float)
    for x0, y0, x1, y1 in case.ground.obstacles_m:
        inside = (positions_m > (x0 + 1e-4, y0 + 1e-4)) & (positions_m < (x1 - 1e-4, y1 - 1e-4))
        assert not inside.all(axis=1).any()


def test_nobody_is_in_two_places_at_once(case):
    way_m = np.linalg.norm(np.diff(case.motion.positions_m.astype(float), axis=0), axis=2)
    most_m = np.array([person.speed_mps for person in case.plan.people]) * case.motion.dt_s
    seen_on = case.motion.present[1:] & case.motion.present[:-1]
    assert not (seen_on & (way_m > most_m * 1.001 + 1e-4)).any()


def test_lives_are_gapless_and_in_order(case):
    for a, b in pairwise(case.motion.executed):
        assert (a.agent, a.step) < (b.agent, b.step)
        if a.agent == b.agent:
            assert b.step == a.step + 1
            assert b.leave_s == a.end_s
    for done in case.motion.executed:
        times_s = [t for t in (done.leave_s, done.arrive_s, done.start_s, done.end_s) if not math.isnan(t)]
        assert times_s == sorted(times_s)
        assert (done.status is Status.CUT) == math.isnan(done.end_s)
        assert 0 <= times_s[0] <= times_s[-1] <= case.plan.duration_s


def test_partners_begin_and_end_together_and_all_are_there(case):
    together = defaultdict(list)
    for done in case.motion.executed:
        if case.activity(done).partners and not math.isnan(done.start_s) and done.status is not Status.TIMEOUT:
            together[case.activity(done).occasion].append(done)
    assert together
    for dones in together.values():
        assert {done.agent for done in dones} == {dones[0].agent, *case.activity(dones[0]).partners}
        assert len({done.start_s for done in dones}) == 1
        assert max(done.arrive_s for done in dones) <= dones[0].start_s
        assert len({done.end_s for done in dones if not math.isnan(done.end_s)}) <= 1


def on_the_way(done: Executed, activity: Activity) -> bool:
    """Whether it was begun on setting off; then it lasts at least as long as the walk."""
    return activity.action in ON_THE_WAY and done.arrive_s == done.leave_s


def test_nothing_begins_early_except_at_a_service(case):
    at_service = set()
    """Occasions at which somebody has a service slot: there the turn decides for all who share it."""
    for done in case.motion.executed:
        activity = case.activity(done)
        if activity.slot.position_m in {slot.position_m for slot in case.places[activity.location].service}:
            at_service.add(activity.occasion)
    for done in case.motion.executed:
        activity = case.activity(done)
        if activity.occasion not in at_service and not math.isnan(done.start_s) and not on_the_way(done, activity):
            assert done.start_s >= activity.start_s - 1e-6


def test_doings_last_as_long_as_planned(case):
    for done in case.motion.executed:
        activity = case.activity(done)
        timed = activity.action is not Action.QUEUE and not on_the_way(done, activity)
        if done.status is Status.DONE and timed:
            assert done.end_s - done.start_s == pytest.approx(activity.end_s - activity.start_s, abs=0.11)


def test_services_serve_no_more_than_they_can_and_in_order_of_the_line(case):
    served = defaultdict(list)
    for done in case.motion.executed:
        activity = case.activity(done)
        slots = {slot.position_m for slot in case.places[activity.location].service}
        at_counter = done.position_m in slots and activity.action is not Action.ENTER_EXIT
        if at_counter and not math.isnan(done.start_s):
            served[activity.location, done.position_m].append((done.start_s, done.end_s))
    assert served
    for spans in served.values():
        for (_, end_s), (start_s, _) in pairwise(sorted(spans)):
            assert end_s <= start_s


def test_those_who_stand_have_room(case):
    """Some pass through each other on their way; hardly anybody stands in somebody else."""
    still = np.abs(np.diff(case.motion.positions_m, axis=0)).sum(axis=2) == 0
    n_standing, n_crowded = 0, 0
    for frame in range(100, len(still), 250):
        standing_m = case.motion.positions_m[frame][still[frame] & case.motion.present[frame]].astype(float)
        apart_m = np.linalg.norm(standing_m[:, None] - standing_m, axis=2) + 9 * np.eye(len(standing_m))
        n_standing += len(standing_m)
        n_crowded += int((apart_m < 0.3).any(axis=1).sum())
    assert n_crowded <= 0.05 * n_standing


def test_wanderers_stay_in_their_place(case):
    for done in case.motion.executed:
        location = case.plan.environment.locations[case.activity(done).location]
        if case.activity(done).action is not Action.WANDER or location.category is not Category.OUTDOOR_AREA:
            continue
        if math.isnan(done.start_s):
            continue
        last = len(case.motion.present) if math.isnan(done.end_s) else int(done.end_s / case.motion.dt_s)
        path_m = case.motion.positions_m[math.ceil(done.start_s / case.motion.dt_s) : last, done.agent]
        off_m = np.abs(path_m - location.position_m) - np.array(location.size_m) / 2
        assert off_m.max(initial=0.0) < 1.0


def test_almost_nobody_waits_in_vain(case):
    late = [done for done in case.motion.executed if done.status is Status.TIMEOUT]
    assert len(late) <= 0.01 * len(case.motion.executed)


def test_the_same_seed_gives_the_same_motion_and_another_seed_another():
    plan = planned(load_corpus(["city park"])[0], 180.0)
    first, again, other = (played(plan, seed).motion for seed in (0, 0, 1))
    assert first.positions_m.tobytes() == again.positions_m.tobytes()
    assert first.headings_rad.tobytes() == again.headings_rad.tobytes()
    assert repr(first.executed) == repr(again.executed)
    assert first.positions_m.tobytes() != other.positions_m.tobytes()
