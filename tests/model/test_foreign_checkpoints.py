from __future__ import annotations

import hashlib
import json

import pytest
import tiny
from safetensors.torch import load_file, save_file

from genc.errors import CheckpointError, EncoderError, GencError
from genc.model.checkpoint import load_generator, save_checkpoint
from genc.words.embed import Hashing


@pytest.fixture
def folder(tmp_path):
    save_checkpoint(tmp_path / "model", tiny.generator().model, Hashing.id, {})
    return tmp_path / "model"


def edit(folder, **changes):
    path = folder / "config.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


def refusal(folder, kind: type[GencError] = CheckpointError) -> str:
    with pytest.raises(kind) as refused:
        load_generator(folder)
    assert len(str(refused.value).splitlines()) == 1
    return str(refused.value)


@pytest.mark.parametrize(
    "change", [{"width": "wide"}, {"width": None}, {"width": -1}, {"heads": 3}, {"latent": 4.5}, {"structure_depth": 2}]
)
def test_a_shape_that_is_none_is_refused(folder, change):
    edit(folder, model=json.loads((folder / "config.json").read_text())["model"] | change)
    assert "do not fit" in refusal(folder)


@pytest.mark.parametrize("model", [None, [], "wide", {}])
def test_a_config_without_a_shape_is_refused(folder, model):
    edit(folder, model=model)
    assert "config.json" in refusal(folder)


@pytest.mark.parametrize("change", ["missing", "too many", "other"])
def test_weights_with_the_right_hash_but_other_tensors_are_refused(folder, change):
    path = folder / "model.safetensors"
    tensors = load_file(path)
    name = sorted(tensors)[0]
    tensor = tensors.pop(name)
    save_file(
        tensors | {"missing": {}, "too many": {name: tensor, "more": tensor + 0}, "other": {"x": tensor}}[change], path
    )
    edit(folder, weights_sha256=hashlib.sha256(path.read_bytes()).hexdigest())
    assert "do not fit" in refusal(folder)


def test_bytes_that_are_no_weights_are_refused_even_with_the_right_hash(folder):
    path = folder / "model.safetensors"
    path.write_bytes(b"not weights at all")
    edit(folder, weights_sha256=hashlib.sha256(path.read_bytes()).hexdigest())
    assert "no safetensors file" in refusal(folder)


def test_weights_of_another_run_are_refused(folder):
    path = folder / "model.safetensors"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    assert "not the weights of its config" in refusal(folder)


def test_no_weights_and_no_encoder_are_refused_by_name(folder):
    edit(folder, encoder="glove")
    assert "'glove'" in refusal(folder, EncoderError)
    (folder / "model.safetensors").unlink()
    assert "model.safetensors" in refusal(folder)


def test_a_file_in_place_of_a_folder_is_refused(folder):
    assert "config.json" in refusal(folder / "config.json")
