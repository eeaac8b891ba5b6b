"""`Lives`: what each agent of a corpus does in order, from scenarios, datasets or annotated video."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby
from pathlib import Path

import numpy as np

from genc.errors import BriefError, DatasetError
from genc.evaluate.annotations import read_annotations
from genc.evaluate.material import samples
from genc.evaluate.sequences import ActionSequence, action_sequences
from genc.graph.crowd_graph import Ints
from genc.learn.dataset import SPLITS, Sample, is_dataset, load_dataset
from genc.scenario.corpus import load_scripts, load_theme

FEWEST_LIVES = 10
"""Below that nothing can be said of how various they are."""


@dataclass(frozen=True, eq=False)
class Lives:
    """What each agent of a corpus does in order.

    Attributes:
        name: what the corpus is called.
        sequences: one for each agent; of annotated video one for each track.
        clusters: for each sequence its scenario or clip: those of one are no independent observations.
        annotated: whether an action goes on for as many steps as it has windows, so that nobody can tell two from one
            that lasts; in authored lives a repeated action is a step of its own.

    Raises:
        DatasetError: if there are too few.
    """

    name: str
    sequences: tuple[ActionSequence, ...]
    clusters: tuple[str, ...]
    annotated: bool = False

    def __post_init__(self) -> None:
        if (n := len(self.sequences)) < FEWEST_LIVES:
            raise DatasetError(f"{self.name}: action sequences of {n} agents; at least {FEWEST_LIVES} are needed")

    @cached_property
    def cluster(self) -> Ints:
        """For each sequence the number of its cluster, from 0."""
        return np.unique(self.clusters, return_inverse=True)[1]

    @property
    def n_clusters(self) -> int:
        """Scenarios or clips."""
        return len(set(self.clusters))

    @property
    def largest_share(self) -> float:
        """The share of the agents that are in the largest cluster."""
        return max(Counter(self.clusters).values()) / len(self.clusters)

    def merged(self) -> Lives:
        """The same with each repetition of an action made one with the first."""
        merged = (tuple(action for action, _ in groupby(sequence)) for sequence in self.sequences)
        return replace(self, sequences=tuple(merged))


def read_lives(place: Path | str, seed: int = 0) -> Lives:
    """The lives of a dataset folder (all its parts), of scripts (a file or a folder), of annotations (a `.csv` file),
    or of a shipped theme; what lies at `place` goes before a theme of that name.

    Args:
        place: where they are, or the name of the theme.
        seed: of the rehearsal of scenarios, which settles the order of what their authors left open.

    Raises:
        StudyError: with every problem of annotations.
        ScriptError: with every problem of scripts.
        DatasetError: if nothing is there, if it is damaged, or holds too few agents.
    """
    path = Path(place)
    if path.suffix.casefold() == ".csv":
        return _of_annotations(path)
    if is_dataset(path):
        dataset = load_dataset(path)
        return of_samples(str(place), [sample for part in SPLITS for sample in dataset.split(part)])
    if os.path.exists(path):
        return of_samples(str(place), samples(load_scripts(path), seed))
    try:
        scenarios = load_theme(str(place))
    except BriefError as error:
        raise DatasetError(f"{place}: no such file or folder, and {error}") from None
    return of_samples(scenarios[0].theme, samples(scenarios, seed))


def of_samples(name: str, some: Iterable[Sample]) -> Lives:
    """The lives of all agents of these groups."""
    told = [(life, f"{s.theme}/{s.scenario}") for s in some for life in action_sequences([s.graph])]
    return Lives(name, tuple(life for life, _ in told), tuple(scenario for _, scenario in told))


def _of_annotations(path: Path) -> Lives:
    tracks = read_annotations(path)
    return Lives(str(path), tuple(t.actions for t in tracks), tuple(t.clip for t in tracks), annotated=True)
