"""JuPedSim's trajectory file, SQLite version 2, with the activity table in it."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from contextlib import closing
from pathlib import Path

import numpy as np

from genc.files import written_beside
from genc.plan.walkable import Walkable
from genc.world.export.ground import ground_wkt
from genc.world.export.tables import INTEGER_COLUMNS, TEXT_COLUMNS, activities, fps, people, rows_of, trajectories
from genc.world.world import World

_VERSION = 2
_SCHEMA = """
CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL,
    pos_x REAL NOT NULL, pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);
CREATE TABLE metadata (key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);
CREATE UNIQUE INDEX geometry_hash ON geometry (hash);
CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
CREATE TABLE agent_group (agent INTEGER PRIMARY KEY, group_number INTEGER NOT NULL, speed_mps REAL NOT NULL,
    leaves INTEGER NOT NULL, caption TEXT NOT NULL);
"""


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `trajectories.sqlite`; equal worlds give equal bytes."""
    file = folder / "trajectories.sqlite"
    with written_beside(file) as part:
        try:
            with closing(sqlite3.connect(part, isolation_level=None)) as base:
                base.executescript("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN;" + _SCHEMA)
                _write_trajectories(base, world)
                _write_ground(base, world)
                _write_people(base, world)
                base.execute("COMMIT")
        except sqlite3.Error as error:
            raise OSError(str(error)) from error
    return (file,)


def _write_trajectories(base: sqlite3.Connection, world: World) -> None:
    table = trajectories(world)
    order = np.lexsort((table.agent, table.frame))
    facing = np.cos(table.heading_rad), np.sin(table.heading_rad)
    columns = [column[order] for column in (table.frame, table.agent, table.x_m, table.y_m, *facing)]
    base.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)", rows_of(columns))
    base.execute("CREATE INDEX frame_id_idx ON trajectory_data (frame, id)")


def _write_ground(base: sqlite3.Connection, world: World) -> None:
    motion, ground = world.motion, Walkable.of(world.plan.environment)
    wkt = ground_wkt(ground)
    digest = hashlib.blake2b(wkt.encode(), digest_size=8).digest()
    number = int.from_bytes(digest, "big") >> 1  # 63 bits: the integers of SQLite have a sign
    base.execute("INSERT INTO geometry VALUES (?, ?)", (number, wkt))
    base.executemany("INSERT INTO frame_data VALUES (?, ?)", ((frame, number) for frame in range(len(motion.present))))
    bounds = dict(zip(("xmin", "ymin", "xmax", "ymax"), ground.bounds_m, strict=True))
    provenance = json.dumps(dict(world.provenance), ensure_ascii=False)
    facts = {"version": _VERSION, "fps": fps(world.motion), **bounds, "genc_provenance": provenance}
    base.executemany("INSERT INTO metadata VALUES (?, ?)", ((key, str(value)) for key, value in facts.items()))


def _write_people(base: sqlite3.Connection, world: World) -> None:
    columns = activities(world)
    typed = ", ".join(f"{name} {_sql_type(name)}" for name in columns)
    base.execute(f"CREATE TABLE agent_action ({typed}, PRIMARY KEY (agent, step))")
    marks = ", ".join("?" * len(columns))
    base.executemany(f"INSERT INTO agent_action VALUES ({marks})", zip(*columns.values(), strict=True))
    crowd = zip(*people(world).values(), strict=True)
    base.executemany("INSERT INTO agent_group VALUES (?, ?, ?, ?, ?)", crowd)


def _sql_type(column: str) -> str:
    return "INTEGER" if column in INTEGER_COLUMNS else "TEXT" if column in TEXT_COLUMNS else "REAL"
