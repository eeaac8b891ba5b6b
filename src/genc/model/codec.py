"""The `codec` generator: the paper's two conditional latents, decoded as a scenario rather than as a matrix."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional as F

from genc.model.condition import ConditionNet, Conditions
from genc.model.counts import CountPrior
from genc.model.encoder import Encoder
from genc.model.feature_decoder import FeatureDecoder
from genc.model.prior import Prior
from genc.model.rules import StructureRules
from genc.model.sampling import Sampling
from genc.model.structure_decoder import StructureDecoder, Trace
from genc.model.tensors import PAD, GroupBatch, Steps

CHUNK = 256
"""Groups sampled together: large enough to be efficient, small enough to stay in the cache."""


@dataclass(frozen=True)
class CodecConfig:
    """The shape of the network; `text_dim` is the dimension of the text encoder."""

    text_dim: int
    width: int = 96
    heads: int = 4
    latent: int = 32
    condition: int = 64
    encoder_depth: int = 2
    structure_depth: int = 2
    feature_depth: int = 2
    dropout: float = 0.3
    text_dropout: float = 0.3


@dataclass(frozen=True, eq=False)
class Terms:
    """The terms of the objective, each `[B]`, in nats.

    Attributes:
        structure, features: -log p of the tokens.
        kl: log q(Z | X, C) - log p(Z | C) at one draw.
        prior_fit: -log p(Z | C) with Z held fixed: fits the prior to the posterior wherever the KL term is floored.
        counts: -log p(counts | text, frequencies).
    """

    structure: Tensor
    features: Tensor
    kl: Tensor
    prior_fit: Tensor
    counts: Tensor


class CodecModel(nn.Module):
    """Encoder, prior, counts, and the two autoregressive decoders."""

    def __init__(self, config: CodecConfig) -> None:
        super().__init__()
        self.config = c = config
        context = c.latent + c.condition
        self.counts = CountPrior(c.text_dim, c.condition, c.text_dropout)
        self.condition = ConditionNet(c.text_dim, c.condition, c.text_dropout)
        self.encoder = Encoder(c.width, c.heads, c.encoder_depth, c.latent, c.dropout)
        self.encoder_condition = nn.Linear(c.condition, c.width)
        self.prior = Prior(c.latent, c.condition)
        self.structure = StructureDecoder(c.width, c.heads, c.structure_depth, context, c.dropout)
        self.features = FeatureDecoder(c.width, c.heads, c.feature_depth, context, c.dropout)

    def forward(self, groups: GroupBatch, trace: Trace, given: Conditions) -> Terms:
        """The terms of the objective (Gen-C, Training Objective); `given.counts` must be known."""
        steps = Steps.of(groups.structure)
        condition = self.condition(given)
        posterior = self.encoder(groups, steps, self.encoder_condition(condition))
        z = posterior.rsample()
        z_structure, z_features = z.chunk(2, dim=1)
        return Terms(
            -self.structure.log_prob(groups.structure, trace, torch.cat([z_structure, condition], 1)),
            -self.features.log_prob(groups, steps, torch.cat([z_features, condition], 1), wanted(given)),
            posterior.log_prob(z) - self.prior.log_prob(z, condition),
            -self.prior.log_prob(z.detach(), condition.detach()),
            -self.counts.log_prob(given, given.counts),
        )

    @torch.inference_mode()
    def sample(self, given: Conditions, sampling: Sampling) -> GroupBatch:
        """One group for each condition, in order; requested counts are met exactly."""
        given = given.with_counts(self.counts.sample(given, sampling))
        order = torch.argsort(given.counts[:, 2], descending=True, stable=True)
        parts = torch.split(order, CHUNK)
        # each chunk has its own chance, so that the result does not depend on how many run side by side
        seeds = torch.randint(2**62, (len(parts),), generator=sampling.generator).tolist()
        with ThreadPoolExecutor(torch.get_num_threads(), initializer=torch.set_num_threads, initargs=(1,)) as pool:
            chunks = list(
                pool.map(lambda rows, seed: self._sample_chunk(given[rows], sampling.seeded(seed)), parts, seeds)
            )
        back = torch.argsort(order)
        columns = zip(*((c.structure, c.action, c.category) for c in chunks), strict=True)
        return GroupBatch(*(_stacked(column)[back] for column in columns))

    @torch.inference_mode()
    def _sample_chunk(self, given: Conditions, sampling: Sampling) -> GroupBatch:
        conditions = [self.condition(given)]
        z_structure, z_features = self.prior.sample(conditions[0], sampling.generator).chunk(2, dim=1)
        if sampling.guidance != 1:
            conditions.append(self.condition(given.without_text()))
        rules = StructureRules(*given.counts.unbind(1))
        structure = self.structure.sample(rules, [torch.cat([z_structure, c], 1) for c in conditions], sampling)
        order = torch.argsort(Steps.of(structure).valid.sum(1), descending=True, stable=True)
        contexts = [torch.cat([z_features, c], 1)[order] for c in conditions]
        steps = Steps.of(structure[order])
        action, category = self.features.sample(steps, contexts, wanted(given)[order], sampling)
        back = torch.argsort(order)
        return GroupBatch(structure, action[back], category[back])


def wanted(given: Conditions) -> Tensor:
    """`[B, 13]` nodes of each action that are asked for; all zero where frequencies are not given."""
    return (given.frequencies * given.counts[:, 2:]).round()


def _stacked(parts: Sequence[Tensor]) -> Tensor:
    longest = max(p.shape[1] for p in parts)
    return torch.cat([F.pad(p, (0, longest - p.shape[1]), value=PAD) for p in parts])
