"""The world file: one ZIP that holds a whole `World`; `docs/formats.md` is its specification."""

from __future__ import annotations

import csv
import io
import json
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.errors import WorldFileError
from genc.files import written_beside
from genc.motion.motion import Motion
from genc.plan.plan import CrowdPlan, Person
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Category
from genc.world.activity_table import read_table, write_table
from genc.world.frames import Grid, grid_of, pack, unpack
from genc.world.world import World

FORMAT = "genc world"
SCHEMA = 1

_EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest date of a ZIP member. It stands in all: a clock reading would make equal worlds unequal."""


def write_world(world: World, path: Path | str) -> None:
    """Writes a world to one file; equal worlds give equal bytes.

    Raises:
        OutputError: if nothing can be written there.
    """
    grid = grid_of(world.motion)
    positions, headings = pack(world.motion, grid)
    members = {
        "world.json": json.dumps(_head(world, grid), ensure_ascii=False, indent=1).encode(),
        "activities.csv": write_table(world.plan, world.motion.executed).encode(),
        "positions.npy": _npy(positions),
        "headings.npy": _npy(headings),
        "present.npy": _npy(world.motion.present),
    }
    with written_beside(path) as part, zipfile.ZipFile(part, "w") as archive:
        for name, content in members.items():
            member = zipfile.ZipInfo(name, _EPOCH)
            member.create_system = 3
            member.external_attr = 0o644 << 16
            archive.writestr(member, content, zipfile.ZIP_DEFLATED)


def read_world(path: Path | str) -> World:
    """The world that a file holds; positions are true to half a cell of its grid, all else is exact.

    Raises:
        WorldFileError: if it is missing, cut short or altered, of another kind, or written by a newer version.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise WorldFileError(f"{path}: there is no such world file; make one with genc populate") from None
    except OSError as error:
        raise WorldFileError(f"{path}: the world file cannot be read ({error.strerror})") from None
    members = _members(content, path)
    try:
        head = json.loads(members["world.json"])
        _check_kind(head, path)
        return _world(head, members)
    except (LookupError, ValueError, TypeError, AttributeError, csv.Error) as error:
        detail = " ".join(str(error).split()) or type(error).__name__
        raise WorldFileError(f"{path}: not a sound world file ({detail}); write it again") from None


def _members(content: bytes, path: Path) -> dict[str, bytes]:
    if not content.startswith(b"PK\x03\x04"):
        what = "is empty" if not content else "is not a world file (a world file is a ZIP archive)"
        raise WorldFileError(f"{path}: {what}; make one with genc populate")
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, ValueError, OSError):
        raise WorldFileError(f"{path}: the world file is cut short or damaged; write it again") from None
    if "world.json" not in members:
        raise WorldFileError(f"{path}: a ZIP archive, but not a world file: it has no world.json")
    return members


def _check_kind(head: dict[str, Any], path: Path) -> None:
    if head.get("format") != FORMAT:
        raise WorldFileError(f"{path}: not a world file: its format is {head.get('format')!r}, not {FORMAT!r}")
    if head["schema"] > SCHEMA:
        raise WorldFileError(
            f"{path}: written by a newer genc (schema {head['schema']}; this one reads {SCHEMA}); upgrade genc"
        )


def _head(world: World, grid: Grid) -> dict[str, object]:
    plan, motion = world.plan, world.motion
    n_frames, n_agents = motion.present.shape
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "provenance": dict(world.provenance),
        "duration_s": plan.duration_s,
        "frames": {
            "n_frames": n_frames,
            "n_agents": n_agents,
            "dt_s": motion.dt_s,
            "origin_m": grid.origin_m,
            "quantum_m": grid.quantum_m,
        },
        "locations": [
            {"name": place.name, "category": place.category, "position_m": place.position_m, "size_m": place.size_m}
            for place in plan.environment.locations
        ],
        "groups": [{"caption": caption} for caption in plan.captions],
        "people": {
            "group": [person.group for person in plan.people],
            "speed_mps": [person.speed_mps for person in plan.people],
            "leaves": [person.leaves for person in plan.people],
        },
        "notes": plan.notes,
    }


def _world(head: dict[str, Any], members: dict[str, bytes]) -> World:
    environment = Environment(tuple(_location(place) for place in head["locations"]))
    people = head["people"]
    activities, executed = read_table(members["activities.csv"].decode(), environment, len(people["group"]))
    columns = (people["group"], people["speed_mps"], activities, people["leaves"])
    plan = CrowdPlan(
        environment=environment,
        people=tuple(Person(g, speed, tuple(row), leaves) for g, speed, row, leaves in zip(*columns, strict=True)),
        duration_s=head["duration_s"],
        captions=tuple(group["caption"] for group in head["groups"]),
        notes=tuple(head["notes"]),
    )
    frames = head["frames"]
    grid = Grid(tuple(frames["origin_m"]), frames["quantum_m"])
    packed = _array(members["positions.npy"], np.uint16), _array(members["headings.npy"], np.uint16)
    positions_m, headings_rad = unpack(*packed, grid)
    present = _array(members["present.npy"], np.bool_)
    if present.shape != (frames["n_frames"], len(plan.people)):
        raise ValueError(f"frames of shape {present.shape} for {len(plan.people)} people")
    motion = Motion(frames["dt_s"], positions_m, headings_rad, present, tuple(executed))
    return World(plan, motion, head["provenance"])


def _location(place: dict[str, Any]) -> Location:
    return Location(place["name"], Category(place["category"]), tuple(place["position_m"]), tuple(place["size_m"]))


def _npy(values: NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    little_endian = values.dtype.newbyteorder("<")
    np.lib.format.write_array(buffer, np.ascontiguousarray(values, dtype=little_endian), allow_pickle=False)
    return buffer.getvalue()


def _array(content: bytes, dtype: type) -> NDArray[Any]:
    values = np.lib.format.read_array(io.BytesIO(content), allow_pickle=False)
    if values.dtype != dtype:
        raise ValueError(f"an array of {values.dtype} where {np.dtype(dtype)} is due")
    return values
