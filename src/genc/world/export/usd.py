"""OpenUSD: one file with the crowd as instances of one prototype, one with a prim for each person."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from genc.files import written_beside
from genc.world.export.usd_instances import add_instances
from genc.world.export.usd_people import add_people
from genc.world.export.usd_scene import ROOT, TimeCodes, add_environment
from genc.world.world import World


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `crowd_instances.usdc` and `crowd_people.usdc`."""
    crowds = {"crowd_instances.usdc": add_instances, "crowd_people.usdc": add_people}
    return tuple(_write_stage(world, folder / name, add_crowd) for name, add_crowd in crowds.items())


def _write_stage(world: World, file: Path, add_crowd: Callable[[Any, World, TimeCodes], None]) -> Path:
    from pxr import Tf

    times = TimeCodes.of(world.motion.dt_s)
    stage = _stage(world, times)
    add_environment(stage, world.plan.environment)
    add_crowd(stage, world, times)
    with written_beside(file) as part:
        try:
            stage.GetRootLayer().Export(str(part))
        except Tf.ErrorException as error:
            # one of many lines, each: where in the library : 'what is wrong'
            first = str(error).strip().splitlines()[0]
            raise OSError(first.rpartition(" : ")[2].strip("' ")) from error
    return file


def _stage(world: World, times: TimeCodes) -> Any:
    from pxr import Kind, Usd, UsdGeom

    # The name says of what kind the file is to be, whatever its own name is while it is written.
    stage = Usd.Stage.CreateInMemory("crowd.usdc")
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, UsdGeom.LinearUnits.meters)
    stage.SetTimeCodesPerSecond(times.per_second)
    stage.SetFramesPerSecond(times.per_second)
    stage.SetStartTimeCode(0)
    stage.SetEndTimeCode(times.at(len(world.motion.present) - 1))
    root = UsdGeom.Xform.Define(stage, ROOT)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
    stage.SetDefaultPrim(root.GetPrim())
    provenance = {key: value for key, value in world.provenance.items() if value is not None}
    root.GetPrim().SetCustomDataByKey("genc", provenance)
    return stage
