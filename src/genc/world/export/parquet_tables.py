"""Parquet: trajectories, activities and people, one file each, words dictionary-encoded."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from genc.files import written_beside
from genc.world.export.tables import (
    INTEGER_COLUMNS,
    TEXT_COLUMNS,
    Coded,
    activities,
    people,
    trajectories,
)
from genc.world.world import World

_FLAGS = ("implied", "leaves")


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `trajectories.parquet`, `activities.parquet` and `people.parquet`."""
    import pyarrow.parquet as parquet

    tables = {"trajectories": _trajectories(world), "activities": _activities(world), "people": _people(world)}
    files = tuple(folder / f"{name}.parquet" for name in tables)
    for file, table in zip(files, tables.values(), strict=True):
        with written_beside(file) as part:
            parquet.write_table(table, part, compression="zstd")
    return files


def _trajectories(world: World) -> Any:
    import pyarrow as pa

    columns = {
        name: pa.DictionaryArray.from_arrays(pa.array(column.codes), pa.array(column.words, pa.string()))
        if isinstance(column, Coded)
        else pa.array(column)
        for name, column in vars(trajectories(world)).items()
    }
    return pa.table(columns)


def _activities(world: World) -> Any:
    import pyarrow as pa

    columns = activities(world)
    columns["partners"] = [list(map(int, partners.split())) for partners in columns["partners"]]
    return pa.table({name: _column(name, cells) for name, cells in columns.items()})


def _people(world: World) -> Any:
    import pyarrow as pa

    return pa.table({name: _column(name, cells) for name, cells in people(world).items()})


def _column(name: str, cells: list[Any]) -> Any:
    import pyarrow as pa

    if name == "partners":
        return pa.array(cells, pa.list_(pa.int32()))
    if name in _FLAGS:
        return pa.array(map(bool, cells), pa.bool_())
    if name in (*TEXT_COLUMNS, "caption"):
        return pa.array(cells, pa.string()).dictionary_encode()
    return pa.array(cells, pa.int32() if name in (*INTEGER_COLUMNS, "group") else pa.float64())
