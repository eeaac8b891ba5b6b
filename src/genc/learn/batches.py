"""Batches for training: groups of like length together, each with one way of being asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from genc.graph.codec import decode
from genc.graph.describe import action_frequencies
from genc.learn.dataset import Dataset
from genc.model.condition import N_ACTIONS, Conditions
from genc.model.structure_decoder import Trace
from genc.model.tensors import GroupBatch


@dataclass(frozen=True)
class Asking:
    """How groups are asked for in training: the chances of each condition.

    A text is the group's caption, the scenario's sentence or one of its paraphrases (a random blend of two of them),
    or missing. Texts are few and a network learns them by heart within a few epochs, so an embedding also gets noise.
    """

    caption: float = 0.5
    sentence: float = 0.4
    frequencies: float = 0.5
    noise: float = 0.03
    """Standard deviation in each dimension of a unit vector."""


@dataclass(frozen=True, eq=False)
class Batch:
    """Groups, what the rules say along them, and how they were asked for."""

    groups: GroupBatch
    trace: Trace
    given: Conditions


class Batches:
    """All groups of a dataset as tensors in memory, cut into batches anew in every epoch."""

    def __init__(self, dataset: Dataset, rows: NDArray[np.int64], device: torch.device) -> None:
        tokens = [dataset.tokens[g] for g in rows]
        self.groups = GroupBatch.of(tokens)
        self.counts = torch.from_numpy(dataset.counts[rows])
        self.trace = Trace.of(self.groups.structure, self.counts)
        self.n_structure = (self.groups.structure >= 0).sum(1)
        self.n_steps = (self.groups.action >= 0).sum(1)
        self.embeddings = torch.from_numpy(dataset.embeddings)
        self.caption = torch.from_numpy(dataset.caption[rows])
        self.texts = _ragged([dataset.stories[s].texts for s in dataset.story[rows]])
        self.frequencies = _frequencies(dataset, rows)
        self.device = device

    def __len__(self) -> int:
        return len(self.counts)

    def epoch(self, size: int, asking: Asking, generator: torch.Generator) -> Iterator[Batch]:
        """Every group once, shuffled, in batches of like length."""
        order = torch.randperm(len(self), generator=generator)
        pools = torch.split(order, 8 * size)
        batches = [b for pool in pools for b in torch.split(pool[torch.argsort(self._length(pool), stable=True)], size)]
        for i in torch.randperm(len(batches), generator=generator).tolist():
            yield self._batch(batches[i], self._ask(batches[i], asking, generator))

    def fixed(self, size: int, text: str, *, frequencies: bool) -> Iterator[Batch]:
        """Every group once, in order of length, asked for by its `sentence` or its `caption`."""
        for rows in torch.split(torch.argsort(self._length(torch.arange(len(self))), stable=True), size):
            vectors = self.embeddings[self.caption[rows] if text == "caption" else self.texts[rows, 0]]
            shares = self.frequencies[rows] * float(frequencies)
            yield self._batch(rows, Conditions(vectors, self.counts[rows], shares))

    def _length(self, rows: Tensor) -> Tensor:
        return self.n_structure[rows] + 2 * self.n_steps[rows]

    def _batch(self, rows: Tensor, given: Conditions) -> Batch:
        longest, n_steps = slice(int(self.n_structure[rows].max())), slice(int(self.n_steps[rows].max()))
        g = self.groups
        groups = GroupBatch(g.structure[rows, longest], g.action[rows, n_steps], g.category[rows, n_steps])
        return Batch(groups.to(self.device), self.trace[rows, longest].to(self.device), given.to(self.device))

    def _ask(self, rows: Tensor, asking: Asking, generator: torch.Generator) -> Conditions:
        n = len(rows)
        chance = torch.rand(n, 1, generator=generator)
        text = torch.where(chance < asking.caption, self.embeddings[self.caption[rows]], self._blend(rows, generator))
        text = text + asking.noise * torch.randn(text.shape, generator=generator)
        text = torch.where(chance < asking.caption + asking.sentence, text, 0.0)
        shown = torch.rand(n, 1, generator=generator) < asking.frequencies
        return Conditions(text, self.counts[rows], torch.where(shown, self.frequencies[rows], 0.0))

    def _blend(self, rows: Tensor, generator: torch.Generator) -> Tensor:
        """A random point between two texts of each group's scenario."""
        texts = self.texts[rows]
        n_texts = (texts >= 0).sum(1, keepdim=True)
        pick = (torch.rand(len(rows), 2, generator=generator) * n_texts).long()
        first, second = self.embeddings[texts.gather(1, pick)].unbind(1)
        share = torch.rand(len(rows), 1, generator=generator)
        return torch.nn.functional.normalize(share * first + (1 - share) * second, dim=1)


def _ragged(rows: Sequence[tuple[int, ...]]) -> Tensor:
    out = torch.full((len(rows), max(len(r) for r in rows)), -1)
    for i, row in enumerate(rows):
        out[i, : len(row)] = torch.tensor(row)
    return out


def _frequencies(dataset: Dataset, rows: NDArray[np.int64]) -> Tensor:
    """`[n, 13]` the share of each action among the nodes of each group."""
    out = torch.zeros(len(rows), N_ACTIONS)
    for i, g in enumerate(rows):
        out[i] = torch.tensor(action_frequencies(decode(dataset.tokens[g])))
    return out
