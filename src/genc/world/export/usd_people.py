"""The crowd as one prim for each person, to pick, to hide, to replace; and one for each group."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from genc.motion.motion import Motion
from genc.plan.plan import Activity
from genc.world.export.actions import PHASES, Doings, changes, doings
from genc.world.export.keyframes import stays
from genc.world.export.usd_scene import CROWD, ROOT, TimeCodes, add_figure, constant, group_colour, varying
from genc.world.world import World

FIGURE = f"{ROOT}/Person"
GROUPS = f"{ROOT}/Groups"


def add_people(stage: Any, world: World, times: TimeCodes) -> None:
    """A prim for each person: transform and visibility over time, action, phase, place, partners, group."""
    from pxr import Kind, Sdf, Usd, UsdGeom

    add_figure(stage, FIGURE, abstract=True)
    crowd = UsdGeom.Xform.Define(stage, CROWD)
    Usd.ModelAPI(crowd).SetKind(Kind.Tokens.group)
    UsdGeom.Scope.Define(stage, GROUPS)
    done = doings(world)
    digits = len(str(max(len(world.plan.people) - 1, 0)))
    paths = [f"{CROWD}/Agent_{agent:0{digits}}" for agent in range(len(world.plan.people))]
    _add_groups(stage, world, paths)
    for agent, path in enumerate(paths):
        figure, group = UsdGeom.Xform.Define(stage, path), world.plan.people[agent].group
        prim = figure.GetPrim()
        # inherited, not referenced: who uses the file can replace the figure of all by an opinion on the class
        prim.GetInherits().AddInherit(FIGURE)
        prim.SetInstanceable(True)
        colour = UsdGeom.PrimvarsAPI(prim).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "constant")
        colour.Set([group_colour(group)])
        constant(prim, "genc:agent", "Int").Set(agent)
        constant(prim, "genc:group", "Int").Set(group)
        prim.CreateRelationship("genc:groupPrim").SetTargets([f"{GROUPS}/Group_{group}"])
        with Sdf.ChangeBlock():
            _add_path(figure, world.motion, agent, times)
            _add_doings(prim, world, done, agent, times)


def _add_groups(stage: Any, world: World, paths: list[str]) -> None:
    from pxr import UsdGeom

    for group, agents in world.plan.members().items():
        if not agents:
            continue
        prim = UsdGeom.Scope.Define(stage, f"{GROUPS}/Group_{group}").GetPrim()
        constant(prim, "genc:caption", "String").Set(world.plan.caption(group))
        prim.CreateRelationship("genc:members").SetTargets([paths[agent] for agent in agents])


def _add_path(figure: Any, motion: Motion, agent: int, times: TimeCodes) -> None:
    from pxr import Gf

    translate, turn = figure.AddTranslateOp(), figure.AddRotateZOp()
    for stay in stays(motion, agent):
        keys = zip(stay.frames.tolist(), stay.positions_m.tolist(), np.degrees(stay.headings_rad).tolist(), strict=True)
        for frame, (x_m, y_m), turn_deg in keys:
            translate.Set(Gf.Vec3d(x_m, y_m, 0), times.at(frame))
            turn.Set(turn_deg, times.at(frame))
    there = motion.present[:, agent]
    seen = ((frame, "inherited" if there[frame] else "invisible") for frame in changes(there).tolist())
    _hold(figure.CreateVisibilityAttr(), seen, times)


def _add_doings(prim: Any, world: World, done: Doings, agent: int, times: TimeCodes) -> None:
    """What a person does, from change to change."""
    from pxr import Vt

    rows, phases = done.row[:, agent], done.phase[:, agent]
    frames = changes(rows * len(PHASES) + phases)
    now = [_activity(world, agent, row) for row in rows[frames].tolist()]
    places = world.plan.environment.locations
    values: dict[tuple[str, str], list[Any]] = {
        ("action", "Token"): [activity.action.value if activity else "none" for activity in now],
        ("phase", "Token"): [PHASES[phase] if a else "none" for phase, a in zip(phases[frames], now, strict=True)],
        ("place", "String"): [places[activity.location].name if activity else "" for activity in now],
        ("partners", "IntArray"): [Vt.IntArray(activity.partners if activity else ()) for activity in now],
    }
    for (name, kind), samples in values.items():
        _hold(varying(prim, f"genc:{name}", kind), zip(frames.tolist(), samples, strict=True), times)


def _activity(world: World, agent: int, row: int) -> Activity | None:
    return None if row < 0 else world.plan.people[agent].activities[world.motion.executed[row].step]


def _hold(attribute: Any, samples: Iterable[tuple[int, Any]], times: TimeCodes) -> None:
    """Writes a value where it differs from the one before: in between it holds."""
    before = None
    for frame, value in samples:
        if value != before:
            attribute.Set(value, times.at(frame))
            before = value
