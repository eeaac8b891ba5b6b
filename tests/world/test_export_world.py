"""Formats chosen, checked, and written whole or not at all."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path

import odd_worlds
import pytest

from genc.errors import BriefError, ExtraError, OutputError
from genc.world import export
from genc.world.export import ALL, FORMATS, check_formats, export_world

ODD = {"rare": odd_worlds.rare, "one frame": odd_worlds.one_frame, "nobody": odd_worlds.nobody}
DOCS = Path(__file__).parents[2] / "docs" / "formats.md"


def files_in(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", ODD)
def test_odd_worlds_are_written_in_all_formats(name, tmp_path):
    written = export_world(ODD[name](), tmp_path, [ALL])
    assert list(written) == list(FORMATS)
    files = [file for group in written.values() for file in group]
    assert {file.name for file in files} == files_in(tmp_path)
    assert len(files) == len(set(files))
    empty = {file.name for file in files if not file.stat().st_size}
    assert empty <= {"eth_ucy.txt", "groups.txt"}


def test_equal_worlds_give_equal_bytes(tmp_path):
    first = export_world(odd_worlds.rare(), tmp_path / "a", [ALL])
    export_world(odd_worlds.rare(), tmp_path / "b", [ALL])
    for files in first.values():
        for file in files:
            assert file.read_bytes() == (tmp_path / "b" / file.name).read_bytes(), file.name


def test_writing_again_replaces_and_leaves_nothing_else(tmp_path):
    for _ in range(2):
        export_world(odd_worlds.rare(), tmp_path, [ALL])
    assert not [name for name in files_in(tmp_path) if ".part" in name or "journal" in name]


def test_formats_are_named_in_any_case_and_once():
    assert check_formats([" USD", "csv", "usd ", "all"])[:2] == ("usd", "csv")
    assert sorted(check_formats([ALL])) == sorted(FORMATS)


@pytest.mark.parametrize("formats", [["csv", "fbx"], ["csv", ""], []])
def test_an_unknown_format_is_refused_before_anything_is_written(formats, tmp_path):
    with pytest.raises(BriefError, match="jupedsim, hdf5, usd, parquet, csv, eth-ucy, unity, unreal, and all"):
        export_world(odd_worlds.rare(), tmp_path / "out", formats)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("name", "library"), [(n, lib) for n, f in FORMATS.items() for lib in f.libraries])
def test_a_missing_library_is_said_before_anything_is_written(name, library, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ExtraError, match=re.escape("pip install 'genc[export]'")) as refusal:
        export_world(odd_worlds.rare(), tmp_path / "out", ["csv", name])
    assert name in str(refusal.value)
    assert "\n" not in str(refusal.value)
    assert not (tmp_path / "out").exists()
    assert name not in check_formats([ALL])


def test_a_bare_install_has_the_formats_that_need_nothing(monkeypatch, tmp_path):
    for library in {library for found in FORMATS.values() for library in found.libraries}:
        monkeypatch.setitem(sys.modules, library, None)
    assert list(export_world(odd_worlds.rare(), tmp_path, [ALL])) == ["csv", "eth-ucy", "unity", "unreal"]


def test_a_folder_that_cannot_be_written_to_is_one_line(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OutputError) as refusal:
        export_world(odd_worlds.rare(), tmp_path / "file" / "out", [ALL])
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("name", FORMATS)
def test_a_file_is_whole_or_not_there(name, tmp_path):
    """A folder stands where a file is to be: what was there stays, and nothing else comes."""
    first = export_world(odd_worlds.rare(), tmp_path / "probe", [name])[name][0].name
    (tmp_path / "out" / first / "kept").mkdir(parents=True)
    with pytest.raises(OutputError, match=re.escape(first)) as refusal:
        export_world(odd_worlds.rare(), tmp_path / "out", [name])
    assert "\n" not in str(refusal.value)
    assert files_in(tmp_path / "out") == set()


@pytest.mark.parametrize("name", FORMATS)
def test_a_full_disk_is_one_line_and_leaves_nothing(name, short_world, tmp_path):
    resource = pytest.importorskip("resource", reason="only POSIX limits the size of files")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2_000, limits[1]))
    try:
        with pytest.raises(OutputError) as refusal:
            export_world(short_world, tmp_path, [name])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 300
    assert files_in(tmp_path) == set()


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_has_a_writer_and_is_described(name):
    writer = import_module(f"{export.__name__}.{FORMATS[name].module}").write
    section = re.split(r"^### ", DOCS.read_text(encoding="utf-8"), flags=re.M)
    (described,) = [part for part in section if f"`{name}`" in part.splitlines()[0]]
    for file in re.findall(r"`([\w.]+)`", writer.__doc__ or ""):
        assert f"`{file}`" in described, file
