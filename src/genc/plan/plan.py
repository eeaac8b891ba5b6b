"""`CrowdPlan`: for every person, a gapless row of activities."""

from __future__ import annotations

from dataclasses import dataclass

from genc.scenario.scenario import Environment
from genc.words.vocabulary import Action

ON_THE_WAY = (Action.CARRY, Action.TALK_ON_PHONE)
"""What people can do while they walk."""
ROAMING = (Action.WANDER, Action.CARRY)
"""What people do about a place, not at one slot."""


@dataclass(frozen=True)
class Slot:
    """A spot for one person: a point (x, y) in metres and a facing, radians counter-clockwise from +x."""

    position_m: tuple[float, float]
    facing_rad: float


@dataclass(frozen=True)
class Activity:
    """One thing that one person does at one place.

    Attributes:
        action: what is done.
        location: index into the environment's locations.
        slot: where in it.
        leave_s: when the person sets off for the slot; equals the end of the activity before.
        start_s: when the doing begins: everybody has arrived and, at a service, it is their turn.
        end_s: when it ends. `leave_s <= start_s <= end_s`; seconds from the beginning of the world.
        occasion: number of the joint doing; the activities of all partners carry the same number, and it is
            used by nobody else. Partners begin an occasion together.
        partners: the other people of the occasion, ascending agent numbers.
        implied: True where the plan needed it (coming in, leaving) and no graph node asked for it.
    """

    action: Action
    location: int
    slot: Slot
    leave_s: float
    start_s: float
    end_s: float
    occasion: int
    partners: tuple[int, ...] = ()
    implied: bool = False


def begins_on_the_way(before: Activity, activity: Activity) -> bool:
    """Whether somebody is to do a thing from the moment of setting off for its slot: on the phone, with a load."""
    return (
        activity.action in ON_THE_WAY
        and activity.start_s == activity.leave_s
        and activity.slot.position_m != before.slot.position_m
    )


@dataclass(frozen=True)
class Person:
    """One agent of the crowd.

    Attributes:
        group: the number of the group it belongs to; groups are numbered from 0.
        speed_mps: preferred walking speed.
        activities: in order; gapless: each `leave_s` is the `end_s` before it. The first `leave_s` is the
            moment of appearing in the scene.
        leaves: True if the person vanishes at the end of the last activity (an exit); otherwise the person
            stays in the last slot to the end of the world.
    """

    group: int
    speed_mps: float
    activities: tuple[Activity, ...]
    leaves: bool


@dataclass(frozen=True)
class CrowdPlan:
    """All people of a world with their plans; a person's number is its index in `people`.

    Attributes:
        environment: where it happens.
        people: the crowd.
        duration_s: length of the world.
        captions: for each group, one line saying what it was asked to be (text of its brief or caption).
        notes: what the planner had to change, one sentence each (a category that the layout lacks and what
            stood in for it, ...).
    """

    environment: Environment
    people: tuple[Person, ...]
    duration_s: float
    captions: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def members(self) -> dict[int, list[int]]:
        """For each group, by number, its people; nobody for one that has only a caption."""
        found: dict[int, list[int]] = {group: [] for group in range(len(self.captions))}
        for agent, person in enumerate(self.people):
            found.setdefault(person.group, []).append(agent)
        return dict(sorted(found.items()))

    def caption(self, group: int) -> str:
        """The caption of a group; empty if it has none."""
        return self.captions[group] if group < len(self.captions) else ""
