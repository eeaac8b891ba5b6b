"""What everybody is doing at every frame."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.words.vocabulary import ACTION_INDEX, ACTIONS
from genc.world.world import World

PHASES = ("walk", "wait", "do")
"""On the way to it; there, and waiting for it to begin (or done with everything); at it."""
ACTION_NAMES = (*ACTIONS, "none")
NO_ACTION = len(ACTIONS)

_PHASES_FROM = (PHASES.index("walk"), PHASES.index("wait"), PHASES.index("do"), PHASES.index("wait"))
"""The phase that begins when somebody sets off, arrives, begins, ends."""


@dataclass(frozen=True, eq=False)
class Doings:
    """What everybody is doing at every frame; see `docs/formats.md` for the times between which a phase lasts.

    Attributes:
        row: int32 `[t, a]`, the index into the executed activities; -1 for who has not set off for anything yet.
        phase: uint8 `[t, a]`, the index into `PHASES`; 0 where there is no row.
        action_of_row: uint8 `[n_executed]`, the index into `ACTION_NAMES`.
    """

    row: NDArray[np.int32]
    phase: NDArray[np.uint8]
    action_of_row: NDArray[np.uint8]

    @cached_property
    def action(self) -> NDArray[np.uint8]:
        """uint8 `[t, a]`, the index into `ACTION_NAMES`."""
        return np.append(self.action_of_row, np.uint8(NO_ACTION))[self.row]


def doings(world: World) -> Doings:
    """What everybody is doing at every frame of a world."""
    motion, people = world.motion, world.plan.people
    executed = motion.executed
    times_s = np.array([(e.leave_s, e.arrive_s, e.start_s, e.end_s) for e in executed]).reshape(-1, 4)
    agents = np.array([e.agent for e in executed], dtype=np.int64)
    actions = [ACTION_INDEX[people[e.agent].activities[e.step].action] for e in executed]
    # Events are numbered from 1 in order of agent and time, so that the latest one is the highest one.
    latest = np.zeros(motion.present.shape, dtype=np.int32)
    frames = np.ceil(times_s / motion.dt_s - 1e-6).ravel()
    number = np.flatnonzero(frames < len(latest))
    latest[frames[number].astype(np.int64), agents[number // 4]] = number + 1
    np.maximum.accumulate(latest, axis=0, out=latest)
    begun = latest > 0
    event = np.maximum(latest - 1, 0)
    row = np.where(begun, event // 4, -1).astype(np.int32)
    phase = np.where(begun, np.array(_PHASES_FROM, np.uint8)[event % 4], 0).astype(np.uint8)
    return Doings(row, phase, np.array(actions, dtype=np.uint8))


def changes(values: NDArray[Any]) -> NDArray[np.int64]:
    """The first frame and each at which something differs from the frame before; `values` is `[t]` or `[t, a]`."""
    differs = (values[1:] != values[:-1]).any(axis=tuple(range(1, values.ndim)))
    return np.concatenate([[0], np.flatnonzero(differs) + 1])[: len(values)].astype(np.int64)
