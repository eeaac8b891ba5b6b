"""The ground as people of the field write it down: well-known text."""

from __future__ import annotations

from genc.plan.ground import ground_polygon
from genc.plan.walkable import Walkable


def ground_wkt(walkable: Walkable) -> str:
    """The free ground, one polygon with holes, in metres to the micrometre; needs shapely."""
    import shapely

    return str(shapely.to_wkt(ground_polygon(walkable), rounding_precision=6))
