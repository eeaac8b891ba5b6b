"""The command line, and a small model to give to it."""

from __future__ import annotations

import sys

import model_folder
import pytest

from genc.cli import main


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    return model_folder.make(tmp_path_factory.mktemp("model"))


@pytest.fixture
def genc(monkeypatch, capsys):
    """Runs the command line; gives exit code, output and error lines."""

    def run(*args: object) -> tuple[int, str, list[str]]:
        monkeypatch.setattr(sys, "argv", ["genc", *map(str, args)])
        try:
            main()
            code = 0
        except SystemExit as stop:
            code = int(stop.code or 0)
        out, err = capsys.readouterr()
        return code, out, err.splitlines()

    return run
