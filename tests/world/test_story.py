from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from genc.errors import BriefError
from genc.motion.motion import Executed, Motion, Status
from genc.plan.plan import Activity, CrowdPlan, Person, Slot
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action, Category
from genc.world.overview import tell_world
from genc.world.story import tell_agent, tell_group
from genc.world.world import World

PLACES = Environment(
    (
        Location("clock tower arch", Category.ENTRANCE, (0.0, 0.0), (4.0, 2.0)),
        Location("pizza van", Category.SERVICE_AREA, (20.0, 0.0), (3.0, 2.0)),
        Location("lawn", Category.OUTDOOR_AREA, (40.0, 0.0), (20.0, 20.0)),
        Location("library", Category.BUILDING, (70.0, 0.0), (10.0, 10.0)),
    )
)
ARCH, VAN, LAWN, LIBRARY = range(4)
NAN = math.nan

Step = tuple[Action, int, tuple[float, float, float, float], int, tuple[int, ...]]


def told(rows: list[list[Step]], leaves: bool = True, status: Status = Status.DONE, hidden: bool = False) -> World:
    """A world in which people did exactly this: (action, location, real times, occasion, partners) for each step."""
    people, executed = [], []
    for agent, row in enumerate(rows):
        activities = []
        for step, (action, location, times_s, occasion, partners) in enumerate(row):
            position_m = PLACES.locations[location].position_m
            activities.append(
                Activity(action, location, Slot(position_m, 0.0), *times_s[::2], times_s[3], occasion, partners)
            )
            end = Status.CUT if math.isnan(times_s[3]) else status
            executed.append(Executed(agent, step, *times_s, position_m, 0.0, end))
        people.append(Person(0, 1.3, tuple(activities), leaves))
    shape = (1001, len(rows))
    motion = Motion(
        0.2, np.zeros((*shape, 2), np.float32), np.zeros(shape, np.float32), np.full(shape, not hidden), tuple(executed)
    )
    return World(CrowdPlan(PLACES, tuple(people), 200.0, ("two friends have lunch",)), motion, {"text": "a square"})


LUNCH = [
    [
        (Action.ENTER_EXIT, ARCH, (10, 10, 10, 12), 0, ()),
        (Action.QUEUE, VAN, (12, 25, 25, 105), 1, (1,)),
        (Action.OBJECT_INTERACT, VAN, (105, 106, 106, 136), 2, (1,)),
        (Action.SIT, LAWN, (136, 145, 145, 155), 3, (1,)),
        (Action.DISCUSS, LAWN, (155, 155, 155, 170), 4, (1,)),
        (Action.ENTER_EXIT, ARCH, (170, 190, 190, 192), 5, ()),
    ],
    [
        (Action.WAIT, VAN, (0, 0, 0, 20), 6, ()),
        (Action.QUEUE, VAN, (20, 21, 25, 105), 1, (0,)),
        (Action.OBJECT_INTERACT, VAN, (105, 106, 106, 136), 2, (0,)),
        (Action.SIT, LAWN, (136, 145, 145, 155), 3, (0,)),
        (Action.DISCUSS, LAWN, (155, 155, 155, 170), 4, (0,)),
    ],
]


def test_a_life_reads_from_coming_to_leaving():
    assert tell_agent(told(LUNCH), 0) == [
        "00:10 Person 0 comes in by the clock tower arch.",
        "00:25 stands in line at the pizza van with Person 1 for 1:20 min.",
        "01:46 uses the pizza van with Person 1 for 30 s.",
        "02:25 sits at the lawn with Person 1 for 10 s, then talks with Person 1 for 15 s.",
        "03:10 leaves by the clock tower arch.",
    ]


def test_who_stays_is_said_to_stay():
    assert tell_agent(told(LUNCH, leaves=False), 1)[-1] == "02:50 stays there to the end."


def test_a_group_is_told_as_a_whole():
    lines = tell_group(told(LUNCH), 0)
    assert lines[0] == "Group 0, Persons 0 and 1: two friends have lunch"
    assert "00:25 Persons 0 and 1 stand in line at the pizza van for 1:24 min." in lines
    assert "02:35 Persons 0 and 1 talk with each other at the lawn for 15 s." in lines
    assert lines == [lines[0], *sorted(lines[1:], key=lambda line: line[:5])]


MEETING = [
    [(Action.MEET, LAWN, (0, 5, 45, 55), 0, (1,))],
    [(Action.MEET, LAWN, (0, 45, 45, 55), 0, (0,))],
]


def test_a_wait_says_for_whom():
    assert tell_agent(told(MEETING), 0)[0] == (
        "00:05 Person 0 waits at the lawn for Person 1 (40 s), then meets Person 1 at the lawn for 10 s."
    )
    assert tell_agent(told(MEETING), 1)[0] == "00:45 Person 1 meets Person 0 at the lawn for 10 s."
    assert tell_group(told(MEETING), 0)[1] == (
        "00:45 Persons 0 and 1 meet each other at the lawn for 10 s; Person 0 had waited 40 s."
    )


def test_a_wait_in_vain_is_said_to_be_in_vain():
    alone = told([MEETING[0], []], status=Status.TIMEOUT)
    assert "waits at the lawn for 40 s in vain for Person 1, then" in tell_agent(alone, 0)[0]


def test_who_gives_up_a_line_is_said_to():
    line = told([[(Action.QUEUE, VAN, (0, 5, 5, 125), 0, ())]], status=Status.TIMEOUT)
    assert tell_agent(line, 0)[0] == "00:05 Person 0 stands in line at the pizza van for 2:00 min and gives up."


def test_the_end_of_the_world_is_part_of_the_story():
    cut = told([[(Action.SIT, LAWN, (0, 5, 5, NAN), 0, ())]])
    assert tell_agent(cut, 0) == ["00:05 Person 0 sits at the lawn until the world ends."]
    waiting = told([[(Action.SIT, LAWN, (0, 5, NAN, NAN), 0, ())]])
    assert tell_agent(waiting, 0) == ["00:05 Person 0 waits at the lawn until the world ends."]
    walking = told([[(Action.SIT, LAWN, (0, NAN, NAN, NAN), 0, ())]])
    assert tell_agent(walking, 0) == ["00:00 Person 0 is on the way to the lawn when the world ends."]
    assert tell_agent(told([[]]), 0) == ["Person 0 has not come when the world ends."]
    assert tell_group(told([[]]), 0)[-1] == "Person 0 has not come when the world ends."


def test_going_into_a_building_is_told_from_what_was_seen():
    visit = [[(Action.SIT, LAWN, (0, 0, 0, 5), 0, ()), (Action.ENTER_EXIT, LIBRARY, (5, 20, 20, 23), 1, ())]]
    assert tell_agent(told(visit, hidden=True), 0)[1] == "00:20 goes into the library."
    outing = [[(Action.ENTER_EXIT, LIBRARY, (5, 5, 5, 8), 0, ()), (Action.SIT, LAWN, (8, 20, 20, 40), 1, ())]]
    assert tell_agent(told(outing), 0)[0] == "00:05 Person 0 comes out of the library."


@pytest.mark.parametrize(("tell", "what"), [(tell_agent, "person"), (tell_group, "group")])
@pytest.mark.parametrize("number", [-1, 9999])
def test_an_unknown_person_or_group_is_refused(world, tell, what, number):
    with pytest.raises(BriefError, match=f"there is no {what} {number} in this world; they are numbered 0 to"):
        tell(world, number)


# On an authored world.

SENTENCE = re.compile(r"\d\d:\d\d [A-Za-z][^{}]*\.")


def test_every_person_and_group_of_an_authored_world_has_a_story(world):
    for agent in range(len(world.plan.people)):
        lines = tell_agent(world, agent)
        assert all(SENTENCE.fullmatch(line) or "has not come" in line for line in lines)
        assert [line[:5] for line in lines] == sorted(line[:5] for line in lines)
    for group, caption in enumerate(world.plan.captions):
        lines = tell_group(world, group)
        assert lines[0].endswith(f": {caption}")
        assert all(SENTENCE.fullmatch(line) or "has not come" in line for line in lines[1:])


def test_everything_that_was_begun_is_told_to_the_group(world):
    n_told = sum(len(tell_group(world, group)) - 1 for group in range(len(world.plan.captions)))
    occasions = {world.plan.people[done.agent].activities[done.step].occasion for done in world.motion.executed}
    n_absent = len(world.plan.people) - len({done.agent for done in world.motion.executed})
    assert n_told == len(occasions) + n_absent


def test_a_world_is_told_minute_by_minute(world):
    lines = tell_world(world)
    assert lines[0] == world.provenance["text"]
    assert lines[1].startswith(f"{len(world.plan.people)} people in {len(world.plan.captions)} groups")
    minutes = [line for line in lines if re.match(r"\d\d:00 \d+ people are there", line)]
    assert len(minutes) == 11
    for minute, line in enumerate(minutes):
        counts = [int(n) for n in re.findall(r"(?:: |, )(\d+) ", line[5:])]
        n_there = int(line.split()[1])
        assert sum(counts) == n_there == world.motion.present[minute * 300].sum()
    assert sum(line.startswith("Group ") for line in lines) == 2


def test_a_note_of_the_planner_is_told(world):
    noted = replace(world, plan=replace(world.plan, notes=("this environment has no room",)))
    assert "this environment has no room" in tell_world(noted)
