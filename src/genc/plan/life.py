"""`Life`: how far one person's row has come while a schedule is made."""

from __future__ import annotations

from dataclasses import dataclass, field

from genc.plan.plan import Activity
from genc.plan.seating import Seat


@dataclass(eq=False)
class Life:
    """How far one person's row has come.

    Attributes:
        comes_s: when the person comes in; None for who is there from the beginning.
        row: the numbers of the person's occasions.
        workplace: the location of a service that the person runs, or None.
        seat, location: where the person is after all that is scheduled; None and -1 before the first.
        leaves: whether the last doing takes the person out of sight for good.
    """

    group: int
    comes_s: float | None
    speed_mps: float
    row: list[int]
    workplace: int | None = None
    activities: list[Activity] = field(default_factory=list)
    seat: Seat | None = None
    location: int = -1
    n_done: int = 0
    leaves: bool = False

    @property
    def end_s(self) -> float:
        """When the last scheduled doing ends."""
        return self.activities[-1].end_s if self.activities else self.comes_s or 0.0

    def add(self, activity: Activity, seat: Seat) -> None:
        """Adds a doing to the row; the seat before is free from its beginning on."""
        if self.seat is not None and self.seat is not seat:
            self.seat.until_s = self.end_s
        self.activities.append(activity)
        self.seat, self.location = seat, activity.location

    def next(self, skip: int = 0) -> int | None:
        """The number of the next occasion, or of one after it; None at the end of the row."""
        at = self.n_done + skip
        return self.row[at] if at < len(self.row) else None
