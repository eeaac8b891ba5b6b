"""`Motion`: where everybody was at every frame, and what they really did."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray


class Status(StrEnum):
    """How an executed activity ended."""

    DONE = "done"
    TIMEOUT = "timeout"
    """A partner or a free place was waited for up to the limit; the person went on."""
    CUT = "cut"
    """The world ended first."""


@dataclass(frozen=True)
class Executed:
    """What became of one planned activity.

    Attributes:
        agent: index into the plan's people.
        step: index into that person's activities.
        leave_s, arrive_s, start_s, end_s: real times: set off, reached the slot (or the end of the queue),
            began, ended; NaN for what the end of the world did not let happen.
        position_m: where it was done, (x, y).
        facing_rad: the way the person faced while doing it.
        status: how it ended.
    """

    agent: int
    step: int
    leave_s: float
    arrive_s: float
    start_s: float
    end_s: float
    position_m: tuple[float, float]
    facing_rad: float
    status: Status


@dataclass(frozen=True, eq=False)
class Motion:
    """Frames of all people.

    Attributes:
        dt_s: seconds between frames; frame `t` is at `t * dt_s`.
        positions_m: float32 `[t, a, 2]`; where a person is absent, the last or next place it has.
        headings_rad: float32 `[t, a]`, counter-clockwise from +x.
        present: bool `[t, a]`.
        executed: one entry for each activity that was begun (set off for), ordered by agent, then step.
    """

    dt_s: float
    positions_m: NDArray[np.float32]
    headings_rad: NDArray[np.float32]
    present: NDArray[np.bool_]
    executed: tuple[Executed, ...]

    def __post_init__(self) -> None:
        t, a = self.present.shape
        if self.positions_m.shape != (t, a, 2) or self.headings_rad.shape != (t, a):
            raise ValueError(
                f"positions {self.positions_m.shape} and headings {self.headings_rad.shape}"
                f" do not match present {self.present.shape}"
            )
