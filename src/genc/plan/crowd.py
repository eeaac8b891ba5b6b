"""The door of the room: groups of records and an environment become a `CrowdPlan`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from genc.errors import LayoutError
from genc.plan.arrivals import Cast
from genc.plan.occasion import occasions_of
from genc.plan.place import WAY_IN, Chooser, with_way_in
from genc.plan.plan import CrowdPlan
from genc.plan.schedule import schedule
from genc.plan.seating import Seating
from genc.plan.slots import places_of
from genc.plan.venue import Venue
from genc.plan.walkable import Walkable
from genc.scenario.record import Record
from genc.scenario.scenario import Environment


@dataclass(frozen=True, eq=False)
class PlanRequest:
    """What a plan is to respect.

    Attributes:
        duration_s: length of the world.
        captions: one line for each group.
        affinity: `[n_groups, n_locations]` how well each location's name suits each group's text; None for no matter.
        triggers: for an event, the event that must have ended before it begins; events are numbered as in the records,
            which must then be numbered over the whole crowd.
        notes: what the asker has to be told already.
    """

    duration_s: float
    captions: tuple[str, ...] = ()
    affinity: NDArray[np.float64] | None = None
    triggers: Mapping[int, int] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def plan_crowd(
    groups: Sequence[Sequence[Record]], environment: Environment, request: PlanRequest, rng: np.random.Generator
) -> CrowdPlan:
    """Everybody's timed activities at concrete slots; people are numbered by group, then agent.

    Raises:
        LayoutError: for an environment of fewer than two locations.
    """
    if len(environment.locations) < 2:
        raise LayoutError(
            f"an environment of {len(environment.locations)} location cannot hold a crowd: give it an entrance and "
            "at least one more"
        )
    layout = with_way_in(environment)
    walkable = Walkable.of(layout)
    venue = Venue(layout, places_of(layout, walkable), walkable)
    affinity = request.affinity
    if affinity is not None and len(layout.locations) > affinity.shape[1]:
        affinity = np.pad(affinity, ((0, 0), (0, len(layout.locations) - affinity.shape[1])))
    occasions = occasions_of(groups)
    locations, notes = Chooser(venue, affinity).choose(occasions, rng)
    if layout is not environment:
        notes.insert(0, f"this environment has no entrance: a {WAY_IN} was added at its edge")
    cast = Cast(occasions, locations, request.triggers)
    people = schedule(cast, Seating(venue, rng), request.duration_s, rng)
    return CrowdPlan(layout, people, request.duration_s, request.captions, (*request.notes, *notes))
