"""Still pictures, with a browser and without."""

from __future__ import annotations

import shutil

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import genc
from genc.cli import cli
from genc.errors import GencError
from genc.world import picture
from genc.world.drawing import draw
from genc.world.world_file import write_world


@pytest.fixture(scope="module")
def world():
    return genc.stage(genc.load_corpus(["museum"])[0], minutes=1)


@pytest.fixture(scope="module")
def folder(world, tmp_path_factory):
    folder = tmp_path_factory.mktemp("museum")
    write_world(world, folder / "world.genc")
    return folder


def run(*args):
    return CliRunner().invoke(cli, ["render", *map(str, args)])


def pixels(path) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def size_of(path) -> tuple[int, int]:
    height, width, _ = pixels(path).shape
    return width, height


def test_the_plain_plan_shows_everybody_who_is_there(world):
    with_all = np.asarray(draw(world, 30.0, (800, 600), names=False)).astype(int)
    assert with_all.shape == (600, 800, 3)
    world.motion.present[:] = False
    try:
        empty = np.asarray(draw(world, 30.0, (800, 600), names=False)).astype(int)
    finally:
        world.motion.present[:] = True
    assert (np.abs(with_all - empty).sum(axis=2) > 60).sum() > 200


def test_without_a_browser_the_plain_plan_is_drawn_and_said(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(picture, "BROWSERS", ("no-such-browser",))
    result = run(folder, "--at", 30, "--out", tmp_path / "shot.png", "--width", 640, "--height", 360)
    assert result.exit_code == 0
    assert "plain plan" in result.stderr
    assert size_of(tmp_path / "shot.png") == (640, 360)


def test_a_browser_that_fails_is_as_none(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(picture, "BROWSERS", ("false",))
    assert run(folder, "--out", tmp_path / "shot.png", "--at", 1).exit_code == 0
    assert size_of(tmp_path / "shot.png") == (1600, 900)


@pytest.mark.skipif(
    not any(map(shutil.which, picture.BROWSERS)), reason="install chromium to take pictures of the player"
)
def test_a_browser_takes_a_picture_of_the_player(folder, tmp_path):
    pictures = []
    for view in ("overview", "street"):
        out = tmp_path / f"{view}.png"
        result = run(folder, "--at", 30, "--out", out, "--width", 640, "--height", 360, "--view", view)
        assert (result.exit_code, result.stderr) == (0, "")
        pictures.append(pixels(out))
        assert pictures[-1].shape == (360, 640, 3)
        assert len(np.unique(pictures[-1].reshape(-1, 3), axis=0)) > 100, "the picture is blank"
    assert (np.abs(pictures[0] - pictures[1]).sum(axis=2) > 30).mean() > 0.2, "both views show the same"


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["--at", "61"], "no moment 61 s"),
        (["--agent", "9999"], "no person 9999"),
        (["--view", "below"], "'below'"),
        (["--theme", "blue"], "'blue'"),
        (["--width", "10"], "10 x 900"),
    ],
)
def test_what_cannot_be_shown_is_refused(folder, tmp_path, args, said):
    out = tmp_path / "shot.png"
    result = run(folder, "--at", 1, *args, "--out", out)
    assert isinstance(result.exception, GencError)
    assert said in str(result.exception)
    assert not out.exists()
