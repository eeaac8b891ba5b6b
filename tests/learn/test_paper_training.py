from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
import small
import torch

from genc.errors import BriefError, CheckpointError, DatasetError
from genc.graph.codec import group_fault
from genc.learn.dataset import Dataset
from genc.learn.paper import PaperBatches, PaperTrainer, PaperTraining, annealed, learning_rate, paper_shape
from genc.learn.run import train
from genc.model.checkpoint import load_generator
from genc.model.codec import CodecConfig
from genc.model.paper.generator import PaperGenerator
from genc.words.brief import Brief
from genc.words.embed import Hashing

TRAINING = PaperTraining(epochs=4, batch_size=32, save_every=2)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Dataset:
    return small.dataset(tmp_path_factory.mktemp("data") / "museum")


def test_beta_climbs_through_the_first_half_of_each_cycle() -> None:
    betas = [annealed((0.001, 3.0), epoch, 100) for epoch in range(200)]
    assert betas[0] == betas[100] == 0.001
    assert betas[25] == pytest.approx(0.001 + 2.999 / 2)
    assert betas[50] == betas[99] == 3.0
    assert betas[:100] == betas[100:]
    assert all(b > a for a, b in itertools.pairwise(betas[:51]))


def test_the_learning_rate_falls_in_a_line_to_a_quarter() -> None:
    rates = [learning_rate(PaperTraining(), epoch) for epoch in range(500)]
    assert (rates[0], rates[-1]) == (5e-4, pytest.approx(1.25e-4))
    assert np.diff(rates) == pytest.approx([-3.75e-4 / 499] * 499)


def test_the_schedule_is_the_papers(data: Dataset) -> None:
    schedule = PaperTraining()
    assert (schedule.epochs, schedule.batch_size, schedule.cycle) == (500, 128, 100)
    assert (schedule.beta_structure, schedule.beta_features) == ((0.001, 3.0), (0.001, 1.0))
    trainer = PaperTrainer(data, paper_shape(data, None), schedule, torch.device("cpu"))
    (group,) = trainer.optimizer.param_groups
    assert isinstance(trainer.optimizer, torch.optim.Adam)
    assert (group["lr"], group["weight_decay"]) == (5e-4, 3e-4)


def test_stopped_and_called_again_a_run_ends_with_the_same_weights(
    data: Dataset, tmp_path: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    shape = paper_shape(data, None)
    whole = train(data, f"{tmp_path}/whole", TRAINING, shape)
    run_epoch = PaperTrainer.run_epoch

    def stopping(trainer: PaperTrainer) -> str:
        if trainer.epoch == 3:
            raise KeyboardInterrupt
        return run_epoch(trainer)

    with monkeypatch.context() as patched:
        patched.setattr(PaperTrainer, "run_epoch", stopping)
        with pytest.raises(KeyboardInterrupt):
            train(data, f"{tmp_path}/again", TRAINING, shape)
    again = train(data, f"{tmp_path}/again", TRAINING, shape)
    for name in ("model.safetensors", "config.json", "run.json"):
        assert (whole / name).read_bytes() == (again / name).read_bytes()


@pytest.mark.parametrize("variant", ["full", "unordered", "single"])
def test_each_variant_trains_loads_and_answers(data: Dataset, tmp_path: object, variant: str) -> None:
    folder = train(data, f"{tmp_path}/run", TRAINING, paper_shape(data, None, variant))
    generator = load_generator(folder, Hashing())
    assert isinstance(generator, PaperGenerator)
    assert len(generator.model.encoders) == len(generator.model.priors) == (1 if variant == "single" else 2)
    answers = generator.decode([Brief("they look", 3, 4, 12), Brief("anything")] * 5, np.random.default_rng(0))
    for answer in answers:
        assert group_fault(answer.group) is None
    assert {(a.group.n_agents, a.group.n_events, a.group.n_nodes) for a in answers[::2]} == {(3, 4, 12)}


def test_training_lowers_both_losses(data: Dataset) -> None:
    trainer = PaperTrainer(data, paper_shape(data, None), replace(TRAINING, epochs=8), torch.device("cpu"))
    while not trainer.finished:
        trainer.run_epoch()
    assert trainer.history[-1]["structure"] < 0.8 * trainer.history[0]["structure"]
    assert trainer.history[-1]["features"] < trainer.history[0]["features"]


def test_without_canonical_order_a_graph_keeps_an_order_of_its_own(data: Dataset) -> None:
    canonical, one, same = (PaperBatches(data, "train", TRAINING, canonical=order) for order in (True, False, False))
    moved = 0
    for straight, mixed, again in zip(canonical.graphs, one.graphs, same.graphs, strict=True):
        assert torch.equal(mixed.adjacency, again.adjacency)
        eigenvalues = [torch.linalg.eigvalsh(g.adjacency[0]) for g in (straight, mixed)]
        torch.testing.assert_close(*eigenvalues, atol=1e-4, rtol=0)
        assert sorted(straight.nodes.action.tolist()) == sorted(mixed.nodes.action.tolist())
        moved += not torch.equal(straight.adjacency, mixed.adjacency)
    assert moved > len(canonical) / 2


def test_an_epoch_shows_every_group_once_with_a_text_of_its_scenario(data: Dataset) -> None:
    batches = PaperBatches(data, "train", TRAINING, canonical=True)
    shown = list(batches.epoch(32, np.random.default_rng(0)))
    assert sum(len(batch.adjacency) for batch, _ in shown) == len(batches)
    sizes = torch.cat([batch.structures.n_nodes for batch, _ in shown])
    assert sorted(sizes.tolist()) == sorted(batches.counts[:, 2].tolist())
    texts = {tuple(row) for texts in batches.texts for row in data.embeddings[list(texts)].tolist()}
    asked = torch.cat([given.text for _, given in shown])
    assert {tuple(row) for row in asked.tolist()} <= texts


def test_what_cannot_be_trained_is_refused(data: Dataset, tmp_path: object) -> None:
    with pytest.raises(DatasetError, match="no groups of theme 'moon'"):
        paper_shape(data, "moon")
    with pytest.raises(BriefError, match="no variant 'triple'"):
        paper_shape(data, None, "triple")
    with pytest.raises(TypeError, match="two generators"):
        train(data, f"{tmp_path}/run", TRAINING, CodecConfig(Hashing.dimension))
    train(data, f"{tmp_path}/run", replace(TRAINING, epochs=1), paper_shape(data, None))
    with pytest.raises(CheckpointError, match="other settings"):
        train(data, f"{tmp_path}/run", TRAINING, paper_shape(data, None))
