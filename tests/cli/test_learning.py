"""`genc dataset build` and `genc train` from scripts to a model that populates."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner

from genc.cli import cli

SCRIPT = Path(__file__).parents[2] / "src/genc/corpora/museum/01.txt"


def run(*args: object):
    return CliRunner().invoke(cli, [str(a) for a in args])


def test_scripts_become_a_dataset_and_a_model(tmp_path):
    data, model = tmp_path / "data", tmp_path / "model"
    built = run("dataset", "build", SCRIPT, "--out", data, "--encoder", "hashing")
    assert built.exit_code == 0, built.output
    assert "16 scenarios" in built.output
    trained = run("train", data, "--out", model, "--epochs", 1, "--batch-size", 64)
    assert trained.exit_code == 0, trained.output
    made = run("populate", "people look", "--agents", 4, "--model", model, "--out", tmp_path / "world", "--minutes", 1)
    assert made.exit_code == 0, made.output


def test_what_cannot_be_done_is_said_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    for args, said in (
        (["dataset", "build", "--out", tmp_path / "d", "--encoder", "glove"], "no text encoder"),
        (["dataset", "build", tmp_path / "none", "--out", tmp_path / "d"], "none"),
        (["dataset", "build", SCRIPT, "--out", tmp_path / "file" / "d", "--encoder", "hashing"], "cannot be written"),
        (["train", tmp_path, "--out", tmp_path / "m"], "no dataset here"),
        (["train", tmp_path, "--out", tmp_path / "m", "--epochs", 0], "--epochs 0"),
    ):
        result = run(*args)
        assert result.exception is not None
        assert said in str(result.exception), (args, result.exception)
        assert "\n" not in str(result.exception)
