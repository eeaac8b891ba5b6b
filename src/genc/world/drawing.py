"""A plan from above: footprints by category, people by group, the way of the last seconds behind each."""

from __future__ import annotations

import colorsys
import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from genc.plan.walkable import box_of
from genc.words.vocabulary import Category
from genc.world.world import World

_FILLS = {
    Category.BUILDING: "#c9c2b6",
    Category.ROOM: "#efe6d4",
    Category.ENTRANCE: "#cfe8cf",
    Category.EXHIBIT: "#e3cfe8",
    Category.FURNITURE: "#d9b98c",
    Category.OUTDOOR_AREA: "#dcebd2",
    Category.ITEM: "#f2d27e",
    Category.SERVICE_AREA: "#f3b49b",
}
_PAPER, _EDGE, _INK, _MARK = "#faf8f4", "#8a8378", "#3d382f", "#d43d1a"
_FINE = 2
"""Drawn so many times larger, then made smaller: smooth edges."""
_BORDER_M = 2.0
_TRAIL_S = 6.0
_BODY_M = 0.3


def draw(
    world: World, at_s: float, size: tuple[int, int], *, agent: int | None = None, names: bool = True
) -> Image.Image:
    """The plan at a moment, as a picture of that many pixels in width and height."""
    sheet = _Sheet(world, size)
    sheet.places()
    frame = min(round(at_s / world.motion.dt_s), len(world.motion.present) - 1)
    for other in np.flatnonzero(world.motion.present[frame]).tolist():
        sheet.person(other, frame, marked=other == agent)
    if names:
        sheet.names()
    return sheet.image.resize(size, Image.Resampling.LANCZOS)


class _Sheet:
    """Paper with a scale: the whole layout fits, in its middle."""

    def __init__(self, world: World, size: tuple[int, int]) -> None:
        self.world = world
        self.image = Image.new("RGB", (_FINE * size[0], _FINE * size[1]), _PAPER)
        self.pen = ImageDraw.Draw(self.image)
        places = world.plan.environment.locations
        self.boxes = sorted(((box_of(place), place) for place in places), key=lambda b: -math.prod(b[1].size_m))
        corners = np.array([box for box, _ in self.boxes])
        low_m, high_m = corners[:, :2].min(axis=0) - _BORDER_M, corners[:, 2:].max(axis=0) + _BORDER_M
        self.scale = float(min(self.image.size / (high_m - low_m)))
        self.middle_m = (low_m + high_m) / 2

    def at(self, x_m: float, y_m: float) -> tuple[float, float]:
        """The pixel of a point."""
        x, y = (np.array([x_m, y_m]) - self.middle_m) * self.scale * [1, -1] + np.array(self.image.size) / 2
        return float(x), float(y)

    def places(self) -> None:
        for (x0, y0, x1, y1), place in self.boxes:
            self.pen.rectangle((*self.at(x0, y1), *self.at(x1, y0)), _FILLS[place.category], _EDGE, _FINE)

    def names(self) -> None:
        font = ImageFont.load_default(size=13 * _FINE)
        for (x0, _, x1, y1), place in self.boxes:
            x, y = self.at((x0 + x1) / 2, y1)
            self.pen.text(
                (x, y + 3 * _FINE), place.name, _INK, font, anchor="ma", stroke_width=2 * _FINE, stroke_fill=_PAPER
            )

    def person(self, agent: int, frame: int, *, marked: bool) -> None:
        motion = self.world.motion
        first = max(0, frame - round(_TRAIL_S / motion.dt_s))
        seen = motion.present[first : frame + 1, agent]
        way = [self.at(x, y) for x, y in motion.positions_m[first : frame + 1, agent][seen].tolist()]
        hue = self.world.plan.people[agent].group * 0.618 % 1
        colour, pale = (_rgb(colorsys.hls_to_rgb(hue, light, 0.6)) for light in (0.42, 0.75))
        if len(way) > 1:
            self.pen.line(way, pale, _FINE, joint="curve")
        (x, y), radius = way[-1], max(_BODY_M * self.scale, 3.0 * _FINE)
        heading_rad = float(motion.headings_rad[frame, agent])
        nose = (x + 1.8 * radius * math.cos(heading_rad), y - 1.8 * radius * math.sin(heading_rad))
        self.pen.line((x, y, *nose), colour, 2 * _FINE)
        self.pen.circle((x, y), radius, colour, "white", _FINE)
        if marked:
            self.pen.circle((x, y), 2.4 * radius, None, _MARK, 2 * _FINE)


def _rgb(colour: tuple[float, float, float]) -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in colour)
    return red, green, blue
