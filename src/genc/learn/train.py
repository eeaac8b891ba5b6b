"""Training of the `codec` generator, with early stopping on held-out scenarios."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field

import torch
from torch import Tensor, nn

from genc.learn.batches import Asking, Batch, Batches
from genc.learn.dataset import Dataset, training_rows
from genc.learn.state import named_state, restore_state, under
from genc.model.codec import CodecConfig, CodecModel, Terms


@dataclass(frozen=True)
class TrainConfig:
    """How to train.

    Attributes:
        theme: only scenarios of this theme, None for all.
        epochs: length of the schedule.
        free_nats: the KL term (per group, both latents) is not pressed below this.
        average: decay of the running average of the weights that is validated and kept.
        patience: epochs without gain on held-out scenarios after which training ends.
        save_every: epochs between two savings of the run.
        asking: how groups are asked for, and what is left out of the asking how often.
    """

    theme: str | None = None
    epochs: int = 32
    batch_size: int = 96
    learning_rate: float = 2e-3
    weight_decay: float = 0.05
    free_nats: float = 3.0
    average: float = 0.998
    patience: int = 15
    save_every: int = 1
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
    """A `Trainee`; what it keeps are the averaged weights that did best on held-out scenarios.

    The part that draws counts is judged apart from the rest, for they share no weights.
    """

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
        self.train_batches = Batches(dataset, training_rows(dataset, config.theme), device)
        self.held_out = Batches(dataset, dataset.rows("validation", config.theme), device)
        self.epoch = 0
        self.history: list[dict[str, float]] = []
        self.kept: dict[str, Tensor] = {}

    @property
    def finished(self) -> bool:
        """Whether the schedule has come to its end, or held-out scenarios gain nothing any more."""
        stale = self.epoch - max(self._best("group")[1], self._best("counts")[1])
        return self.epoch >= self.config.epochs or stale >= self.config.patience

    def run_epoch(self) -> str:
        """Trains for one epoch and says how held-out scenarios fare."""
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
        self.history.append({"epoch": self.epoch, **asdict(losses), "group": losses.group})
        self._keep()
        return f"held out {losses.group:.2f} nats a group, best {self._best('group')[0]:.2f}"

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
        modules = {"model": self.model, "averaged": self.averaged}
        return named_state(modules, self.optimizer) | {f"best.{name}": tensor for name, tensor in self.kept.items()}

    def restore(self, state: dict[str, Tensor], epoch: int, history: list[dict[str, float]]) -> None:
        """Goes back to what `state` gave after that epoch."""
        restore_state(state, {"model": self.model, "averaged": self.averaged}, self.optimizer)
        self.kept = under("best.", state)
        self.epoch, self.history = epoch, history

    def result(self) -> tuple[CodecModel, dict[str, object]]:
        """The best weights, and how they were found."""
        self.averaged.load_state_dict(self.kept)
        (group, group_epoch), (counts, counts_epoch) = self._best("group"), self._best("counts")
        best = {"group": group, "counts": counts, "group_epoch": group_epoch, "counts_epoch": counts_epoch}
        return self.averaged, {"best": best, "epochs_run": self.epoch}

    def _best(self, part: str) -> tuple[float, int]:
        """The lowest loss of a part so far, and the first epoch that had it."""
        return min(((row[part], int(row["epoch"])) for row in self.history), default=(math.inf, 0))

    def _keep(self) -> None:
        better = {part: self._best(part)[1] == self.epoch for part in ("group", "counts")}
        for name, tensor in self.averaged.state_dict().items():
            if better["counts" if name.startswith("counts.") else "group"]:
                self.kept[name] = tensor.detach().clone()

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
