"""JSON for game engines: boxes, people, what they do when, and keyframed paths, in the engine's own axes and units."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from genc.files import write_text
from genc.motion.motion import Executed
from genc.plan.plan import Person
from genc.world.export.keyframes import ERROR_M, ERROR_RAD, Stay, stays
from genc.world.export.solids import boxes
from genc.world.world import World

FORMAT = "genc engine"
SCHEMA = 1
NEVER_S = -1.0
"""Stands for a time that the end of the world did not let come: not every reader of JSON knows null."""


@dataclass(frozen=True)
class Axes:
    """How an engine sees space.

    Attributes:
        engine: its name.
        rows: what x, y and z of the engine are, as sums of x, y and z in metres, right-handed, z up.
        yaw_zero_deg: the yaw of somebody who faces +x; yaw is clockwise seen from above.
        n_decimals: of a length.
        said: the axes and units in words, for the file.
    """

    engine: str
    rows: tuple[tuple[float, float, float], ...]
    yaw_zero_deg: float
    n_decimals: int
    said: dict[str, dict[str, str]]

    def points(self, points_m: ArrayLike) -> list[float]:
        """The coordinates of points `[n, 2]` or `[n, 3]`, one after the other: x, y, z, x, y, z, ..."""
        points = np.asarray(points_m, dtype=np.float64)
        return self._short(points @ np.array(self.rows).T[: points.shape[-1]], self.n_decimals)

    def size(self, size_m: Sequence[float]) -> list[float]:
        """The extents of a box."""
        return self._short(np.abs(np.array(self.rows)) @ np.array(size_m), self.n_decimals)

    def yaws_deg(self, headings_rad: ArrayLike) -> list[float]:
        """Headings as yaws."""
        return self._short(self.yaw_zero_deg - np.degrees(headings_rad), 1)

    @staticmethod
    def _short(values: ArrayLike, n_decimals: int) -> list[float]:
        # adding zero turns -0.0 into 0.0
        rounded = np.round(np.asarray(values, dtype=np.float64).ravel(), n_decimals) + 0.0
        return [int(value) if value.is_integer() else value for value in rounded.tolist()]


def write_engine(world: World, file: Path, axes: Axes) -> tuple[Path, ...]:
    """Writes a world as JSON of `SCHEMA`, one line for each place and person."""
    head = {
        "format": FORMAT,
        "schema": SCHEMA,
        "engine": axes.engine,
        **axes.said,
        "provenance": dict(world.provenance),
        "duration_s": world.plan.duration_s,
        "max_error": {"position_m": ERROR_M, "yaw_deg": round(math.degrees(ERROR_RAD), 3)},
    }
    lists = {
        "environment": _environment(world, axes),
        "groups": _groups(world),
        "agents": _agents(world, axes),
    }
    parts = [f"{_json(key)}:{_json(value)}" for key, value in head.items()]
    parts += [f"{_json(key)}:[\n" + ",\n".join(map(_json, rows)) + "\n]" for key, rows in lists.items()]
    write_text(file, "{" + ",\n".join(parts) + "}\n")
    return (file,)


def _environment(world: World, axes: Axes) -> list[dict[str, Any]]:
    return [
        {
            "name": box.name,
            "category": box.category,
            "solid": box.solid,
            "center": axes.points([box.centre_m]),
            "size": axes.size(box.size_m),
        }
        for box in boxes(world.plan.environment)
    ]


def _groups(world: World) -> list[dict[str, Any]]:
    plan = world.plan
    return [{"id": g, "caption": plan.caption(g), "agents": agents} for g, agents in plan.members().items()]


def _agents(world: World, axes: Axes) -> list[dict[str, Any]]:
    executed: list[list[Executed]] = [[] for _ in world.plan.people]
    for done in world.motion.executed:
        executed[done.agent].append(done)
    return [
        {
            "id": agent,
            "group": person.group,
            "speed_mps": round(person.speed_mps, 3),
            "activities": [_activity(person, done, axes) for done in executed[agent]],
            "stays": [_stay(stay, world.motion.dt_s, axes) for stay in stays(world.motion, agent)],
        }
        for agent, person in enumerate(world.plan.people)
    ]


def _activity(person: Person, done: Executed, axes: Axes) -> dict[str, Any]:
    activity = person.activities[done.step]
    times_s = {
        "leave_s": done.leave_s,
        "arrive_s": done.arrive_s,
        "start_s": done.start_s,
        "end_s": done.end_s,
    }
    return {
        "step": done.step,
        "action": activity.action,
        "location": activity.location,
        "partners": activity.partners,
        **{name: NEVER_S if math.isnan(t_s) else round(t_s, 3) for name, t_s in times_s.items()},
        "point": axes.points([done.position_m]),
        "yaw_deg": axes.yaws_deg(done.facing_rad)[0],
        "status": done.status,
    }


def _stay(stay: Stay, dt_s: float, axes: Axes) -> dict[str, list[float]]:
    return {
        "times_s": np.round(stay.frames * dt_s, 3).tolist(),
        "points": axes.points(stay.positions_m),
        "yaws_deg": axes.yaws_deg(stay.headings_rad),
    }


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
