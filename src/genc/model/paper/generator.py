"""`PaperGenerator`: a trained `paper` model with its text encoder (Gen-C, Crowd Scenario Generation)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.graph.describe import nearest_counts
from genc.graph.repair import repair, threshold
from genc.graph.signed_graph import SignedGraph
from genc.model.condition import Conditions
from genc.model.paper.graphs import Structures
from genc.model.paper.vgae import PaperModel
from genc.model.source import Decoded
from genc.words.brief import Brief
from genc.words.embed import TextEncoder
from genc.words.vocabulary import MAX_NODES

CHUNK = 512
"""Graphs decoded together: their matrices take 20 MB."""


@dataclass(frozen=True, eq=False)
class PaperGenerator:
    """Answers briefs with groups; a `MatrixSource`.

    The network must be told every condition. What a brief leaves open is taken from a training group, by lot among
    those whose counts are nearest to the ones asked for.

    The paper does not say: when an entry of the matrix is an edge (here from 0.5 in size on), how a matrix becomes
    a crowd (here by `genc.graph.repair`), and how labels are chosen from their distributions. Its action figures
    suggest the likeliest label, which is the default.

    Attributes:
        model: in evaluation mode.
        encoder: the text encoder that it was trained with.
        hash: sixteen hex digits of its weights.
        drawn: labels are drawn from their distributions rather than the likeliest taken.
    """

    model: PaperModel
    encoder: TextEncoder
    hash: str
    drawn: bool = False

    @property
    def settings(self) -> dict[str, bool]:
        """What else its groups depend on, for the record."""
        return {"drawn": self.drawn}

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        """One group for each brief, in order; requested counts are met exactly."""
        return [answer.group for answer in self.decode(briefs, rng)]

    @torch.inference_mode()
    def decode(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[Decoded]:
        """The same, with the graphs before they were repaired; both get their labels from the same latents."""
        told = [self._completed(brief, rng) for brief in briefs]
        answers: list[Decoded] = []
        for start in range(0, len(told), CHUNK):
            answers += self._decode(told[start : start + CHUNK], rng)
        return answers

    def _decode(self, told: Sequence[Brief], rng: np.random.Generator) -> list[Decoded]:
        generator = torch.Generator().manual_seed(int(rng.integers(2**62)))
        z_structure, z_features, condition = self.model.draw_latents(Conditions.of(told, self.encoder), generator)
        matrices = self.model.structure(z_structure, condition).numpy()
        matrices = [matrix[: b.n_nodes, : b.n_nodes] for matrix, b in zip(matrices, told, strict=True)]
        signed = [threshold(matrix) for matrix in matrices]
        repaired = [repair(matrix, b.n_agents, b.n_events) for matrix, b in zip(matrices, told, strict=True)]
        labels = self._labels(z_features, condition, signed, rng)
        mended = self._labels(z_features, condition, [r.adjacency for r in repaired], rng)
        return [
            Decoded(SignedGraph(raw, *of_raw), CrowdGraph(r.agent, r.event, *of_group), r.change_rate)
            for raw, of_raw, r, of_group in zip(signed, labels, repaired, mended, strict=True)
        ]

    def _labels(
        self, z: Tensor, condition: Tensor, adjacencies: Sequence[NDArray[np.int8]], rng: np.random.Generator
    ) -> Iterator[tuple[Ints, Ints]]:
        """Action and category of the nodes of each graph."""
        structures = Structures.packed([Structures.of(adjacency) for adjacency in adjacencies])
        probabilities = self.model.label(z, condition, structures)
        chance = rng if self.drawn else None
        action, category = (choose(p.numpy(), chance)[structures.moment.numpy()] for p in probabilities)
        ends = np.cumsum(structures.n_nodes.numpy())[:-1]
        return zip(np.split(action, ends), np.split(category, ends), strict=True)

    def _completed(self, brief: Brief, rng: np.random.Generator) -> Brief:
        """The brief with every condition given."""
        pick = rng.choice(nearest_counts(np.log(self.model.known_counts.numpy().astype(np.float64)), brief))
        counts = completed_counts(brief, self.model.known_counts[pick].tolist())
        shares = brief.action_frequencies or tuple(self.model.known_frequencies[pick].tolist())
        return Brief(brief.text, *counts, shares)


def choose(probabilities: NDArray[np.float32], rng: np.random.Generator | None) -> Ints:
    """One label for each row `[P, K]`: drawn, or without an rng the likeliest."""
    if rng is None:
        return np.asarray(probabilities.argmax(1))
    below = probabilities.cumsum(1) < rng.random((len(probabilities), 1))
    return np.asarray(below.sum(1).clip(max=probabilities.shape[1] - 1))


def completed_counts(brief: Brief, like: Sequence[int]) -> tuple[int, int, int]:
    """Agents, events and nodes: those that are asked for, the others as near to `like` as can go with them."""
    n_agents, n_events = brief.n_agents or like[0], brief.n_events or like[1]
    if brief.n_nodes is None:
        n_nodes = min(max(like[2], n_agents + n_events - 1), MAX_NODES)
        if n_events == 1:
            n_nodes = n_agents * min(max(round(n_nodes / n_agents), 1), MAX_NODES // n_agents)
        return n_agents, n_events, n_nodes
    n_nodes = brief.n_nodes
    if brief.n_agents is None:
        n_agents = min(n_agents, n_nodes - (brief.n_events or 1) + 1)
        if brief.n_events == 1:
            n_agents = max(k for k in range(1, n_agents + 1) if n_nodes % k == 0)
    if brief.n_events is None:
        n_events = min(n_events, n_nodes - n_agents + 1)
        if n_events == 1 and n_nodes % n_agents:
            n_events = 2
    return n_agents, n_events, n_nodes
