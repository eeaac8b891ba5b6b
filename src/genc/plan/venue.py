"""What a place offers to a schedule: ways in and out, services, and how far it is from slot to slot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from genc.plan.plan import Activity, Slot
from genc.plan.slots import Places
from genc.plan.walkable import Walkable, is_solid
from genc.scenario.scenario import Environment
from genc.words.vocabulary import Action, Category


class Venue:
    """An environment with its slots and its ground; it has an entrance."""

    def __init__(self, environment: Environment, places: Sequence[Places], walkable: Walkable) -> None:
        self.environment, self.places, self.walkable = environment, places, walkable
        categories = [location.category for location in environment.locations]
        self.entrances = [i for i, category in enumerate(categories) if category is Category.ENTRANCE]
        solid = is_solid(environment)
        buildings = {i for i, category in enumerate(categories) if category is Category.BUILDING and solid[i]}
        self._ways_out = buildings.union(self.entrances)

    def is_passage(self, action: Action, location: int) -> bool:
        """Whether people come into sight by it or go out of it; a room is only walked into."""
        return action is Action.ENTER_EXIT and location in self._ways_out

    def gate(self, near: Slot) -> tuple[int, Slot]:
        """The entrance nearest to a slot, and its door."""
        doors = [(i, self.places[i].door) for i in self.entrances]
        return min(doors, key=lambda door: math.dist(door[1].position_m, near.position_m))

    def serves(self, location: int) -> bool:
        """Whether people take turns at it."""
        category = self.environment.locations[location].category
        return category in (Category.SERVICE_AREA, Category.ITEM) and bool(self.places[location].service)

    def is_service_slot(self, activity: Activity) -> bool:
        """Whether an activity keeps others from being served."""
        return any(activity.slot is slot for slot in self.places[activity.location].service)

    def behind(self, location: int) -> tuple[float, float]:
        """The far side of a counter, where staff stand."""
        x, y = self.environment.locations[location].position_m
        service = self.places[location].service
        at_x, at_y = service[len(service) // 2].position_m
        return 2 * x - at_x, 2 * y - at_y

    def way_m(self, start: Slot, end: Slot) -> float:
        """Metres of the shortest way between two slots."""
        if start.position_m == end.position_m:
            return 0.0
        return float(self.walkable.distances([start.position_m], [end.position_m])[0, 0])

    @cached_property
    def ways_m(self) -> NDArray[np.float64]:
        """`[n_locations, n_locations]` metres of the shortest way from door to door."""
        doors_m = [place.door.position_m for place in self.places]
        return self.walkable.distances(doors_m, doors_m)
