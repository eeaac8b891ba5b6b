"""The tables of a world as columns: where people were, what they did, who they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.motion.motion import Motion
from genc.world.activity_table import COLUMNS, table_rows
from genc.world.export.actions import ACTION_NAMES, PHASES, doings
from genc.world.world import World

INTEGER_COLUMNS = ("agent", "step", "occasion", "implied")
TEXT_COLUMNS = ("action", "location", "partners", "status")
"""All other columns of the activity table are real numbers."""
_N_ROWS_AT_ONCE = 100_000


@dataclass(frozen=True)
class Coded:
    """A column of few words: `words[codes[i]]` stands in row `i`."""

    codes: NDArray[np.uint8]
    words: Sequence[str]

    def spelled(self) -> NDArray[np.object_]:
        """The words of all rows."""
        return np.array(self.words, dtype=object)[self.codes]


@dataclass(frozen=True)
class Trajectories:
    """One row for each person in each frame in which it is in the scene, by agent, then frame.

    Attributes:
        x_m, y_m: to the millimetre.
        heading_rad: in [-pi, pi], to a ten-thousandth.
        action, phase: what the person is doing, see `actions`.
    """

    agent: NDArray[np.int32]
    frame: NDArray[np.int32]
    t_s: NDArray[np.float64]
    x_m: NDArray[np.float64]
    y_m: NDArray[np.float64]
    heading_rad: NDArray[np.float64]
    action: Coded
    phase: Coded


def trajectories(world: World) -> Trajectories:
    """Where everybody was at every frame, and at what."""
    motion, done = world.motion, doings(world)
    agent, frame = np.nonzero(motion.present.T)
    at_m = motion.positions_m[frame, agent]
    return Trajectories(
        agent.astype(np.int32),
        frame.astype(np.int32),
        np.round(frame * motion.dt_s, 6),
        _rounded(at_m[:, 0], 3),
        _rounded(at_m[:, 1], 3),
        _rounded(motion.headings_rad[frame, agent], 4),
        Coded(done.action[frame, agent], ACTION_NAMES),
        Coded(done.phase[frame, agent], PHASES),
    )


def activities(world: World) -> dict[str, list[Any]]:
    """The activity table (`docs/formats.md`) by column; None where a cell is empty, but "" for no partners."""
    rows = table_rows(world.plan, world.motion.executed)
    columns = zip(*rows, strict=True)
    table: dict[str, list[Any]] = {name: list(column) for name, column in zip(COLUMNS, columns, strict=False)}
    return {name: _nones(table.get(name, []), name) for name in COLUMNS}


def people(world: World) -> dict[str, list[Any]]:
    """Everybody, by column: agent, group, preferred speed, leaves (1 or 0), caption of the group."""
    crowd = world.plan.people
    return {
        "agent": list(range(len(crowd))),
        "group": [person.group for person in crowd],
        "speed_mps": [person.speed_mps for person in crowd],
        "leaves": [int(person.leaves) for person in crowd],
        "caption": [world.plan.caption(person.group) for person in crowd],
    }


def fps(motion: Motion) -> float:
    """Frames per second."""
    return round(1 / motion.dt_s, 9)


def rows_of(columns: Sequence[NDArray[Any]]) -> Iterator[tuple[Any, ...]]:
    """The rows of some columns as Python values, a part of them in memory at a time."""
    for begin in range(0, len(columns[0]), _N_ROWS_AT_ONCE):
        yield from zip(*(column[begin : begin + _N_ROWS_AT_ONCE].tolist() for column in columns), strict=True)


def _nones(column: list[Any], name: str) -> list[Any]:
    return column if name == "partners" else [None if cell == "" else cell for cell in column]


def _rounded(values: NDArray[np.float32], n_decimals: int) -> NDArray[np.float64]:
    # adding zero turns -0.0 into 0.0
    return np.asarray(np.round(values.astype(np.float64), n_decimals) + 0.0, dtype=np.float64)
