from __future__ import annotations

import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
import small
import torch

from genc.errors import CheckpointError
from genc.learn.batches import Asking, Batches
from genc.learn.run import train
from genc.learn.train import TrainConfig
from genc.model.checkpoint import load_generator
from genc.model.codec import CodecConfig
from genc.words.brief import Brief
from genc.words.embed import Hashing

MODEL = CodecConfig(
    Hashing.dimension, 16, 2, latent=4, condition=8, encoder_depth=1, structure_depth=1, feature_depth=1
)
CONFIG = TrainConfig(epochs=3, batch_size=32)

RUN = """
import sys
sys.path.insert(0, {tests!r})
import torch
torch.set_num_threads(1)
from pathlib import Path
import test_train
from genc.learn.dataset import load_dataset
test_train.train(load_dataset({data!r}), {out!r}, test_train.CONFIG, test_train.MODEL)
"""


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data") / "museum"
    return folder, small.dataset(folder)


def _script(data, out):
    return RUN.format(tests=small.__file__.rsplit("/", 1)[0], data=str(data[0]), out=str(out))


def test_killed_after_an_epoch_a_run_goes_on_to_the_same_weights(data, tmp_path):
    train(data[1], tmp_path / "whole", CONFIG, MODEL)
    process = subprocess.Popen([sys.executable, "-c", _script(data, tmp_path / "killed")])
    while process.poll() is None and not (tmp_path / "killed" / "run.json").exists():
        time.sleep(0.01)
    process.kill()
    process.wait()
    assert not (tmp_path / "killed" / "config.json").exists(), "it ended before it could be killed"
    train(data[1], tmp_path / "killed", CONFIG, MODEL)
    for name in ("model.safetensors", "config.json", "run.json"):
        assert (tmp_path / "killed" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    group = load_generator(tmp_path / "killed").sample([Brief("look", n_agents=2)], np.random.default_rng(0))[0]
    assert group.n_agents == 2


def test_training_lowers_the_loss_on_held_out_scenarios(data, tmp_path):
    import json

    train(data[1], tmp_path / "run", replace(CONFIG, epochs=4), MODEL)
    history = json.loads((tmp_path / "run" / "run.json").read_text())["history"]
    assert history[-1]["features"] < history[0]["features"]
    assert history[-1]["structure"] < history[0]["structure"]


def test_a_run_with_other_settings_is_refused_and_so_is_a_damaged_one(data, tmp_path):
    train(data[1], tmp_path / "run", replace(CONFIG, epochs=1), MODEL)
    with pytest.raises(CheckpointError, match="other settings"):
        train(data[1], tmp_path / "run", replace(CONFIG, epochs=2), MODEL)
    (tmp_path / "run" / "run.json").write_text("{")
    with pytest.raises(CheckpointError, match="begin anew"):
        train(data[1], tmp_path / "run", replace(CONFIG, epochs=1), MODEL)


def test_a_missing_device_is_refused(data, tmp_path, monkeypatch):
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    with pytest.raises(CheckpointError, match="no device 'cuda'"):
        train(data[1], tmp_path / "run", CONFIG, MODEL, device="cuda")


def test_an_epoch_shows_every_group_once_and_asks_in_every_way(data):
    dataset = data[1]
    batches = Batches(dataset, dataset.rows("train"), torch.device("cpu"))
    shown = list(batches.epoch(16, Asking(), torch.Generator().manual_seed(0)))
    tokens = sorted(str(t.structure.tolist() + t.action.tolist()) for batch in shown for t in batch.groups.tokens())
    expected = [dataset.tokens[g] for g in dataset.rows("train")]
    assert tokens == sorted(str(t.structure.tolist() + t.action.tolist()) for t in expected)
    asked_text = torch.cat([batch.given.text.any(1) for batch in shown])
    asked_shares = torch.cat([batch.given.frequencies.any(1) for batch in shown])
    assert asked_text.any()
    assert not asked_text.all()
    assert asked_shares.any()
    assert not asked_shares.all()
