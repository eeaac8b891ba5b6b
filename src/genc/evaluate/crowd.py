"""Crowds of groups as the measures see them, and a gauge that says how far one is from the test set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.interaction import participation_rate
from genc.evaluate.latent import bandwidth, frechet_distance, mmd_squared
from genc.evaluate.measures import Profile, profile
from genc.evaluate.random_gin import RandomGin, standardise
from genc.evaluate.sequences import ActionSequence, action_sequences
from genc.graph.crowd_graph import Ints
from genc.graph.signed_graph import Labelled

Floats = NDArray[np.float64]

PARTICIPATION, FRECHET, MMD = "interaction participation", "FID, random GIN", "MMD², random GIN"


@dataclass(frozen=True, eq=False)
class Crowd:
    """Groups with what is counted in each, so that many draws of them are measured at the cost of one.

    Attributes:
        groups: of any kind that can be measured.
        cluster: for each the number of the scenario that it is of, or was asked to be of.
        profile: `[n, N_BINS]`, see `measures`.
        features: `[n, 105]`, see `random_gin`; not standardised.
        sequences: what each agent of each group does.
        participation: the share of each group's agents who ever do something together.
    """

    groups: Sequence[Labelled]
    cluster: Ints
    profile: Profile
    features: Floats
    sequences: Sequence[Sequence[ActionSequence]]
    participation: Floats

    @staticmethod
    def of(groups: Sequence[Labelled], cluster: Ints, evaluator: RandomGin) -> Crowd:
        """The crowd of these groups."""
        return Crowd(
            groups,
            cluster,
            profile(groups),
            evaluator.features(groups),
            [action_sequences([group]) for group in groups],
            np.array([participation_rate([group]) for group in groups]),
        )

    def __len__(self) -> int:
        return len(self.groups)

    def __getitem__(self, rows: NDArray[np.integer]) -> Crowd:
        return Crowd(
            [self.groups[i] for i in rows],
            self.cluster[rows],
            self.profile[rows],
            self.features[rows],
            [self.sequences[i] for i in rows],
            self.participation[rows],
        )

    def draws(self, size: int) -> list[Crowd]:
        """The crowd cut into draws of that many groups each, which its length is a multiple of."""
        return [self[rows] for rows in np.arange(len(self)).reshape(-1, size)]

    @property
    def n_agents(self) -> list[int]:
        """Agents of each group."""
        return [len(sequences) for sequences in self.sequences]

    @property
    def descriptors(self) -> Floats:
        """`[n, d]` all that a classifier sees, as `two_sample.descriptors`."""
        return np.hstack([self.features, self.profile])


@dataclass(frozen=True, eq=False)
class Lineup:
    """The crowds that are measured side by side.

    Attributes:
        train, test: authored.
        made: "generated" and, of a `MatrixSource`, "decoded": as many draws, each as large as the test set.
    """

    train: Crowd
    test: Crowd
    made: Mapping[str, Crowd]

    @property
    def all(self) -> dict[str, Crowd]:
        """Every crowd by name."""
        return {"authored": self.test, "training": self.train, **self.made}

    @cached_property
    def draws(self) -> dict[str, list[Crowd]]:
        """What was made, draw by draw."""
        return {of: crowd.draws(len(self.test)) for of, crowd in self.made.items()}

    def of_training(self, n_draws: int, rng: np.random.Generator) -> list[Crowd]:
        """Draws of training groups, each as large as the test set."""
        size = len(self.test)
        return [self.train[rng.choice(len(self.train), size, replace=False)] for _ in range(n_draws)]


class Gauge:
    """Measures crowds against a test set, on the scale of a training set."""

    def __init__(self, train: Crowd, test: Crowd) -> None:
        self._train = train.features
        self._test = standardise(test.features, train.features)
        self._gamma = bandwidth(self._test)

    def readings(self, crowd: Crowd) -> dict[str, float]:
        """What is measured, beside the divergences, of a crowd as large as the test set."""
        features = standardise(crowd.features, self._train)
        return {
            PARTICIPATION: float(np.average(crowd.participation, weights=crowd.n_agents)),
            FRECHET: frechet_distance(self._test, features),
            MMD: mmd_squared(self._test, features, self._gamma),
        }
