"""What nobody types on purpose: one line, exit code 2, nothing left behind."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from genc.cli import cli, main
from genc.cli.worlds import WORLD_FILE
from genc.scenario.corpus import load_corpus, themes
from genc.scenario.script import write_script

LONG = "x" * 300
HUGE = "L: plain | outdoor area | 0,0 | 1e9x1e9\nL: gate | entrance | 0,0 | 2x2\n"
FAR = "L: plain | room | 0,0 | 9x9\nL: gate | entrance | 10000000,0 | 2x2\n"


@pytest.fixture
def refused(monkeypatch, capsys):
    """Runs the command line, which has to refuse; gives the line it says."""

    def run(*args: object) -> str:
        monkeypatch.setattr(sys, "argv", ["genc", *map(str, args)])
        with pytest.raises(SystemExit) as stop:
            main()
        out, err = capsys.readouterr()
        assert (stop.value.code, out, len(err.splitlines())) == (2, "", 1), err
        assert err.startswith("error: ")
        return err

    return run


@pytest.mark.parametrize(
    ("wish", "said"),
    [
        (["caf\udce9 guests"], "UTF-8"),
        (["x", "--seed", -1], "--seed"),
        (["x", "--seed", 2**64], "--seed"),
        (["x", "--agents", "many"], "--agents"),
        (["x", "--agents", "1.5"], "--agents"),
        (["x", "--minutes", "inf"], "inf minutes"),
        (["x", "--minutes", "long"], "--minutes"),
        (["x", "--guidance", "nan"], "guidance of nan"),
        (["x", "--model", LONG], "xxx"),
        (["x", "--environment", LONG], "xxx"),
        (["x", "--environment", "."], "folder"),
        (["x", "y"], "y"),
        ([], "TEXT"),
        (["x", "--wings", 2], "--wings"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_populate_refuses(refused, tmp_path, wish, said):
    assert said in refused("populate", *wish, "--out", tmp_path / "w")
    assert not (tmp_path / "w").exists()


@pytest.mark.parametrize(("layout", "axis"), [(HUGE, "in x"), (FAR, "in x")])
def test_a_layout_too_large_to_walk_is_refused(refused, model, tmp_path, layout, axis):
    (tmp_path / "l.txt").write_text(layout)
    where = ["--model", model, "--environment", tmp_path / "l.txt", "--out", tmp_path / "w"]
    assert axis in refused("populate", "x", *where)
    assert list((tmp_path / "w").glob("*")) == []


@pytest.mark.parametrize("command", [["story"], ["stage"], ["train", "--out", "r"], ["corpus", "check"]])
def test_a_path_that_is_too_long_is_refused(refused, tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    assert "xxx" in refused(*command, LONG)
    assert list(tmp_path.iterdir()) == []


def test_scripts_that_leave_nothing_to_validate_on_are_refused(refused, tmp_path):
    for i, theme in enumerate(themes()[:3]):
        (tmp_path / f"{i}.txt").write_text(write_script(load_corpus([theme])[:1]))
    assert "at least 3 of one theme" in refused("dataset", "build", tmp_path, "--out", tmp_path / "d")
    assert not (tmp_path / "d").exists()


def test_a_world_that_cannot_be_written_leaves_the_old_one(refused, model, tmp_path, monkeypatch):
    args = [
        "populate",
        "people wait",
        "--agents",
        "2",
        "--minutes",
        "0.5",
        "--model",
        str(model),
        "--out",
        str(tmp_path),
    ]
    assert CliRunner().invoke(cli, args).exit_code == 0
    before = {file.name: file.read_bytes() for file in tmp_path.iterdir()}
    assert WORLD_FILE in before

    def broken(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", broken)
    assert "No space left" in refused(*args, "--seed", "1")
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == before


def test_the_summary_is_json_even_where_there_are_notes(model, tmp_path):
    (tmp_path / "l.txt").write_text("L: hall | room | 0,0 | 9x9\nL: hut | building | 20,0 | 5x5\n")
    args = ["populate", "Grüße", "--agents", "3", "--minutes", "0.5", "--model", str(model), "--json"]
    done = CliRunner().invoke(cli, [*args, "--environment", str(tmp_path / "l.txt"), "--out", str(tmp_path / "w")])
    said = json.loads(done.stdout)
    assert said["text"] == "Grüße"
    assert [f"note: {note}" for note in said["notes"]] == done.stderr.splitlines()
    assert said["notes"]


def test_a_fault_is_one_line_and_exit_code_2_for_the_shell_too(tmp_path):
    program = "from genc.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", program, "story", str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (2, "", 1)
