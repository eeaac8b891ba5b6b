"""What a source is evaluated on: the groups to compare with, and those that training may have seen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from genc.errors import BriefError, DatasetError, ScriptError
from genc.graph.codec import canonical
from genc.graph.describe import full_brief
from genc.learn.build import told_groups
from genc.learn.dataset import SPLITS, Dataset, Sample, is_dataset, load_dataset
from genc.scenario.corpus import corpus_hash, folded_theme, load_corpus, load_scripts
from genc.scenario.scenario import Scenario
from genc.words.brief import Brief
from genc.words.embed import TextEncoder, Vectors, load_encoder

Facts = Mapping[str, str | int | float | None]

HELD_OUT = "held-out"
"""Validation and test together: all that training has not learned from."""
PARTS = ("test", "validation", HELD_OUT)
FEWEST_GROUPS = 10
"""To compare with: below that even the floor says nothing."""

ASKS: dict[str, Callable[[Sample], Brief]] = {
    "full": lambda sample: full_brief(sample.sentence, sample.graph),
    "sentence": lambda sample: Brief(sample.sentence),
    "caption": lambda sample: Brief(sample.caption),
}
"""Ways of asking for a group: by the paper's whole condition (sentence, counts, frequencies), or by a text alone."""


@dataclass(frozen=True, eq=False)
class Material:
    """Two sets of authored groups.

    Attributes:
        train: for floors and baselines.
        test: what generated groups are compared with.
        facts: where they come from, for the report.
        notes: what a reader of the report must know of them, one sentence each.
        encoder: loads a text encoder for sources that bring none.

    Raises:
        DatasetError: if there are too few groups to compare.
    """

    train: Sequence[Sample]
    test: Sequence[Sample]
    facts: Facts = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    encoder: Callable[[], TextEncoder] = lambda: load_encoder("minilm")

    def __post_init__(self) -> None:
        if len(self.test) < FEWEST_GROUPS:
            raise DatasetError(f"{len(self.test)} groups to compare with: at least {FEWEST_GROUPS} are needed")
        if len(self.train) < len(self.test):
            raise DatasetError(
                f"{len(self.train)} training groups for {len(self.test)} to compare with: the floor needs at least as "
                "many, so compare with fewer"
            )


class Remembered:
    """The `TextEncoder` of a dataset, which knows the vectors of its own texts already, and those only."""

    def __init__(self, dataset: Dataset) -> None:
        self.id, self.dimension = dataset.manifest.encoder, dataset.manifest.dimension
        self._vectors = dict(zip(dataset.texts, dataset.embeddings, strict=True))

    def encode(self, texts: Sequence[str]) -> Vectors:
        """`[n, dimension]` unit vectors."""
        return np.array([self._vectors[text] for text in texts])


def read_material(path: Path | str, theme: str | None = None, part: str | None = None, seed: int = 0) -> Material:
    """What `path` holds: a dataset folder, or scenario scripts (a file or a folder) that no training has seen.

    Of a dataset, a part of its split is compared with its training part. Scripts are all compared, rehearsed with
    `seed`, with the shipped corpus less what is in the scripts too. The training groups are those of the themes
    compared, if these are enough for a floor; else of all themes.

    Args:
        theme: compare groups of this theme only.
        part: one of `PARTS`, of a dataset's split; by default its test part.

    Raises:
        DatasetError: if nothing usable is there, or too little.
        ScriptError: with every problem of the scripts.
        BriefError: for a theme that is not there.
    """
    place = Path(path)
    if is_dataset(place):
        return _of_dataset(place, load_dataset(place), theme, part or PARTS[0])
    if part is not None:
        raise DatasetError(f"{place}: scripts have no {part} part: leave the split out, all of them are compared")
    return _of_scripts(place, _scripts(place), theme, seed)


def samples(scenarios: Sequence[Scenario], seed: int) -> list[Sample]:
    """The groups of these scenarios, rehearsed, with everything that is said of them."""
    return [
        Sample(canonical(graph), s.theme, s.slug, s.sentence, s.paraphrases, caption)
        for i, s in enumerate(scenarios)
        for graph, caption in told_groups(s, np.random.default_rng([seed, i]))
    ]


def _of_dataset(place: Path, dataset: Dataset, theme: str | None, part: str) -> Material:
    if part not in PARTS:
        raise DatasetError(f"{place}: the split has no part {part!r}; choose {', '.join(PARTS)}")
    splits = SPLITS[1:] if part == HELD_OUT else (part,)
    test = _of_theme([s for split in splits for s in dataset.split(split)], theme, str(place))
    train, notes = _akin(dataset.split(SPLITS[0]), test)
    facts = _facts(place, dataset.manifest.hash, part, test)
    return Material(train, test, facts, notes, partial(Remembered, dataset))


def _of_scripts(place: Path, scenarios: Sequence[Scenario], theme: str | None, seed: int) -> Material:
    test = _of_theme(samples(scenarios, seed), theme, str(place))
    told, played = {s.sentence for s in scenarios}, {s.groups for s in scenarios}
    shipped = load_corpus()
    unlike = [s for s in shipped if s.sentence not in told and s.groups not in played]
    train, notes = _akin(samples(unlike, seed), test)
    if known := len(shipped) - len(unlike):
        notes += (f"{known} of these scenarios come with genc: a shipped model may have learned from them.",)
    return Material(train, test, _facts(place, corpus_hash(scenarios), "scripts", test), notes)


def _scripts(place: Path) -> tuple[Scenario, ...]:
    try:
        return load_scripts(place)
    except ScriptError as error:
        if place.is_dir() and len(error.problems) == 1 and "no scripts in this folder" in error.problems[0]:
            raise DatasetError(
                f"{place}: neither a dataset (no manifest.json) nor scripts (no .txt or .json files): make a dataset "
                "with 'genc dataset build', or put scripts there"
            ) from None
        raise


def _of_theme(found: list[Sample], theme: str | None, source: str) -> list[Sample]:
    if theme is None:
        return found
    of_theme = [s for s in found if folded_theme(s.theme) == folded_theme(theme)]
    if not of_theme:
        known = ", ".join(sorted({s.theme for s in found}))
        raise BriefError(f"{source}: no groups of theme {theme!r}; there are groups of: {known}")
    return of_theme


def _akin(train: list[Sample], test: Sequence[Sample]) -> tuple[list[Sample], tuple[str, ...]]:
    """The training groups of the themes compared, if twice as many, to draw a floor from; else all, and a note."""
    themes = {sample.theme for sample in test}
    akin = [sample for sample in train if sample.theme in themes]
    if len(akin) >= 2 * len(test):
        return akin, ()
    return train, ("There are too few training groups of these themes: the floor is that of all themes.",)


def _facts(place: Path, digest: str, part: str, test: Sequence[Sample]) -> Facts:
    return {
        "dataset": str(place),
        "dataset_hash": digest,
        "part": part,
        "themes": ", ".join(sorted({s.theme for s in test})),
        "n_scenarios": len({s.scenario for s in test}),
    }
