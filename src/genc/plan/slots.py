"""Where people stand, sit, queue and are served at each location.

Every slot is free ground, at least `APART_M` from the other slots of its location. See `docs/conventions.md`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree
from scipy.spatial.distance import cdist

from genc.plan.plan import Slot
from genc.plan.walkable import BODY_RADIUS_M, Walkable, box_of, is_solid
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Category

Floats = NDArray[np.float64]

APART_M = 0.7
LINE_SPACING_M = 0.75
LONGEST_LINE = 24
ABREAST_M = 0.75
"""Between the middles of two who walk or come in side by side."""
MOST_ABREAST = 3
_KEPT_FOR_LINE = 8
"""Nobody just stands where so many of a line do."""
MOST_SPOTS = 400
_BESIDE_M = BODY_RADIUS_M + 0.1
"""From the edge of a thing to the middle of who sits at it or uses it."""
_VIEWING_M = 1.2
"""From the edge of an exhibit to the nearest who look at it."""
_METRES_A_SERVER = 1.5


@dataclass(frozen=True)
class Places:
    """The slots of one location.

    Attributes:
        service: where a person is served or uses the thing; their number is its capacity. Empty where nothing is
            used: rooms, areas, entrances.
        line: where people queue, head first, from the service backwards.
        spots: where people do anything else: seats round furniture, rings before exhibits, ground in areas.
        door: where people come in, go out or stand to enter.
    """

    service: tuple[Slot, ...]
    line: tuple[Slot, ...]
    spots: tuple[Slot, ...]
    door: Slot


def places_of(environment: Environment, walkable: Walkable) -> tuple[Places, ...]:
    """The slots of every location, in order of the locations."""
    solid = is_solid(environment)
    middle = np.mean([place.position_m for place in environment.locations], axis=0)
    found = [_places(environment, i, bool(solid[i]), middle, walkable) for i in range(len(environment.locations))]
    return tuple(replace(place, line=_beside_others(place, found[:i])) for i, place in enumerate(found))


def _beside_others(place: Places, before: Sequence[Places]) -> tuple[Slot, ...]:
    """The line of a place without what would stand in lines of places before it; its head stays."""
    kept = [slot.position_m for other in before if other.service for slot in (*other.service, *other.line)]
    if not kept or not place.service:
        return place.line
    apart_m = KDTree(kept).query([slot.position_m for slot in place.line])[0]
    return tuple(slot for i, slot in enumerate(place.line) if i == 0 or apart_m[i] >= APART_M)


def circle(location: Location, walkable: Walkable, centre_m: tuple[float, float], n: int) -> tuple[Slot, ...]:
    """Slots of n people who talk: a ring round a free point, everybody facing the middle."""
    middle = np.array(centre_m)
    radius_m = max(0.45, APART_M / (2 * math.sin(math.pi / n))) if n > 1 else 0.0
    angles = 2 * math.pi * (np.arange(n) / n) + 0.3
    points = _apart(walkable, middle + radius_m * np.stack([np.cos(angles), np.sin(angles)], axis=1))
    if n == 1:
        middle = np.array(location.position_m)
    return tuple(_facing(p, middle) for p in points)


def more_spots(
    location: Location, walkable: Walkable, margin_m: float, n: int, rng: np.random.Generator
) -> tuple[Slot, ...]:
    """Up to n free points within a location and that much ground round it; at least one."""
    x0, y0, x1, y1 = box_of(location)
    tried = rng.uniform([x0 - margin_m, y0 - margin_m], [x1 + margin_m, y1 + margin_m], size=(n, 2))
    found = tried[walkable.free(tried)]
    facing = rng.uniform(-math.pi, math.pi, size=n).tolist()
    points = found if len(found) else walkable.snap(tried[:1])
    return tuple(Slot(_pair(point), angle) for point, angle in zip(points, facing, strict=False))


def _places(environment: Environment, index: int, solid: bool, middle: Floats, walkable: Walkable) -> Places:
    place = environment.locations[index]
    door = _door(environment, place, solid, middle, walkable)
    service = _service(place, solid, middle, walkable)
    head = service[len(service) // 2] if service else door
    line = _line(place, head, service, walkable)
    spots = _spots(place, solid, (*service, *line[:_KEPT_FOR_LINE]) if service else (), walkable)
    if not spots:
        spots = (_facing(walkable.snap([place.position_m])[0], np.array(place.position_m)),)
    return Places(service, line, spots, door)


def _door(environment: Environment, place: Location, solid: bool, middle: Floats, walkable: Walkable) -> Slot:
    """An entrance is its own door; a building's is an entrance at its edge, else the side nearest to the rest."""
    inward = np.array(place.position_m)
    if place.category is Category.ENTRANCE:
        return _facing(walkable.snap([place.position_m])[0], middle)
    if place.category is Category.BUILDING and solid:
        at = next((e.position_m for e in environment.locations if _is_door_of(e, place)), None)
        point = _side_middle(place, middle, _BESIDE_M) if at is None else np.array(at)
        return _facing(walkable.snap([point])[0], inward)
    return _facing(walkable.snap([_side_middle(place, middle, _BESIDE_M)])[0], inward)


def _is_door_of(entrance: Location, building: Location) -> bool:
    """Whether an entrance touches a building's footprint."""
    if entrance.category is not Category.ENTRANCE:
        return False
    (a0, b0, a1, b1), (x0, y0, x1, y1) = box_of(entrance), box_of(building)
    return a0 <= x1 + 0.5 and a1 >= x0 - 0.5 and b0 <= y1 + 0.5 and b1 >= y0 - 0.5


def _service(place: Location, solid: bool, middle: Floats, walkable: Walkable) -> tuple[Slot, ...]:
    """Along the front of a counter; all round a thing."""
    if place.category not in (Category.SERVICE_AREA, Category.ITEM, Category.EXHIBIT):
        return ()
    capacity = int(np.clip(max(place.size_m) / _METRES_A_SERVER, 1, 6))
    centre = np.array(place.position_m)
    if place.category is Category.SERVICE_AREA and solid:
        front = _front(place, middle, walkable)
        points = list(_along(place, front, capacity, _BESIDE_M))
        found = _apart(walkable, np.array(points))
    else:
        found = _spread(_ring(place, _BESIDE_M) if solid else _grid(place, 1.0), capacity)
        found = _apart(walkable, found)
    return tuple(_facing(p, centre) for p in found)


def _front(place: Location, middle: Floats, walkable: Walkable) -> int:
    """The side (0 right, 1 top, 2 left, 3 bottom) with most free ground before it; ties go towards the middle."""
    centre = np.array(place.position_m)
    best, best_score = 0, -1.0
    for side in range(4):
        normal = _NORMALS[side]
        reach = np.arange(0.4, 7.0, 0.6)[:, None] * normal + centre + normal * _half(place, side)
        length = place.size_m[1 - side % 2]
        towards = float(normal @ (middle - centre)) / (1 + float(np.linalg.norm(middle - centre)))
        score = float(walkable.free(reach).mean()) + 0.2 * towards + 0.1 * min(length, 6.0) / 6.0
        if score > best_score:
            best, best_score = side, score
    return best


def _spots(place: Location, solid: bool, reserved: Sequence[Slot], walkable: Walkable) -> tuple[Slot, ...]:
    """Where people do anything that is no service and no queue; away from the slots that are kept for those."""
    centre = np.array(place.position_m)
    if solid:
        first_m = _VIEWING_M if place.category is Category.EXHIBIT else _BESIDE_M
        if place.category is Category.SERVICE_AREA:
            first_m = 1.6
        rings = [_ring(place, first_m + 0.9 * k) for k in range(1 if place.category is Category.FURNITURE else 3)]
        points = np.concatenate(rings)
    else:
        points = _grid(place, 0.9)
    points = points[walkable.free(points)]
    if reserved and len(points):
        taken = KDTree([slot.position_m for slot in reserved])
        points = points[taken.query(points)[0] >= APART_M]
    kept = _spread(points, MOST_SPOTS)
    if place.category in (Category.ROOM, Category.OUTDOOR_AREA, Category.ENTRANCE, Category.BUILDING) and not solid:
        facing = 2 * math.pi * _golden(np.arange(len(kept))) - math.pi
        return tuple(Slot(_pair(p), angle) for p, angle in zip(kept, facing.tolist(), strict=True))
    return tuple(_facing(p, centre) for p in kept)


def _line(place: Location, head: Slot, service: Sequence[Slot], walkable: Walkable) -> tuple[Slot, ...]:
    """A row of slots backwards from the head; it turns where it meets an obstacle."""
    centre, point = np.array(place.position_m), np.array(head.position_m)
    served = [np.array(slot.position_m) for slot in service]
    away = -np.array([math.cos(head.facing_rad), math.sin(head.facing_rad)])
    points = [point + 0.95 * away] if service else [point]
    if not walkable.free(points[0])[0] or (served and cdist(points, served).min() < APART_M):
        points = _nearby(walkable, [*served, point], 1) or [walkable.snap(points[0])[0]]
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    while len(points) < LONGEST_LINE:
        turns = (away, quarter @ away, -quarter @ away)
        steps = np.array([points[-1] + LINE_SPACING_M * t for t in turns])
        fits = walkable.free(steps) & (cdist(steps, [*points, *served]).min(1) > APART_M)
        if not fits.any():
            break
        chosen = int(np.argmax(fits))
        away = turns[chosen]
        points.append(steps[chosen])
    if len(points) < 12:
        points.extend(_nearby(walkable, [*served, *points], 12 - len(points)))
    ahead = [centre if service else point, *points[:-1]]
    return tuple(_facing(p, target) for p, target in zip(points, ahead, strict=True))


def _nearby(walkable: Walkable, taken: Sequence[Floats], n: int) -> list[Floats]:
    """n more free points as near as may be to the last of the taken ones."""
    offsets = np.indices((25, 25)).reshape(2, -1).T - 12.0
    points = taken[-1] + offsets * LINE_SPACING_M
    points = points[walkable.free(points)]
    points = points[KDTree(np.array(taken)).query(points)[0] > APART_M] if len(points) else points
    order = np.argsort(np.linalg.norm(points - taken[-1], axis=1), kind="stable")
    return list(points[order[:n]])


_NORMALS = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


def _half(place: Location, side: int) -> float:
    return place.size_m[side % 2] / 2


def _side_middle(place: Location, middle: Floats, beyond_m: float) -> Floats:
    """The middle of the side nearest to `middle`, a little outside."""
    centre = np.array(place.position_m)
    sides = [centre + n * (_half(place, s) + beyond_m) for s, n in enumerate(_NORMALS)]
    return min(sides, key=lambda p: float(np.linalg.norm(p - middle)))


def _along(place: Location, side: int, n: int, beyond_m: float) -> Floats:
    """`[n, 2]` points along a side, evenly, a little outside."""
    normal = _NORMALS[side]
    tangent = np.array([-normal[1], normal[0]])
    length = place.size_m[1 - side % 2]
    offsets = (np.arange(n) - (n - 1) / 2) * max(min(length / n, 1.5), APART_M)
    points: Floats = np.array(place.position_m) + normal * (_half(place, side) + beyond_m) + offsets[:, None] * tangent
    return points


def _ring(place: Location, beyond_m: float) -> Floats:
    """`[n, 2]` points all round a footprint at that distance, about 0.75 m apart."""
    points = []
    for side in range(4):
        length = place.size_m[1 - side % 2] + 2 * max(beyond_m - 0.6, 0.0)
        n = max(1, int(length / LINE_SPACING_M))
        normal = _NORMALS[side]
        tangent = np.array([-normal[1], normal[0]])
        offsets = (np.arange(n) - (n - 1) / 2) * (length / n)
        points.append(
            np.array(place.position_m) + normal * (_half(place, side) + beyond_m) + offsets[:, None] * tangent
        )
    return np.concatenate(points)


def _grid(place: Location, spacing_m: float) -> Floats:
    """`[n, 2]` points that fill a footprint, staggered so that they do not look like one."""
    x0, y0, x1, y1 = box_of(place)
    spacing = max(spacing_m, math.sqrt((x1 - x0) * (y1 - y0) / (2 * MOST_SPOTS)))
    x, y = np.meshgrid(np.arange(x0 + spacing / 2, x1, spacing), np.arange(y0 + spacing / 2, y1, spacing))
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    if len(points) == 0:
        return np.array([place.position_m])
    i = np.arange(len(points))
    wobble = np.stack([_golden(i), _golden(i * 7 + 3)], axis=1) - 0.5
    return points + wobble * (spacing - APART_M) if spacing > APART_M else points


def _golden(i: NDArray[np.int64]) -> NDArray[np.float64]:
    """Numbers in [0, 1) that look random and are evenly spread."""
    return np.asarray(i * 0.6180339887498949 % 1.0)


def _spread(points: Floats, n: int) -> Floats:
    """n of the points, evenly picked."""
    return points if len(points) <= n else points[np.linspace(0, len(points) - 1, n).round().astype(int)]


def _apart(walkable: Walkable, points: Floats) -> Floats:
    """The points on free ground, those too near to one before them moved to free ground close by."""
    kept: list[Floats] = []
    for point in walkable.snap(points):
        if kept and min(float(np.linalg.norm(point - k)) for k in kept) < 0.9 * APART_M:
            beside = _nearby(walkable, [*kept, point], 1)
            point = beside[0] if beside else point
        kept.append(point)
    return np.array(kept)


def _facing(point: Floats, target: Floats) -> Slot:
    away = target - point
    return Slot(_pair(point), math.atan2(float(away[1]), float(away[0])))


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])
