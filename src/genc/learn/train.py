"""Training of the `codec` generator: resumable to the bit, with early stopping on held-out scenarios."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field

import torch
from torch import Tensor, nn

from genc.learn.batches import Asking, Batch, Batches
from genc.learn.dataset import Dataset
from genc.model.codec import CodecConfig, CodecModel, Terms


@dataclass(frozen=True)
class TrainConfig:
    """How to train.

    Attributes:
        epochs: length of the schedule.
        free_nats: the KL term (per group, both latents) is not pressed below this.
        average: decay of the running average of the weights that is validated and kept.
        patience: epochs without gain on held-out scenarios after which training ends.
        asking: how groups are asked for, and what is left out of the asking how often.
    """

    epochs: int = 32
    batch_size: int = 96
    learning_rate: float = 2e-3
    weight_decay: float = 0.05
    free_nats: float = 3.0
    average: float = 0.998
    patience: int = 15
    seed: int = 0
    asking: Asking = field(default_factory=Asking)


@dataclass(frozen=True)
class Losses:
    """Mean nats per group on held-out groups, each term apart."""

    structure: float
    features: float
    kl: float
    counts: float

    @property
    def group(self) -> float:
        """The bound on -log p(group | counts, conditions)."""
        return self.structure + self.features + self.kl


class Trainer:
    """Trains in epochs; `progress` is everything that a later run needs to go on."""

    def __init__(self, dataset: Dataset, model: CodecConfig, config: TrainConfig, device: torch.device) -> None:
        self.config, self.device = config, device
        torch.manual_seed(config.seed)
        self.model = CodecModel(model).to(device)
        self.averaged = CodecModel(model).to(device)
        self.averaged.load_state_dict(self.model.state_dict())
        decayed = [p for p in self.model.parameters() if p.ndim > 1]
        plain = [p for p in self.model.parameters() if p.ndim <= 1]
        self.optimizer = torch.optim.AdamW(
            [{"params": decayed, "weight_decay": config.weight_decay}, {"params": plain, "weight_decay": 0.0}],
            lr=config.learning_rate,
            betas=(0.9, 0.98),
        )
        self.train_batches = Batches(dataset, dataset.rows("train"), device)
        self.held_out = Batches(dataset, dataset.rows("validation"), device)
        self.epoch = 0
        self.history: list[dict[str, float]] = []

    def run_epoch(self) -> Losses:
        """Trains for one epoch and gives the losses on held-out scenarios."""
        # all chance of an epoch follows from (seed, epoch): a resumed run needs no generator state
        torch.manual_seed(self.config.seed * 100_003 + self.epoch)
        generator = torch.Generator().manual_seed(self.config.seed * 100_003 + self.epoch)
        self.model.train()
        size = self.config.batch_size
        n_batches = math.ceil(len(self.train_batches) / size)
        for i, batch in enumerate(self.train_batches.epoch(size, self.config.asking, generator)):
            self._step(batch, self.epoch + i / n_batches)
        self.epoch += 1
        losses = self.validate()
        self.history.append({"epoch": self.epoch, **asdict(losses)})
        return losses

    @torch.inference_mode()
    def validate(self) -> Losses:
        """The losses of the averaged weights on held-out scenarios, over four ways of asking."""
        self.averaged.eval()
        torch.manual_seed(0)
        totals = torch.zeros(4)
        ways = [("sentence", True), ("sentence", False), ("caption", False)]
        for text, frequencies in ways:
            for batch in self.held_out.fixed(256, text, frequencies=frequencies):
                terms = self.averaged(batch.groups, batch.trace, batch.given)
                totals += torch.stack(
                    [t.sum().cpu() for t in (terms.structure, terms.features, terms.kl, terms.counts)]
                )
        return Losses(*(totals / (len(ways) * len(self.held_out))).tolist())

    def state(self) -> dict[str, Tensor]:
        """Everything but `epoch` and `history` that a later run needs, as named tensors."""
        named = {f"model.{k}": v for k, v in self.model.state_dict().items()}
        named |= {f"averaged.{k}": v for k, v in self.averaged.state_dict().items()}
        for index, moments in self.optimizer.state_dict()["state"].items():
            named |= {f"optimizer.{index}.{k}": v for k, v in moments.items()}
        return named

    def restore(self, state: dict[str, Tensor], epoch: int, history: list[dict[str, float]]) -> None:
        """Goes back to what `state` gave after that epoch."""
        self.model.load_state_dict(_under("model.", state))
        self.averaged.load_state_dict(_under("averaged.", state))
        optimizer = self.optimizer.state_dict()
        moments: dict[int, dict[str, Tensor]] = {}
        for key, tensor in _under("optimizer.", state).items():
            index, name = key.split(".")
            moments.setdefault(int(index), {})[name] = tensor
        self.optimizer.load_state_dict({**optimizer, "state": moments})
        self.epoch, self.history = epoch, history

    def _step(self, batch: Batch, at_epoch: float) -> None:
        for group in self.optimizer.param_groups:
            group["lr"] = self.config.learning_rate * _schedule(at_epoch, self.config.epochs)
        terms = self.model(batch.groups, batch.trace, batch.given)
        self.optimizer.zero_grad(set_to_none=True)
        torch.autograd.backward(self._objective(terms))
        nn.utils.clip_grad_norm_(self.model.parameters(), 2.0)
        self.optimizer.step()
        with torch.no_grad():
            decay = min(self.config.average, at_epoch / (at_epoch + 1))
            for slow, fast in zip(self.averaged.parameters(), self.model.parameters(), strict=True):
                slow.lerp_(fast, 1 - decay)

    def _objective(self, terms: Terms) -> Tensor:
        """Gen-C, Training Objective, with beta = 1 and a floor under the KL term."""
        kl = terms.kl.mean()
        floored = kl if kl > self.config.free_nats else terms.prior_fit.mean()
        return terms.structure.mean() + terms.features.mean() + floored + terms.counts.mean()


def _schedule(at_epoch: float, epochs: int) -> float:
    """Linear warm-up over two epochs, then a half cosine down to 2 %."""
    if at_epoch < 2:
        return (at_epoch + 0.05) / 2.05
    return 0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * (at_epoch - 2) / max(epochs - 2, 1)))


def _under(prefix: str, state: dict[str, Tensor]) -> dict[str, Tensor]:
    return {key.removeprefix(prefix): tensor for key, tensor in state.items() if key.startswith(prefix)}
