"""A training run on disk: it survives `kill -9`, and the same command goes on to the same weights.

run.json                 how far it is; names the state to go on from; replaced in one rename after each epoch
state-NNNN.safetensors   weights, their running average, the optimizer, the best weights so far
model.safetensors, config.json   the finished model
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError
from safetensors.torch import load_file, save
from torch import Tensor
from tqdm import tqdm

from genc.errors import CheckpointError
from genc.files import ensure_folder, write_text, written_beside
from genc.learn.dataset import Dataset
from genc.learn.train import TrainConfig, Trainer
from genc.model.checkpoint import save_checkpoint
from genc.model.codec import CodecConfig


@dataclass
class _Best:
    """The weights that did best on held-out scenarios; the counts part is judged apart from the rest, for they share
    no weights."""

    group: float = float("inf")
    counts: float = float("inf")
    group_epoch: int = 0
    counts_epoch: int = 0


def train(dataset: Dataset, folder: Path | str, config: TrainConfig, model: CodecConfig, device: str = "cpu") -> Path:
    """Trains to the end of the schedule, or until held-out scenarios gain nothing any more; gives the folder.

    Called again after an interruption it goes on after the last whole epoch, on the CPU to the same weights bit for
    bit as a run without interruption (with the same number of threads).

    Raises:
        CheckpointError: if the folder holds a run of another dataset or other settings, or the device is missing.
        OutputError: if it cannot be written.
    """
    _check_device(device)
    place = ensure_folder(folder)
    plan = {"dataset": dataset.manifest.hash, "train": asdict(config), "model": asdict(model)}
    trainer = Trainer(dataset, model, config, torch.device(device))
    best, kept = _resume(place, plan, trainer)
    with tqdm(total=config.epochs, initial=trainer.epoch, desc="training", unit="epoch", disable=None) as bar:
        while not _finished(trainer, best):
            losses = trainer.run_epoch()
            _keep(trainer, best, kept, losses.group, losses.counts)
            _save(place, plan, trainer, best, kept)
            bar.set_postfix_str(f"held out {losses.group:.2f} nats a group, best {best.group:.2f}")
            bar.update()
    trainer.averaged.load_state_dict(kept)
    card = {**plan, "best": asdict(best), "epochs_run": trainer.epoch, "themes": dataset.manifest.themes}
    save_checkpoint(place, trainer.averaged, dataset.manifest.encoder, card)
    return place


def _check_device(device: str) -> None:
    cuda = ["cuda", *(f"cuda:{i}" for i in range(torch.cuda.device_count()))] if torch.cuda.is_available() else []
    if device not in ("cpu", *cuda):
        raise CheckpointError(f"no device {device!r} was found: choose one of {', '.join(['cpu', *cuda])}")


def _finished(trainer: Trainer, best: _Best) -> bool:
    stale = trainer.epoch - max(best.group_epoch, best.counts_epoch)
    return trainer.epoch >= trainer.config.epochs or stale >= trainer.config.patience


def _keep(trainer: Trainer, best: _Best, kept: dict[str, Tensor], group: float, counts: float) -> None:
    state = trainer.averaged.state_dict()
    better_group, better_counts = group < best.group, counts < best.counts
    for name, tensor in state.items():
        if better_counts if name.startswith("counts.") else better_group:
            kept[name] = tensor.detach().clone()
    if better_group:
        best.group, best.group_epoch = group, trainer.epoch
    if better_counts:
        best.counts, best.counts_epoch = counts, trainer.epoch


def _save(place: Path, plan: dict[str, Any], trainer: Trainer, best: _Best, kept: dict[str, Tensor]) -> None:
    state = {f"best.{name}": tensor for name, tensor in kept.items()} | trainer.state()
    name = f"state-{trainer.epoch:04d}.safetensors"
    with written_beside(place / name) as beside:
        beside.write_bytes(save({key: tensor.contiguous() for key, tensor in state.items()}))
    said = {"plan": plan, "epoch": trainer.epoch, "state": name, "best": asdict(best), "history": trainer.history}
    write_text(place / "run.json", json.dumps(said, indent=1) + "\n")
    _drop_others(place, name)


def _drop_others(place: Path, state: str) -> None:
    for other in place.glob("state-*.safetensors"):
        if other.name != state:
            other.unlink()


def _resume(place: Path, plan: dict[str, Any], trainer: Trainer) -> tuple[_Best, dict[str, Tensor]]:
    path = place / "run.json"
    if not path.exists():
        return _Best(), {}
    try:
        said = json.loads(path.read_text(encoding="utf-8"))
        if said["plan"] != json.loads(json.dumps(plan)):
            raise CheckpointError(
                f"{place}: holds a run with another dataset or other settings: name another folder, or repeat the "
                "command that began it"
            )
        state = load_file(place / said["state"])
        _drop_others(place, said["state"])
        trainer.restore(state, said["epoch"], said["history"])
        kept = {key.removeprefix("best."): tensor for key, tensor in state.items() if key.startswith("best.")}
        return _Best(**said["best"]), kept
    except (OSError, ValueError, KeyError, TypeError, RuntimeError, SafetensorError) as error:
        raise CheckpointError(
            f"{path}: the run cannot be gone on with ({error!r}): remove {place} and begin anew"
        ) from error
