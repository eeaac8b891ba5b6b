"""HDF5 as in the Pedestrian Dynamics Data Archive, with the activity table in it."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.files import written_beside
from genc.plan.walkable import Walkable
from genc.world.export.ground import ground_wkt
from genc.world.export.tables import INTEGER_COLUMNS, TEXT_COLUMNS, activities, fps, people, trajectories
from genc.world.world import World

_ROW = [("id", "<u4"), ("frame", "<u4"), ("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("ox", "<f8"), ("oy", "<f8")]
_PACKED: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}
_UNITS = {"id": "-", "frame": "-", "x": "m", "y": "m", "z": "m", "ox": "-", "oy": "-"}


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `trajectories.h5`: `/trajectory`, `/actions`, `/people`."""
    import h5py

    # In memory first: the library does not survive a disk that is full.
    content = io.BytesIO()
    with h5py.File(content, "w") as archive:
        archive.attrs["wkt_geometry"] = ground_wkt(Walkable.of(world.plan.environment))
        archive.attrs["fps"] = fps(world.motion)
        archive.attrs["genc_provenance"] = json.dumps(dict(world.provenance), ensure_ascii=False)
        trajectory = archive.create_dataset("trajectory", data=_trajectory(world), **_PACKED)
        trajectory.attrs["fps"] = fps(world.motion)
        trajectory.attrs["column_units"] = json.dumps(_UNITS)
        archive.create_dataset("actions", data=_table(activities(world), h5py.string_dtype()))
        archive.create_dataset("people", data=_table(people(world), h5py.string_dtype()))
    file = folder / "trajectories.h5"
    with written_beside(file) as part:
        part.write_bytes(content.getbuffer())
    return (file,)


def _trajectory(world: World) -> NDArray[np.void]:
    table = trajectories(world)
    rows = np.zeros(len(table.agent), dtype=_ROW)
    rows["id"], rows["frame"], rows["x"], rows["y"] = table.agent, table.frame, table.x_m, table.y_m
    rows["ox"], rows["oy"] = np.cos(table.heading_rad), np.sin(table.heading_rad)
    return rows


def _table(columns: dict[str, list[Any]], text: Any) -> NDArray[np.void]:
    """Columns as one compound table: an empty cell is NaN or ""."""
    kinds = [(name, _kind(name, text)) for name in columns]
    rows = np.zeros(len(columns["agent"]), dtype=kinds)
    for name, cells in columns.items():
        empty = "" if _kind(name, text) is text else np.nan
        rows[name] = [empty if cell is None else cell for cell in cells]
    return rows


def _kind(column: str, text: Any) -> Any:
    if column in (*INTEGER_COLUMNS, "group", "leaves"):
        return "<i4"
    return text if column in (*TEXT_COLUMNS, "caption") else "<f8"
