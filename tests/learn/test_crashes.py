"""Building and training stopped at every single rename, then called again: the same bytes as without a stop."""

from __future__ import annotations

from pathlib import Path

import pytest
import small

from genc.errors import CheckpointError, DatasetError, OutputError
from genc.learn import build
from genc.learn.build import build_dataset
from genc.learn.dataset import load_dataset
from genc.learn.run import train
from genc.learn.train import TrainConfig
from genc.model.codec import CodecConfig
from genc.scenario.corpus import load_corpus, themes
from genc.words.embed import Hashing

MODEL = CodecConfig(Hashing.dimension, 16, 2, 4, 8, encoder_depth=1, structure_depth=1, feature_depth=1)
CONFIG = TrainConfig(epochs=2, batch_size=64)


class Stopped(BaseException):
    """The power is gone: not even an `except Exception` would see it."""


@pytest.fixture
def stop_at(monkeypatch):
    """Lets the k-th rename from now on stop the program, before or after it has happened."""
    replace = Path.replace

    def arm(k: int, *, after: bool) -> None:
        left = [k]

        def stopping(self, target):
            left[0] -= 1
            if left[0] == 0 and not after:
                raise Stopped
            renamed = replace(self, target)
            if left[0] == 0:
                raise Stopped
            return renamed

        monkeypatch.setattr(Path, "replace", stopping)

    yield arm
    monkeypatch.undo()


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return small.dataset(tmp_path_factory.mktemp("data") / "museum")


@pytest.fixture(scope="module")
def trained(data, tmp_path_factory):
    return contents(train(data, tmp_path_factory.mktemp("run") / "whole", CONFIG, MODEL))


def make(folder: Path) -> None:
    build_dataset(small.scenarios()[:3], Hashing(), folder)


def contents(folder: Path) -> dict[str, bytes]:
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.parametrize("after", [False, True])
def test_a_dataset_stopped_at_any_rename_is_completed(tmp_path, stop_at, monkeypatch, after):
    monkeypatch.setattr(build, "BLOCK", 40)
    make(tmp_path / "whole")
    expected, k, stops = contents(tmp_path / "whole"), 0, 0
    while stops == k:
        k += 1
        stop_at(k, after=after)
        try:
            make(tmp_path / str(k))
        except Stopped:
            stops += 1
            if "manifest.json" not in contents(tmp_path / str(k)):
                with pytest.raises(DatasetError, match="no dataset here"):
                    load_dataset(tmp_path / str(k))
        stop_at(0, after=after)
        make(tmp_path / str(k))
        assert contents(tmp_path / str(k)) == expected
    assert stops >= 5


@pytest.mark.parametrize("k", range(1, 7))
def test_a_run_stopped_at_any_rename_ends_with_the_same_weights(data, trained, tmp_path, stop_at, k):
    stop_at(k, after=k % 2 == 0)
    with pytest.raises(Stopped):
        train(data, tmp_path, CONFIG, MODEL)
    stop_at(0, after=False)
    train(data, tmp_path, CONFIG, MODEL)
    assert contents(tmp_path) == trained


def test_a_finished_run_called_again_changes_nothing(data, trained, tmp_path):
    train(data, tmp_path, CONFIG, MODEL)
    train(data, tmp_path, CONFIG, MODEL)
    assert contents(tmp_path) == trained


def test_scenarios_that_leave_nothing_to_validate_on_make_no_dataset(tmp_path):
    one_of_each = [load_corpus([theme])[0] for theme in themes()[:4]]
    with pytest.raises(DatasetError, match="at least 3 of one theme"):
        build_dataset(one_of_each, Hashing(), tmp_path / "d")
    assert not (tmp_path / "d").exists()


@pytest.mark.parametrize("at", range(0, 1000, 90))
def test_a_dataset_with_a_flipped_byte_is_refused_or_whole(tmp_path, at):
    small.dataset(tmp_path)
    path = tmp_path / "groups.safetensors"
    content = bytearray(path.read_bytes())
    content[len(content) * at // 1000] ^= 0x55
    path.write_bytes(content)
    try:
        dataset = load_dataset(tmp_path)
    except DatasetError:
        return
    assert [sample for part in ("train", "validation", "test") for sample in dataset.split(part)]


def test_a_full_disk_is_an_error_of_the_place_not_of_the_program(data, tmp_path, monkeypatch):
    def full(self, content):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OutputError, match="No space left"):
        small.dataset(tmp_path / "d")
    with pytest.raises(OutputError, match="No space left"):
        train(data, tmp_path / "r", CONFIG, MODEL)
    assert contents(tmp_path) == {}


@pytest.mark.parametrize("device", ["foo", "", "cuda:99", "mps"])
def test_a_device_that_is_not_there_is_refused_by_name(data, tmp_path, device):
    with pytest.raises(CheckpointError, match=f"no device '{device}'"):
        train(data, tmp_path / "run", CONFIG, MODEL, device=device)
