"""What both USD files share: the time codes, the environment as prims, and the figure that stands for a person."""

from __future__ import annotations

import colorsys
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from genc.plan.walkable import Walkable
from genc.scenario.scenario import Environment
from genc.world.export.solids import COLOUR, boxes

ROOT = "/World"
ENVIRONMENT = f"{ROOT}/Environment"
CROWD = f"{ROOT}/Crowd"
_GROUND_COLOUR = (0.76, 0.76, 0.74)
_GROUND_DEPTH_M = -0.002
_BEST_RATE = 25.0
_GOLDEN = 0.618033988749895
"""Steps of this share of a circle give many hues without two near each other."""


@dataclass(frozen=True)
class TimeCodes:
    """Time codes of frames: whole numbers, near to 25 a second, so that a film of few frames still runs smoothly."""

    per_frame: int
    per_second: float

    @staticmethod
    def of(dt_s: float) -> TimeCodes:
        """For frames at that distance."""
        per_frame = max(1, round(_BEST_RATE * dt_s))
        return TimeCodes(per_frame, round(per_frame / dt_s, 9))

    def at(self, frame: int) -> int:
        """The time code of a frame."""
        return self.per_frame * frame


def prim_names(names: Sequence[str]) -> list[str]:
    """For each name a prim name that every tool takes: ASCII letters, digits and `_`; no two the same."""
    taken: set[str] = set()
    found = []
    for name in names:
        ascii_only = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
        base = re.sub(r"\W+", "_", ascii_only, flags=re.ASCII).strip("_") or "place"
        base = f"_{base}" if base[0].isdigit() else base
        candidate, n = base, 1
        while candidate.lower() in taken:
            n += 1
            candidate = f"{base}_{n}"
        taken.add(candidate.lower())
        found.append(candidate)
    return found


def group_colour(group: int) -> tuple[float, float, float]:
    """The colour of a group."""
    return colorsys.hsv_to_rgb(group * _GOLDEN % 1.0, 0.65, 0.85)


def constant(prim: Any, name: str, kind: str) -> Any:
    """A new attribute of our own that does not change over time; `kind` as in `Sdf.ValueTypeNames`."""
    from pxr import Sdf

    return prim.CreateAttribute(name, getattr(Sdf.ValueTypeNames, kind), True, Sdf.VariabilityUniform)


def varying(prim: Any, name: str, kind: str) -> Any:
    """A new attribute of our own that changes over time."""
    from pxr import Sdf

    return prim.CreateAttribute(name, getattr(Sdf.ValueTypeNames, kind), True, Sdf.VariabilityVarying)


def add_environment(stage: Any, environment: Environment) -> None:
    """A cube for each location, with its true name and category, and the ground below."""
    from pxr import Gf, Kind, Usd, UsdGeom

    scope = UsdGeom.Xform.Define(stage, ENVIRONMENT)
    Usd.ModelAPI(scope).SetKind(Kind.Tokens.group)
    # The name of the ground is taken first, so that a location of that name gets another.
    ground_name, *names = prim_names(["Ground", *(place.name for place in environment.locations)])
    _add_ground(stage, f"{ENVIRONMENT}/{ground_name}", Walkable.of(environment).bounds_m)
    for box, name in zip(boxes(environment), names, strict=True):
        cube = UsdGeom.Cube.Define(stage, f"{ENVIRONMENT}/{name}")
        cube.CreateSizeAttr(1.0)
        cube.CreateExtentAttr([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)])
        cube.AddTranslateOp().Set(Gf.Vec3d(*box.centre_m))
        cube.AddScaleOp().Set(Gf.Vec3f(*box.size_m))
        cube.CreateDisplayColorAttr([COLOUR[box.category]])
        prim = cube.GetPrim()
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
        prim.SetDisplayName(box.name)
        constant(prim, "genc:name", "String").Set(box.name)
        constant(prim, "genc:category", "Token").Set(box.category.value)
        constant(prim, "genc:solid", "Bool").Set(box.solid)


def _add_ground(stage: Any, path: str, bounds_m: tuple[float, float, float, float]) -> None:
    from pxr import UsdGeom

    x0, y0, x1, y1 = bounds_m
    corners = [(x, y, _GROUND_DEPTH_M) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))]
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(corners)
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateExtentAttr([corners[0], corners[2]])
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateDisplayColorAttr([_GROUND_COLOUR])


FIGURE_M = ((-0.25, -0.25, 0.0), (0.25, 0.25, 1.75))
"""The box round the figure."""


def add_figure(stage: Any, path: str, *, abstract: bool) -> None:
    """Somebody 1.75 m tall who faces +x, feet at the origin: a body, a head and a nose; `abstract` for a class."""
    from pxr import Gf, Sdf, UsdGeom

    figure = UsdGeom.Xform.Define(stage, path)
    if abstract:
        figure.GetPrim().SetSpecifier(Sdf.SpecifierClass)
    body = UsdGeom.Capsule.Define(stage, f"{path}/Body")
    body.CreateAxisAttr(UsdGeom.Tokens.z)
    body.CreateRadiusAttr(0.22)
    body.CreateHeightAttr(1.02)
    body.CreateExtentAttr([(-0.22, -0.22, -0.73), (0.22, 0.22, 0.73)])
    body.AddTranslateOp().Set(Gf.Vec3d(0, 0, 0.73))
    for name, radius_m, x_m, z_m in (("Head", 0.14, 0.0, 1.61), ("Nose", 0.05, 0.15, 1.6)):
        ball = UsdGeom.Sphere.Define(stage, f"{path}/{name}")
        ball.CreateRadiusAttr(radius_m)
        ball.CreateExtentAttr([(-radius_m,) * 3, (radius_m,) * 3])
        ball.AddTranslateOp().Set(Gf.Vec3d(x_m, 0, z_m))
