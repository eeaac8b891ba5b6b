from __future__ import annotations

import csv
import io
import json
import random
import time
import zipfile
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from genc.errors import OutputError, WorldFileError
from genc.motion.motion import Motion
from genc.world.activity_table import COLUMNS
from genc.world.world import World
from genc.world.world_file import SCHEMA, read_world, write_world

FORMATS = Path(__file__).parents[2] / "docs" / "formats.md"


@pytest.fixture(scope="module")
def file(world, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("world") / "world.genc"
    write_world(world, path)
    return path


def altered(source: Path, target: Path, **members: bytes | None) -> Path:
    """A copy of a world file with some members replaced (or left out: None); dots in names are written as _."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            content = members.get(name.replace(".", "_"), old.read(name))
            if content is not None:
                new.writestr(name, content)
    return target


def head_of(path: Path) -> dict:
    with zipfile.ZipFile(path) as archive:
        return json.loads(archive.read("world.json"))


# There and back.


def test_a_world_comes_back_whole(world, file):
    found = read_world(file)
    assert found.plan == world.plan
    assert dict(found.provenance) == dict(world.provenance)
    assert repr(found.motion.executed) == repr(world.motion.executed)
    assert found.motion.dt_s == world.motion.dt_s
    assert np.array_equal(found.motion.present, world.motion.present)
    assert np.abs(found.motion.positions_m - world.motion.positions_m).max() < 0.0051
    assert np.abs(np.exp(1j * found.motion.headings_rad) - np.exp(1j * world.motion.headings_rad)).max() < 1e-4


def test_equal_worlds_are_equal_files_and_so_is_what_was_read(world, file, tmp_path):
    write_world(world, tmp_path / "again.genc")
    write_world(read_world(file), tmp_path / "read.genc")
    assert file.read_bytes() == (tmp_path / "again.genc").read_bytes() == (tmp_path / "read.genc").read_bytes()


def test_a_world_of_nobody_is_a_world(world, tmp_path):
    nobody = replace(world.plan, people=(), captions=())
    motion = Motion(0.2, np.zeros((3, 0, 2), np.float32), np.zeros((3, 0), np.float32), np.zeros((3, 0), bool), ())
    write_world(World(nobody, motion), tmp_path / "nobody.genc")
    assert read_world(tmp_path / "nobody.genc").plan == nobody


def test_a_thousand_people_load_in_well_under_a_second(world, tmp_path):
    """The station's people again and again, up to a thousand."""
    n_times = 1000 // len(world.plan.people) + 1
    n = len(world.plan.people)
    plan = replace(world.plan, people=world.plan.people * n_times)
    executed = tuple(replace(done, agent=done.agent + n * k) for k in range(n_times) for done in world.motion.executed)
    arrays = [np.concatenate([a] * n_times, axis=1) for a in (world.motion.positions_m, world.motion.headings_rad)]
    present = np.concatenate([world.motion.present] * n_times, axis=1)
    write_world(World(plan, Motion(0.2, *arrays, present, executed)), tmp_path / "many.genc")
    assert (tmp_path / "many.genc").stat().st_size < 15e6
    durations_s = []
    for _ in range(3):
        begin_s = time.perf_counter()
        read_world(tmp_path / "many.genc")
        durations_s.append(time.perf_counter() - begin_s)
    assert min(durations_s) < 1.0


# Faults.


def test_a_missing_file_is_said_to_be_missing(tmp_path):
    with pytest.raises(WorldFileError, match=r"absent\.genc: there is no such world file"):
        read_world(tmp_path / "absent.genc")


def test_a_folder_is_no_world_file(tmp_path):
    with pytest.raises(WorldFileError, match="cannot be read"):
        read_world(tmp_path)


def test_a_file_cut_anywhere_is_refused_in_one_line(short_world, tmp_path):
    whole = tmp_path / "whole.genc"
    write_world(short_world, whole)
    content, cut = whole.read_bytes(), tmp_path / "cut.genc"
    lengths = {*range(40), len(content) - 1, len(content) - 2, len(content) - 22}
    lengths |= set(random.Random(0).sample(range(len(content)), 150))
    for length in sorted(lengths):
        cut.write_bytes(content[:length])
        with pytest.raises(WorldFileError) as refusal:
            read_world(cut)
        assert str(refusal.value).startswith(f"{cut}: ")
        assert "\n" not in str(refusal.value)


def test_an_altered_byte_is_noticed_or_harmless(short_world, tmp_path):
    whole = tmp_path / "whole.genc"
    write_world(short_world, whole)
    content, chance = whole.read_bytes(), random.Random(1)
    for _ in range(150):
        damaged = bytearray(content)
        damaged[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
        (tmp_path / "damaged.genc").write_bytes(damaged)
        with suppress(WorldFileError):
            # What lies outside the checksums of a ZIP (dates, permissions) says nothing about the world.
            found = read_world(tmp_path / "damaged.genc")
            assert found.plan == short_world.plan
            assert np.array_equal(found.motion.present, short_world.motion.present)


@pytest.mark.parametrize("content", [b"", b"hello", b"\x89PNG\r\n", b"SQLite format 3\x00"])
def test_foreign_files_are_refused(tmp_path, content):
    (tmp_path / "foreign.genc").write_bytes(content)
    with pytest.raises(WorldFileError, match=r"foreign\.genc: (is empty|is not a world file)"):
        read_world(tmp_path / "foreign.genc")


def test_a_foreign_archive_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("photo.jpg", b"1")
    with pytest.raises(WorldFileError, match=r"it has no world\.json"):
        read_world(tmp_path / "a.zip")


def test_another_format_and_a_newer_schema_are_told_apart(file, tmp_path):
    head = head_of(file)
    other = altered(file, tmp_path / "other", world_json=json.dumps({**head, "format": "usd"}).encode())
    with pytest.raises(WorldFileError, match="its format is 'usd'"):
        read_world(other)
    newer = altered(file, tmp_path / "newer", world_json=json.dumps({**head, "schema": SCHEMA + 1}).encode())
    with pytest.raises(WorldFileError, match=f"newer genc .schema {SCHEMA + 1}; this one reads {SCHEMA}.; upgrade"):
        read_world(newer)


@pytest.mark.parametrize(
    "members",
    [
        {"world_json": b"{"},
        {"world_json": b"[]"},
        {"world_json": b'{"format": "genc world"}'},
        {"world_json": b'{"format": "genc world", "schema": "one"}'},
        {"world_json": b'{"format": "genc world", "schema": 1, "locations": 3}'},
        {"activities_csv": b""},
        {"activities_csv": b"agent,step\n0,0\n"},
        {"activities_csv": None},
        {"activities_csv": (",".join(COLUMNS) + "\n99999,0" + "," * (len(COLUMNS) - 2) + "\n").encode()},
        {"activities_csv": (",".join(COLUMNS) + "\n0,0\n").encode()},
        {"activities_csv": b"\xff\xfe"},
        {"positions_npy": b"no array"},
        {"present_npy": None},
    ],
)
def test_members_that_make_no_world_are_refused_in_one_line(file, tmp_path, members):
    with pytest.raises(WorldFileError, match="not a sound world file") as refusal:
        read_world(altered(file, tmp_path / "unsound", **members))
    assert "\n" not in str(refusal.value)


def test_arrays_of_another_kind_or_shape_are_refused(file, world, tmp_path):
    for values in (np.zeros(3), np.zeros((1, 1), dtype=bool), np.array([{}], dtype=object)):
        buffer = io.BytesIO()
        np.save(buffer, values, allow_pickle=True)
        with pytest.raises(WorldFileError, match="not a sound world file"):
            read_world(altered(file, tmp_path / "unsound", present_npy=buffer.getvalue()))


def test_where_nothing_can_be_written_nothing_is_written(world, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(OutputError):
        write_world(world, tmp_path / "file" / "world.genc")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(world, file, tmp_path, monkeypatch):
    path = tmp_path / "world.genc"
    path.write_bytes(b"the old one")
    monkeypatch.setattr(zipfile.ZipFile, "writestr", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left")))
    with pytest.raises(OutputError, match="No space left"):
        write_world(world, path)
    assert path.read_bytes() == b"the old one"
    assert [p.name for p in tmp_path.iterdir()] == ["world.genc"]


# The specification.


def test_every_member_column_and_key_is_specified(file):
    specification = FORMATS.read_text(encoding="utf-8")
    with zipfile.ZipFile(file) as archive:
        names = [*archive.namelist(), *COLUMNS]
        table = csv.reader(io.StringIO(archive.read("activities.csv").decode()))
    assert tuple(next(table)) == COLUMNS
    head = head_of(file)
    names += [*head, *head["frames"], *head["locations"][0], *head["groups"][0], *head["people"]]
    assert [name for name in names if f"`{name}`" not in specification] == []


def test_the_specification_names_the_current_schema():
    assert f"Schema {SCHEMA}" in FORMATS.read_text(encoding="utf-8")


def test_the_reader_in_the_specification_reads_a_world(world, file, monkeypatch):
    snippet = FORMATS.read_text(encoding="utf-8").split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(file.parent)
    found: dict = {}
    exec(snippet, found)
    assert np.abs(found["positions_m"] - world.motion.positions_m).max() < 0.0051
    assert len(found["activities"]) == sum(len(person.activities) for person in world.plan.people)
