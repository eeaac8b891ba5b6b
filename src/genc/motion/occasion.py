"""Occasions at run time, and the record of what became of every activity."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from genc.motion.clock import Signal
from genc.motion.motion import Executed, Status
from genc.plan.plan import Activity, CrowdPlan


@dataclass(eq=False)
class Occasion:
    """One joint doing on its way from the first arrival to the end.

    Attributes:
        steps: for each member, which of the person's activities it is.
        activity: the activity of the first member; all others differ from it in their slot only.
        here: who has arrived in time, in order of arrival.
        gathered: all are here, or those who are here wait no longer.
        begun, over: it has begun, it has ended.
        timed_out: somebody did not come in time, or the turn did not.
    """

    steps: dict[int, int]
    activity: Activity
    here: list[int] = field(default_factory=list)
    gathered: Signal = field(default_factory=Signal)
    begun: Signal = field(default_factory=Signal)
    over: Signal = field(default_factory=Signal)
    timed_out: bool = False

    @property
    def duration_s(self) -> float:
        """How long it is planned to take."""
        return self.activity.end_s - self.activity.start_s


def occasions(plan: CrowdPlan) -> dict[int, Occasion]:
    """The occasions of a plan by number."""
    found: dict[int, Occasion] = {}
    for agent, person in enumerate(plan.people):
        for step, activity in enumerate(person.activities):
            found.setdefault(activity.occasion, Occasion({}, activity)).steps[agent] = step
    return found


@dataclass
class Row:
    """What is known so far of one activity; the fields of `Executed`."""

    agent: int
    step: int
    leave_s: float
    arrive_s: float = math.nan
    start_s: float = math.nan
    end_s: float = math.nan
    position_m: tuple[float, float] = (math.nan, math.nan)
    facing_rad: float = math.nan
    status: Status = Status.CUT

    def executed(self) -> Executed:
        """The row, closed."""
        return Executed(**vars(self))
