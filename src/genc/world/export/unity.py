"""JSON for Unity: left-handed, y up, metres."""

from __future__ import annotations

from pathlib import Path

from genc.world.export.engine import Axes, write_engine
from genc.world.world import World

UNITY = Axes(
    engine="Unity",
    rows=((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    yaw_zero_deg=90.0,
    n_decimals=3,
    said={
        "axes": {"handedness": "left", "up": "+y", "yaw_zero": "+z", "yaw": "clockwise from above"},
        "units": {"length": "m", "time": "s", "angle": "deg"},
    },
)


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `unity.json`."""
    return write_engine(world, folder / "unity.json", UNITY)
