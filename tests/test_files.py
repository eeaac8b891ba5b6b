from __future__ import annotations

import pytest

from genc.errors import OutputError
from genc.files import ensure_folder, write_text, written_beside


def test_a_file_appears_whole_and_alone(tmp_path):
    write_text(tmp_path / "deep" / "down" / "a.txt", "grüße")
    assert (tmp_path / "deep" / "down" / "a.txt").read_text(encoding="utf-8") == "grüße"
    assert [p.name for p in (tmp_path / "deep" / "down").iterdir()] == ["a.txt"]


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt])
def test_a_failure_half_way_leaves_what_was_there(tmp_path, failure):
    target = tmp_path / "a.txt"
    target.write_text("old")

    def write_half() -> None:
        with written_beside(target) as beside:
            beside.write_text("half")
            assert target.read_text() == "old"
            raise failure

    with pytest.raises(failure):
        write_half()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_folder_half_made_is_removed(tmp_path):
    def make_half() -> None:
        with written_beside(tmp_path / "folder") as beside:
            (beside / "inside").mkdir(parents=True)
            raise ValueError("stop")

    with pytest.raises(ValueError, match="stop"):
        make_half()
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["file/below", "x" * 300, "y" * 253, "folder"])
def test_a_place_where_nothing_can_be_written_is_named(tmp_path, name):
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(OutputError, match="cannot be written"):
        write_text(tmp_path / name, "text")
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ["file", "file/below", "x" * 300])
def test_a_folder_that_cannot_be_made_is_named(tmp_path, name):
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="cannot be written to"):
        ensure_folder(tmp_path / name)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
