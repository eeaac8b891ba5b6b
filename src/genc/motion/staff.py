"""Who works at a service, and where they stand.

A plan does not say who serves and who is served: both "use" the pizza van. Somebody who is there when the world
begins, is not in line, and does at least half of all their things there, works there. Staff stand behind the counter
and take no customer's turn.
"""

from __future__ import annotations

import math

import numpy as np

from genc.plan.plan import CrowdPlan, Person, Slot
from genc.plan.walkable import Walkable
from genc.scenario.scenario import Location
from genc.words.vocabulary import Action, Category


def workplaces(plan: CrowdPlan) -> list[int | None]:
    """For each person, the location where they work, or None."""
    return [_workplace(plan, person) for person in plan.people]


def behind(location: Location, service: Slot, walkable: Walkable) -> Slot:
    """Where staff stand: on the other side of the counter, facing whom they serve."""
    (x_m, y_m), (at_x_m, at_y_m) = location.position_m, service.position_m
    across_m = walkable.snap(np.array([[2 * x_m - at_x_m, 2 * y_m - at_y_m]]))[0].tolist()
    facing_rad = math.atan2(at_y_m - across_m[1], at_x_m - across_m[0])
    return Slot((across_m[0], across_m[1]), facing_rad)


def _workplace(plan: CrowdPlan, person: Person) -> int | None:
    wanted = [activity for activity in person.activities if not activity.implied]
    if not wanted or wanted[0].leave_s > 0 or wanted[0].action in (Action.QUEUE, Action.ENTER_EXIT):
        return None
    place = wanted[0].location
    if plan.environment.locations[place].category is not Category.SERVICE_AREA:
        return None
    n_there = sum(activity.location == place for activity in wanted)
    return place if 2 * n_there >= len(wanted) else None
