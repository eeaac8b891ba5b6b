"""JSON for Unreal Engine: left-handed, z up, centimetres."""

from __future__ import annotations

from pathlib import Path

from genc.world.export.engine import Axes, write_engine
from genc.world.world import World

UNREAL = Axes(
    engine="Unreal",
    rows=((100.0, 0.0, 0.0), (0.0, -100.0, 0.0), (0.0, 0.0, 100.0)),
    yaw_zero_deg=0.0,
    n_decimals=1,
    said={
        "axes": {"handedness": "left", "up": "+z", "yaw_zero": "+x", "yaw": "clockwise from above"},
        "units": {"length": "cm", "time": "s", "angle": "deg"},
    },
)


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `unreal.json`."""
    return write_engine(world, folder / "unreal.json", UNREAL)
