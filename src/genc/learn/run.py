"""A training run on disk: it survives `kill -9`, and the same command goes on to the same weights.

run.json                 how far it is; names the state to go on from; replaced in one rename with each state
state-NNNN.safetensors   all that the trainer needs to go on
model.safetensors, config.json   the finished model
"""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any, Protocol

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor
from tqdm import tqdm

from genc.errors import CheckpointError
from genc.files import ensure_folder, write_text, written_beside
from genc.learn.dataset import Dataset
from genc.learn.paper import PaperTrainer, PaperTraining
from genc.learn.train import TrainConfig, Trainer
from genc.model.checkpoint import Model, save_checkpoint
from genc.model.codec import CodecConfig
from genc.model.paper.vgae import PaperConfig


class Trainee(Protocol):
    """Something that trains in epochs; `state`, `epoch` and `history` are all that a later run needs to go on."""

    epoch: int
    history: list[dict[str, float]]

    @property
    def finished(self) -> bool:
        """Whether there is nothing more to train."""
        ...

    def run_epoch(self) -> str:
        """Trains for one epoch and says how it went."""
        ...

    def state(self) -> dict[str, Tensor]:
        """Everything but `epoch` and `history`, as named tensors."""
        ...

    def restore(self, state: dict[str, Tensor], epoch: int, history: list[dict[str, float]]) -> None:
        """Goes back to what `state` gave after that epoch."""
        ...

    def result(self) -> tuple[Model, dict[str, object]]:
        """The model to keep, and what its card says of the run."""
        ...


def train(
    dataset: Dataset,
    folder: Path | str,
    config: TrainConfig | PaperTraining,
    model: CodecConfig | PaperConfig,
    device: str = "cpu",
) -> Path:
    """Trains to the end of the schedule, or until held-out scenarios gain nothing any more; gives the folder.

    Called again after an interruption it goes on after the last epoch that was saved, on the CPU to the same weights
    bit for bit as a run without interruption (with the same number of threads).

    Args:
        config, model: both of the `codec` generator or both of `paper`.

    Raises:
        CheckpointError: if the folder holds a run of another dataset or other settings, or the device is missing.
        DatasetError: if the dataset has nothing to train on.
        OutputError: if it cannot be written.
    """
    _check_device(device)
    place = ensure_folder(folder)
    plan = {"dataset": dataset.manifest.hash, "train": asdict(config), "model": asdict(model)}
    trainee = _trainee(dataset, config, model, torch.device(device))
    _resume(place, plan, trainee)
    with tqdm(total=config.epochs, initial=trainee.epoch, desc="training", unit="epoch", disable=None) as bar:
        while not trainee.finished:
            bar.set_postfix_str(trainee.run_epoch())
            bar.update()
            if trainee.finished or trainee.epoch % config.save_every == 0:
                _save(place, plan, trainee)
    best, card = trainee.result()
    save_checkpoint(place, best, dataset.manifest.encoder, {**plan, **card, "themes": dataset.manifest.themes})
    return place


def _trainee(
    dataset: Dataset, config: TrainConfig | PaperTraining, model: CodecConfig | PaperConfig, device: torch.device
) -> Trainee:
    if isinstance(config, PaperTraining) and isinstance(model, PaperConfig):
        return PaperTrainer(dataset, model, config, device)
    if isinstance(config, TrainConfig) and isinstance(model, CodecConfig):
        return Trainer(dataset, model, config, device)
    raise TypeError("the settings of the schedule and of the network are those of two generators")


def _check_device(device: str) -> None:
    cuda = ["cuda", *(f"cuda:{i}" for i in range(torch.cuda.device_count()))] if torch.cuda.is_available() else []
    if device not in ("cpu", *cuda):
        raise CheckpointError(f"no device {device!r} was found: choose one of {', '.join(['cpu', *cuda])}")


def _save(place: Path, plan: dict[str, Any], trainee: Trainee) -> None:
    name = f"state-{trainee.epoch:04d}.safetensors"
    with written_beside(place / name) as beside:
        beside.write_bytes(save({key: tensor.contiguous() for key, tensor in trainee.state().items()}))
    said = {"plan": plan, "epoch": trainee.epoch, "state": name, "history": trainee.history}
    write_text(place / "run.json", json.dumps(said, indent=1) + "\n")
    _drop_others(place, name)


def _drop_others(place: Path, state: str) -> None:
    for other in place.glob("state-*.safetensors"):
        if other.name != state:
            other.unlink()


def _resume(place: Path, plan: dict[str, Any], trainee: Trainee) -> None:
    path = place / "run.json"
    if not path.exists():
        return
    try:
        said = json.loads(path.read_text(encoding="utf-8"))
        if said["plan"] != json.loads(json.dumps(plan)):
            raise CheckpointError(
                f"{place}: holds a run with another dataset or other settings: name another folder, or repeat the "
                "command that began it"
            )
        state = load_file(place / said["state"])
        _drop_others(place, said["state"])
        trainee.restore(state, said["epoch"], said["history"])
    except (OSError, ValueError, KeyError, TypeError, RuntimeError, SafetensorError) as error:
        raise CheckpointError(
            f"{path}: the run cannot be gone on with ({error!r}): remove {place} and begin anew"
        ) from error
