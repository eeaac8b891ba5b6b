"""CSV: trajectories, activities and people, one file each."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TextIO

from genc.files import write_text, written_beside
from genc.world.activity_table import write_table
from genc.world.export.tables import Coded, Trajectories, people, rows_of, trajectories
from genc.world.world import World

_ROW = "%d,%d,%.10g,%.3f,%.3f,%.4f,%s,%s\n"


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `trajectories.csv`, `activities.csv` and `people.csv`."""
    files = folder / "trajectories.csv", folder / "activities.csv", folder / "people.csv"
    with written_beside(files[0]) as part, part.open("w", encoding="utf-8", newline="") as stream:
        _write_rows(trajectories(world), stream)
    write_text(files[1], write_table(world.plan, world.motion.executed))
    with written_beside(files[2]) as part, part.open("w", encoding="utf-8", newline="") as stream:
        columns = people(world)
        table = csv.writer(stream, lineterminator="\n")
        table.writerow(columns)
        table.writerows(zip(*columns.values(), strict=True))
    return files


def _write_rows(table: Trajectories, stream: TextIO) -> None:
    columns = vars(table)
    stream.write(",".join(columns) + "\n")
    spelled = [column.spelled() if isinstance(column, Coded) else column for column in columns.values()]
    stream.writelines(map(_ROW.__mod__, rows_of(spelled)))
