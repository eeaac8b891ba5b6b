from __future__ import annotations

import json

import numpy as np
import pytest
import tiny

from genc.errors import CheckpointError
from genc.model.checkpoint import load_generator, save_checkpoint
from genc.words.brief import Brief
from genc.words.embed import Hashing


@pytest.fixture
def folder(tmp_path):
    save_checkpoint(tmp_path / "model", tiny.generator().model, Hashing.id, {"by": "a test"})
    return tmp_path / "model"


def _edit(folder, **changes):
    path = folder / "config.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


def test_a_saved_model_gives_the_same_groups(folder):
    briefs = [Brief("people meet")] * 20
    expected = tiny.generator().sample(briefs, np.random.default_rng(0))
    assert load_generator(folder).sample(briefs, np.random.default_rng(0)) == expected


def test_saving_twice_gives_the_same_bytes(folder, tmp_path):
    save_checkpoint(tmp_path / "again", tiny.generator().model, Hashing.id, {"by": "a test"})
    for name in ("config.json", "model.safetensors"):
        assert (folder / name).read_bytes() == (tmp_path / "again" / name).read_bytes()


@pytest.mark.parametrize("share", [0.0, 0.3, 0.99])
def test_weights_cut_short_are_refused(folder, share):
    path = folder / "model.safetensors"
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(CheckpointError, match="cut short"):
        load_generator(folder)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"schema": 99}, "schema 99"),
        ({"generator": "other"}, "'other' generator"),
        ({"vocabulary_hash": "0" * 16}, "another vocabulary"),
        ({"encoder": "all-mpnet-base-v2"}, "all-mpnet-base-v2, which does not go with hashing-64"),
        ({"model": {"width": 16}}, "says nothing of text_dim"),
    ],
)
def test_a_mismatch_is_refused_by_name(folder, change, said):
    _edit(folder, **change)
    with pytest.raises(CheckpointError, match=said):
        load_generator(folder, Hashing())


def test_weights_of_another_shape_are_refused(folder):
    config = json.loads((folder / "config.json").read_text())
    _edit(folder, model=config["model"] | {"width": 32})
    with pytest.raises(CheckpointError, match="do not fit"):
        load_generator(folder)


def test_another_dimension_of_text_is_refused(folder):
    config = json.loads((folder / "config.json").read_text())
    _edit(folder, model=config["model"] | {"text_dim": 384})
    with pytest.raises(CheckpointError, match="text vectors of 384"):
        load_generator(folder)


@pytest.mark.parametrize("content", ["", "{", "[]", '{"a": 1}', "null"])
def test_a_foreign_config_is_refused(folder, content):
    (folder / "config.json").write_text(content)
    with pytest.raises(CheckpointError, match="not the config of a model"):
        load_generator(folder)


def test_a_folder_without_a_model_is_refused(tmp_path):
    with pytest.raises(CheckpointError, match="no model here"):
        load_generator(tmp_path)


def test_the_shipped_model_loads():
    generator = load_generator()
    assert sum(p.numel() for p in generator.model.parameters()) * 4 < 5e6
    assert generator.sample([Brief("students have lunch", n_agents=3)], np.random.default_rng(0))[0].n_agents == 3
