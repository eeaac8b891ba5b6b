"""The free ground as one polygon, for tools that want it so: JuPedSim, PedPy. Needs shapely."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from genc.plan.walkable import BODY_RADIUS_M, Walkable

if TYPE_CHECKING:
    from shapely import Polygon

_LEAST_GAP_M = 2 * BODY_RADIUS_M
"""Nobody fits through less; footprints nearer to each other become one, and the mesh of the ground stays simple."""
_FLAT_M = 0.05
"""Corners that stand out by less are left out."""


def ground_polygon(walkable: Walkable, give_m: float = 0.0) -> Polygon:
    """The free ground: the bounds without the solid footprints, and without what nobody can reach.

    Footprints are whole, without the body's radius round them; those with no way between them are joined.

    Args:
        walkable: the ground.
        give_m: how much wider the ground is to be at every edge; narrower, if negative.
    """
    import shapely

    bounds = shapely.box(*walkable.bounds_m).buffer(give_m, join_style="mitre")
    solids = shapely.union_all([shapely.box(*box) for box in walkable.obstacles_m.tolist()])
    reach_m = _LEAST_GAP_M / 2 - 1e-3
    joined = solids.buffer(reach_m, join_style="mitre").buffer(-reach_m, join_style="mitre")
    simple = shapely.union_all([solids, joined.simplify(_FLAT_M)]).buffer(-give_m, join_style="mitre")
    parts = shapely.get_parts(bounds.difference(simple))
    polygon: Polygon = max(parts, key=lambda part: part.area)
    shapely.prepare(polygon)
    return polygon


def on_ground(ground: Polygon, points_m: ArrayLike) -> NDArray[np.bool_]:
    """bool `[n]`: which points `[n, 2]` lie inside such a polygon, not on its edge."""
    import shapely

    x_m, y_m = np.asarray(points_m, dtype=float).reshape(-1, 2).T
    return np.asarray(shapely.contains_xy(ground, x_m, y_m), dtype=bool)
