"""Locations as boxes, with heights that a plan does not have."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genc.plan.walkable import is_solid
from genc.scenario.scenario import Environment
from genc.words.vocabulary import Category

Vector = tuple[float, float, float]

HEIGHT_M = {
    Category.BUILDING: 6.0,
    Category.ROOM: 3.0,
    Category.ENTRANCE: 2.5,
    Category.EXHIBIT: 1.4,
    Category.FURNITURE: 0.45,
    Category.OUTDOOR_AREA: 0.3,
    Category.ITEM: 0.9,
    Category.SERVICE_AREA: 1.1,
}
"""How high something solid is. What people walk on is flat, whatever its category."""
COLOUR = {
    Category.BUILDING: (0.55, 0.53, 0.50),
    Category.ROOM: (0.86, 0.83, 0.77),
    Category.ENTRANCE: (0.95, 0.77, 0.36),
    Category.EXHIBIT: (0.60, 0.45, 0.72),
    Category.FURNITURE: (0.62, 0.47, 0.33),
    Category.OUTDOOR_AREA: (0.62, 0.75, 0.52),
    Category.ITEM: (0.42, 0.56, 0.66),
    Category.SERVICE_AREA: (0.84, 0.48, 0.36),
}
"""Linear red, green and blue."""
_FLAT_M = 0.002
"""Flat places lie upon each other, the smaller on the larger, each this much higher, so that none flickers."""


@dataclass(frozen=True)
class Box:
    """A location as a box that stands on the ground: centre and size (x, y, z) in metres."""

    name: str
    category: Category
    centre_m: Vector
    size_m: Vector
    solid: bool


def boxes(environment: Environment) -> list[Box]:
    """A box for each location, in their order."""
    places = environment.locations
    areas_m2 = [place.size_m[0] * place.size_m[1] for place in places]
    layer = np.argsort(np.argsort([-area for area in areas_m2], kind="stable"), kind="stable").tolist()
    found = []
    for place, solid, below in zip(places, is_solid(environment).tolist(), layer, strict=True):
        height_m = HEIGHT_M[place.category] if solid else round(_FLAT_M * (1 + below), 3)
        found.append(
            Box(
                place.name,
                place.category,
                (*place.position_m, height_m / 2),
                (*place.size_m, height_m),
                solid,
            )
        )
    return found
