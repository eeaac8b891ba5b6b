from __future__ import annotations

import sys

import pytest
from hypothesis import settings

from genc.cli import main

# A busy machine is no fault of the code: how long an example takes is not what the properties are about.
settings.register_profile("genc", deadline=None)
settings.load_profile("genc")


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
