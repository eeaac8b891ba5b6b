"""Draws a world at one moment as SVG: python docs/picture.py WORLD.genc SECONDS OUT.svg."""

from __future__ import annotations

import colorsys
import sys
from collections.abc import Callable
from html import escape
from pathlib import Path

import numpy as np

from genc.files import write_text
from genc.plan.walkable import box_of
from genc.world.world import World
from genc.world.world_file import read_world

FILLS = {
    "building": "#c9c2b6",
    "room": "#efe6d4",
    "entrance": "#cfe8cf",
    "exhibit": "#e3cfe8",
    "furniture": "#d9b98c",
    "outdoor area": "#dcebd2",
    "item": "#f2d27e",
    "service area": "#f3b49b",
}
SCALE = 14
TRAIL_S = 6.0


def picture(world: World, at_s: float) -> str:
    """The SVG text: footprints by category, people by group, the way of the last seconds behind each."""
    places = world.plan.environment.locations
    boxes = np.array([box_of(place) for place in places])
    low, high = boxes[:, :2].min(0) - 2, boxes[:, 2:].max(0) + 2
    width, height = ((high - low) * SCALE).tolist()

    def at(x: float, y: float) -> str:
        return f"{(x - low[0]) * SCALE:.1f},{(high[1] - y) * SCALE:.1f}"

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        'font-family="Helvetica, Arial, sans-serif">',
        f'<rect width="{width:.0f}" height="{height:.0f}" fill="#faf8f4"/>',
    ]
    large_first = sorted(zip(places, boxes, strict=True), key=lambda pair: -pair[0].size_m[0] * pair[0].size_m[1])
    for place, (x0, y0, x1, y1) in large_first:
        x, y = at(x0, y1).split(",")
        parts.append(
            f'<rect x="{x}" y="{y}" width="{(x1 - x0) * SCALE:.1f}" height="{(y1 - y0) * SCALE:.1f}" rx="3" '
            f'fill="{FILLS[place.category]}" stroke="#8a8378" stroke-width="1"/>'
        )
    parts.extend(_people(world, at_s, at))
    for place, (x0, _, x1, y1) in large_first:
        x, y = at((x0 + x1) / 2, y1).split(",")
        parts.append(
            f'<text x="{x}" y="{float(y) + 13:.1f}" font-size="11" text-anchor="middle" fill="#4a443b" '
            f'paint-order="stroke" stroke="#ffffff" stroke-width="3">{escape(place.name)}</text>'
        )
    return "\n".join([*parts, "</svg>\n"])


def _people(world: World, at_s: float, at: Callable[[float, float], str]) -> list[str]:
    motion = world.motion
    frame = min(round(at_s / motion.dt_s), len(motion.present) - 1)
    first = max(0, frame - round(TRAIL_S / motion.dt_s))
    parts = []
    for agent in np.flatnonzero(motion.present[frame]).tolist():
        red, green, blue = colorsys.hls_to_rgb(world.plan.people[agent].group * 0.618 % 1, 0.42, 0.65)
        colour = f"rgb({red * 255:.0f},{green * 255:.0f},{blue * 255:.0f})"
        way = motion.positions_m[first : frame + 1, agent][motion.present[first : frame + 1, agent]]
        line = " ".join(at(*point) for point in way.tolist())
        x, y = way[-1].tolist()
        heading = float(motion.headings_rad[frame, agent])
        nose = at(x + 0.55 * np.cos(heading), y + 0.55 * np.sin(heading))
        here = at(x, y).split(",")
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2" opacity="0.35"/>')
        parts.append(f'<polyline points="{",".join(here)} {nose}" stroke="{colour}" stroke-width="3"/>')
        parts.append(f'<circle cx="{here[0]}" cy="{here[1]}" r="4.6" fill="{colour}" stroke="white"/>')
    return parts


if __name__ == "__main__":
    write_text(Path(sys.argv[3]), picture(read_world(sys.argv[1]), float(sys.argv[2])))
