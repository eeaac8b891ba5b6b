"""The crowd as one point instancer: an array for each frame, quick to load and to draw."""

from __future__ import annotations

from typing import Any

import numpy as np

from genc.motion.motion import Motion
from genc.world.export.actions import ACTION_NAMES, PHASES, changes, doings
from genc.world.export.usd_scene import CROWD, FIGURE_M, TimeCodes, add_figure, constant, group_colour
from genc.world.world import World


def add_instances(stage: Any, world: World, times: TimeCodes) -> None:
    """A point instancer with all people; who is not in the scene is invisible."""
    from pxr import UsdGeom, Vt

    people, n_agents = world.plan.people, len(world.plan.people)
    crowd = UsdGeom.PointInstancer.Define(stage, CROWD)
    figure = f"{CROWD}/Prototypes/Person"
    UsdGeom.Scope.Define(stage, f"{CROWD}/Prototypes")
    add_figure(stage, figure, abstract=False)
    crowd.CreatePrototypesRel().SetTargets([figure])
    crowd.CreateProtoIndicesAttr(Vt.IntArray(n_agents, 0))
    crowd.CreateIdsAttr(Vt.Int64Array(range(n_agents)))
    _add_motion(crowd, world.motion, times)
    _add_doings(crowd, world, times)
    _primvar(crowd, "genc:group", "IntArray").Set(Vt.IntArray([person.group for person in people]))
    colours = Vt.Vec3fArray([group_colour(person.group) for person in people])
    _primvar(crowd, "displayColor", "Color3fArray").Set(colours)
    constant(crowd.GetPrim(), "genc:captions", "StringArray").Set(Vt.StringArray(list(world.plan.captions)))


def _add_motion(crowd: Any, motion: Motion, times: TimeCodes) -> None:
    from pxr import Sdf, Vt

    positions, orientations = crowd.CreatePositionsAttr(), crowd.CreateOrientationsAttr()
    hidden = crowd.CreateInvisibleIdsAttr()
    n_frames, n_agents = motion.present.shape
    at_m = np.zeros((n_frames, n_agents, 3), dtype=np.float32)
    at_m[..., :2] = motion.positions_m
    # without jumps, so that nobody turns the long way round between two frames
    half_rad = np.unwrap(motion.headings_rad, axis=0) / 2
    turns = np.zeros((n_frames, n_agents, 4), dtype=np.float16)
    turns[..., 2], turns[..., 3] = np.sin(half_rad), np.cos(half_rad)
    with Sdf.ChangeBlock():
        for frame in range(n_frames):
            positions.Set(Vt.Vec3fArray.FromNumpy(at_m[frame]), times.at(frame))
            orientations.Set(Vt.QuathArray.FromNumpy(turns[frame]), times.at(frame))
        for frame in changes(motion.present).tolist():
            hidden.Set(Vt.Int64Array.FromNumpy(np.flatnonzero(~motion.present[frame])), times.at(frame))
    crowd.CreateExtentAttr(_extent(motion))


def _add_doings(crowd: Any, world: World, times: TimeCodes) -> None:
    from pxr import Sdf, Vt

    done = doings(world)
    for name, codes, words in (("action", done.action, ACTION_NAMES), ("phase", done.phase, PHASES)):
        primvar = _primvar(crowd, f"genc:{name}", "IntArray")
        with Sdf.ChangeBlock():
            for frame in changes(codes).tolist():
                primvar.Set(Vt.IntArray.FromNumpy(codes[frame].astype(np.int32)), times.at(frame))
        constant(crowd.GetPrim(), f"genc:{name}Names", "TokenArray").Set(Vt.TokenArray(list(map(str, words))))


def _extent(motion: Motion) -> list[tuple[float, float, float]]:
    """The box round everybody at all times."""
    seen_m = motion.positions_m[motion.present]
    if not len(seen_m):
        return list(FIGURE_M)
    (x0, y0), (x1, y1) = seen_m.min(axis=0).tolist(), seen_m.max(axis=0).tolist()
    low, high = FIGURE_M
    return [(x0 + low[0], y0 + low[1], low[2]), (x1 + high[0], y1 + high[1], high[2])]


def _primvar(crowd: Any, name: str, kind: str) -> Any:
    """A new value for each instance."""
    from pxr import Sdf, UsdGeom

    return UsdGeom.PrimvarsAPI(crowd).CreatePrimvar(name, getattr(Sdf.ValueTypeNames, kind), UsdGeom.Tokens.vertex)
