"""Training of the `paper` generator, by the schedule of the paper (Gen-C, Training Objective and Experiments)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import torch
from torch import Tensor

from genc.errors import BriefError
from genc.graph.codec import decode
from genc.graph.describe import action_frequencies
from genc.learn.dataset import Dataset, training_rows
from genc.learn.state import named_state, restore_state, under
from genc.model.condition import Conditions
from genc.model.paper.graphs import Batch
from genc.model.paper.vgae import Losses, PaperConfig, PaperModel


@dataclass(frozen=True)
class PaperTraining:
    """The schedule.

    The paper does not say: how beta climbs within a cycle (here linearly through its first half, then it stays: Fu et
    al. 2019), whether sums over nodes and entries become means over graphs of a batch (here they do), which epoch's
    weights are kept (here the last: those of the lowest held-out loss, which a run remembers too, decode to means of
    many graphs), and which beta a single VGAE has (here that of the features, at whose top the objective is the ELBO).
    Departs from the paper: a scenario has paraphrases besides its sentence; in each epoch one of its texts is drawn.

    Attributes:
        theme: only scenarios of this theme, None for all.
        learning_rates: from the first epoch to the last, linearly.
        cycle: epochs after which beta begins anew.
        beta_structure, beta_features: its range in each cycle.
        kl_per_dimension: the KL terms are means over the dimensions of a latent, as some code has them; the paper's
            formula says sums.
        save_every: epochs between two savings of the run.
    """

    theme: str | None = None
    epochs: int = 500
    batch_size: int = 128
    learning_rates: tuple[float, float] = (5e-4, 1.25e-4)
    weight_decay: float = 3e-4
    cycle: int = 100
    beta_structure: tuple[float, float] = (0.001, 3.0)
    beta_features: tuple[float, float] = (0.001, 1.0)
    kl_per_dimension: bool = False
    save_every: int = 10
    seed: int = 0


VARIANTS: dict[str, dict[str, bool]] = {"full": {}, "unordered": {"canonical": False}, "single": {"single": True}}
"""The paper's model, and its two ablations (Gen-C, Ablation Study)."""


def paper_shape(dataset: Dataset, theme: str | None, variant: str = "full") -> PaperConfig:
    """The network for training on this dataset, or on one theme of it.

    Raises:
        BriefError: if there is no such variant.
        DatasetError: if there is nothing of that theme to train on.
    """
    if variant not in VARIANTS:
        raise BriefError(f"the paper's model has no variant {variant!r}: choose one of {', '.join(VARIANTS)}")
    n_known = len(training_rows(dataset, theme))
    return replace(PaperConfig(dataset.manifest.dimension, n_known), **VARIANTS[variant])


class PaperBatches:
    """Groups of one part of the split in memory, with everything that is computed but once."""

    def __init__(self, dataset: Dataset, split: str, training: PaperTraining, *, canonical: bool) -> None:
        rows = dataset.rows(split, training.theme)
        rng = np.random.default_rng([training.seed, len(rows)])
        graphs = [decode(dataset.tokens[g]) for g in rows]
        self.graphs = [Batch.of(g, np.arange(g.n_nodes) if canonical else rng.permutation(g.n_nodes)) for g in graphs]
        self.counts = torch.from_numpy(dataset.counts[rows])
        self.frequencies = torch.tensor([action_frequencies(g) for g in graphs])
        self.texts = [dataset.stories[s].texts for s in dataset.story[rows]]
        self.embeddings = torch.from_numpy(dataset.embeddings)

    def __len__(self) -> int:
        return len(self.graphs)

    def epoch(self, size: int, rng: np.random.Generator) -> Iterator[tuple[Batch, Conditions]]:
        """Every group once, shuffled, each asked for by one text of its scenario."""
        order = rng.permutation(len(self))
        for start in range(0, len(order), size):
            rows = order[start : start + size]
            yield self.batch(rows.tolist(), [int(rng.choice(self.texts[g])) for g in rows])

    def fixed(self, size: int) -> Iterator[tuple[Batch, Conditions]]:
        """Every group once, in order, asked for by its scenario's sentence."""
        for start in range(0, len(self), size):
            rows = list(range(start, min(start + size, len(self))))
            yield self.batch(rows, [self.texts[g][0] for g in rows])

    def batch(self, rows: list[int], texts: list[int]) -> tuple[Batch, Conditions]:
        """These groups, asked for by these texts."""
        given = Conditions(self.embeddings[texts], self.counts[rows], self.frequencies[rows])
        return Batch.packed([self.graphs[g] for g in rows]), given


class PaperTrainer:
    """A `Trainee`; what it gives are the weights of the last epoch, and its state holds the best on held-out groups."""

    def __init__(self, dataset: Dataset, model: PaperConfig, training: PaperTraining, device: torch.device) -> None:
        self.training, self.device = training, device
        torch.manual_seed(training.seed)
        self.batches = PaperBatches(dataset, "train", training, canonical=model.canonical)
        self.held_out = PaperBatches(dataset, "validation", training, canonical=model.canonical)
        self.model = PaperModel(model).to(device)
        self.model.known_counts.copy_(self.batches.counts)
        self.model.known_frequencies.copy_(self.batches.frequencies)
        self.optimizer = torch.optim.Adam(
            self.model.parameters(), lr=training.learning_rates[0], weight_decay=training.weight_decay
        )
        self.epoch = 0
        self.history: list[dict[str, float]] = []
        self.kept: dict[str, Tensor] = {}

    @property
    def finished(self) -> bool:
        """Whether the schedule has come to its end."""
        return self.epoch >= self.training.epochs

    def run_epoch(self) -> str:
        """Trains for one epoch and says how it went."""
        # all chance of an epoch follows from (seed, epoch): a resumed run needs no generator state
        torch.manual_seed(self.training.seed * 100_003 + self.epoch)
        rng = np.random.default_rng([self.training.seed, self.epoch])
        for group in self.optimizer.param_groups:
            group["lr"] = learning_rate(self.training, self.epoch)
        self.model.train()
        for batch, given in self.batches.epoch(self.training.batch_size, rng):
            self.optimizer.zero_grad(set_to_none=True)
            torch.autograd.backward(self._objective(self.model(batch.to(self.device), given.to(self.device))))
            self.optimizer.step()
        self.epoch += 1
        losses = self.validate()
        self.history.append({"epoch": self.epoch, **losses, "total": self._total(losses)})
        if self._best()["epoch"] == self.epoch:
            self.kept = {name: tensor.detach().clone() for name, tensor in self.model.state_dict().items()}
        return ", ".join(f"{name} {value:.2f}" for name, value in losses.items())

    @torch.inference_mode()
    def validate(self) -> dict[str, float]:
        """The mean loss terms of held-out groups."""
        self.model.eval()
        torch.manual_seed(0)
        totals = torch.zeros(4)
        for batch, given in self.held_out.fixed(512):
            terms = self.model(batch.to(self.device), given.to(self.device))
            totals += torch.stack([t.sum().cpu() for t in vars(terms).values()])
        return dict(zip(Losses.__dataclass_fields__, (totals / max(len(self.held_out), 1)).tolist(), strict=True))

    def state(self) -> dict[str, Tensor]:
        """Everything but `epoch` and `history` that a later run needs, as named tensors."""
        kept = {f"best.{name}": tensor for name, tensor in self.kept.items()}
        return named_state({"model": self.model}, self.optimizer) | kept

    def restore(self, state: dict[str, Tensor], epoch: int, history: list[dict[str, float]]) -> None:
        """Goes back to what `state` gave after that epoch."""
        restore_state(state, {"model": self.model}, self.optimizer)
        self.kept = under("best.", state)
        self.epoch, self.history = epoch, history

    def result(self) -> tuple[PaperModel, dict[str, object]]:
        """The weights of the last epoch, with the held-out losses of that epoch and of the best."""
        return self.model.cpu(), {"best": self._best(), "last": self.history[-1]}

    def _best(self) -> dict[str, float]:
        return min(self.history, key=lambda row: row["total"])

    def _total(self, losses: dict[str, float]) -> float:
        """The objective at beta = 1, whatever beta is in that epoch."""
        return sum(losses.values()) - self.model.config.single * losses["kl_features"]

    def _objective(self, terms: Losses) -> Tensor:
        """L_VGAE-S + L_VGAE-F (Gen-C, Training Objective); they share the condition network alone."""
        t, shape = self.training, self.model.config
        divergence = annealed(t.beta_features, self.epoch, t.cycle) * terms.kl_features
        if not shape.single:
            divergence = divergence + annealed(t.beta_structure, self.epoch, t.cycle) * terms.kl_structure
        if t.kl_per_dimension:
            divergence = divergence / shape.latent
        return (terms.structure + terms.features + divergence).mean()


def annealed(bounds: tuple[float, float], epoch: int, cycle: int) -> float:
    """Beta in that epoch: from the lower bound to the upper through the first half of each cycle."""
    low, high = bounds
    return low + (high - low) * min(2 * (epoch % cycle) / cycle, 1.0)


def learning_rate(training: PaperTraining, epoch: int) -> float:
    """The learning rate in that epoch."""
    first, last = training.learning_rates
    return first + (last - first) * epoch / max(training.epochs - 1, 1)
