"""The player that ships is the one that its source makes; and its own types and tests hold."""

from __future__ import annotations

import shutil
import subprocess
from importlib.resources import files
from pathlib import Path

import pytest
from browsing import missing

SOURCE = Path(__file__).parents[2] / "player"


@pytest.fixture(scope="module")
def npx():
    program = shutil.which("npx")
    if program is None:
        missing("building the player needs Node.js 20.19 or newer")
    if not (SOURCE / "node_modules").is_dir():
        missing("building the player needs its packages: run 'npm ci' in player/")

    def run(*args: str) -> None:
        done = subprocess.run([program, *args], cwd=SOURCE, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr

    return run


def test_the_shipped_player_is_fresh(npx, tmp_path):
    npx("vite", "build", "--outDir", str(tmp_path), "--emptyOutDir")
    shipped = Path(str(files("genc.world").joinpath("player")))
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(path.name for path in shipped.iterdir())
    fresh = (tmp_path / "index.html").read_bytes() == (shipped / "index.html").read_bytes()
    assert fresh, "src/genc/world/player is out of date: run 'npm run build' in player/ and commit what it writes"


def test_its_types_hold(npx):
    npx("tsc", "--noEmit")


def test_its_own_tests_pass(npx):
    npx("vitest", "run")
