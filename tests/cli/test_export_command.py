from __future__ import annotations

import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from genc.cli import cli
from genc.cli.worlds import WORLD_FILE
from genc.world.export import FORMATS

SCRIPT = Path(__file__).parents[2] / "src/genc/corpora/museum/01.txt"


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    out = tmp_path_factory.mktemp("world")
    args = ["stage", str(SCRIPT), "--minutes", "1", "--out", str(out)]
    assert CliRunner().invoke(cli, args, catch_exceptions=False).exit_code == 0
    return out


def test_the_files_are_written_and_listed_with_their_sizes(genc, world, tmp_path):
    for source in (world, world / WORLD_FILE):
        code, out, err = genc("export", source, "--to", "usd,jupedsim, Unity", "--out", tmp_path / "x")
        assert (code, err) == (0, [])
        names = ["crowd_instances.usdc", "crowd_people.usdc", "trajectories.sqlite", "unity.json"]
        assert [line.split(": ")[0] for line in out.splitlines()] == [str(tmp_path / "x" / name) for name in names]
        assert all(line.endswith(("kB", "MB")) for line in out.splitlines())
        assert sorted(path.name for path in (tmp_path / "x").iterdir()) == names


def test_all_means_all_that_are_there_and_says_what_is_left_out(genc, world, tmp_path, monkeypatch):
    code, out, err = genc("export", world, "--to", "all", "--out", tmp_path / "full")
    assert (code, err, len(out.splitlines())) == (0, [], 14)
    monkeypatch.setitem(sys.modules, "pxr", None)
    code, out, err = genc("export", world, "--to", "all", "--out", tmp_path / "most")
    assert (code, len(out.splitlines())) == (0, 12)
    assert err == ["note: left out usd: pip install 'genc[export]'"]


def test_the_help_names_every_format(genc):
    _, out, _ = genc("export", "--help")
    assert all(name in out for name in FORMATS)


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["--to", "usd,fbx"], "there is no format 'fbx'"),
        (["--to", ""], "there is no format ''"),
        (["--to", ","], "there is no format ''"),
        ([], "Missing option '--to'"),
        (["--to", "csv", "--out", "{file}/x"], "cannot be written"),
        (["--to", "csv", "--out", "{file}"], "cannot be written"),
    ],
)
def test_bad_requests_are_one_line_and_exit_code_2(genc, world, tmp_path, args, said):
    (tmp_path / "file").write_text("kept")
    where = [] if "--out" in args else ["--out", tmp_path / "x"]
    code, out, err = genc("export", world, *(arg.format(file=tmp_path / "file") for arg in args), *where)
    assert (code, out, len(err)) == (2, "", 1)
    assert err[0].startswith("error: ")
    assert said in err[0]
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_missing_library_is_one_line_and_exit_code_2(genc, world, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    code, out, err = genc("export", world, "--to", "csv,hdf5", "--out", tmp_path / "x")
    assert (code, out, len(err)) == (2, "", 1)
    assert "'hdf5'" in err[0]
    assert "genc[export]" in err[0]
    assert not (tmp_path / "x").exists()


def test_a_missing_or_foreign_world_is_one_line_and_exit_code_2(genc, tmp_path):
    (tmp_path / "foreign").write_text("hello")
    for source in (tmp_path, tmp_path / "none.genc", tmp_path / "foreign"):
        code, out, err = genc("export", source, "--to", "csv", "--out", tmp_path / "x")
        assert (code, out, len(err)) == (2, "", 1)
        assert not (tmp_path / "x").exists()
