"""A dataset folder: groups as tokens, their texts, the split by scenario, and the texts' embeddings.

    manifest.json       what it was made from and with; its presence says that the folder is complete
    texts.json          every text once, scenarios with their sentence and paraphrases, groups with their caption
    groups.safetensors  tokens of all groups (flat, with lengths), and for each its scenario
    texts.safetensors   one embedding for each text

The split is by scenario, never by group: groups of one scenario share their sentence, so a split by group would put
the texts of the test set into training. (The paper does not say which it used.)
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load_file

from genc.errors import DatasetError
from genc.graph.codec import Tokens, decode
from genc.graph.crowd_graph import CrowdGraph
from genc.words.vocabulary import vocabulary_hash

SCHEMA = 1
SPLITS = ("train", "validation", "test")
SHARES = (0.80, 0.15, 0.05)
"""Of the scenarios of each theme (Gen-C, Experiments)."""


@dataclass(frozen=True)
class Manifest:
    """What a dataset was made from and with."""

    schema: int
    corpus_hash: str
    vocabulary_hash: str
    encoder: str
    dimension: int
    seed: int
    themes: list[str]
    n_scenarios: int
    n_groups: int
    split: dict[str, int]
    """Groups in each part."""

    @property
    def hash(self) -> str:
        """Sixteen hex digits that differ for different datasets."""
        return hashlib.sha256(manifest_json(self).encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Story:
    """One scenario as the dataset keeps it: its texts (indices), theme and part of the split."""

    slug: str
    theme: str
    split: str
    texts: tuple[int, ...]
    """The sentence S_in first, then its paraphrases."""


@dataclass(frozen=True)
class Sample:
    """One group with everything that is said of it."""

    graph: CrowdGraph
    theme: str
    scenario: str
    sentence: str
    paraphrases: tuple[str, ...]
    caption: str


@dataclass(frozen=True, eq=False)
class Dataset:
    """A dataset in memory.

    Attributes:
        texts: every text; `embeddings[i]` is the vector of `texts[i]`.
        stories: the scenarios; `story[g]` is the scenario of group g and `caption[g]` the index of its caption.
        tokens: the groups.
        embeddings: float32 `[n_texts, dimension]`.
    """

    manifest: Manifest
    texts: tuple[str, ...]
    stories: tuple[Story, ...]
    story: NDArray[np.int64]
    caption: NDArray[np.int64]
    tokens: tuple[Tokens, ...]
    embeddings: NDArray[np.float32]

    def rows(self, split: str, theme: str | None = None) -> NDArray[np.int64]:
        """The groups of one part of the split, of all themes or of one."""
        inside = np.array([s.split == split and theme in (None, s.theme) for s in self.stories])
        return np.flatnonzero(inside[self.story])

    def split(self, name: str, theme: str | None = None) -> list[Sample]:
        """The samples of `train`, `validation` or `test`, of all themes or of one."""
        return [self._sample(int(g)) for g in self.rows(name, theme)]

    @cached_property
    def counts(self) -> NDArray[np.int64]:
        """Agents, events and nodes of every group `[n, 3]`."""
        return np.array([_counts(t) for t in self.tokens])

    def _sample(self, group: int) -> Sample:
        story = self.stories[self.story[group]]
        sentence, *paraphrases = (self.texts[i] for i in story.texts)
        caption = self.texts[self.caption[group]]
        graph = decode(self.tokens[group])
        return Sample(graph, story.theme, story.slug, sentence, tuple(paraphrases), caption)


def training_rows(dataset: Dataset, theme: str | None) -> NDArray[np.int64]:
    """The groups to train on.

    Raises:
        DatasetError: if there is none of that theme.
    """
    rows = dataset.rows("train", theme)
    if not len(rows):
        themes = ", ".join(dataset.manifest.themes)
        raise DatasetError(f"no groups of theme {theme!r} to train on; the dataset has: {themes}")
    return rows


def split_by_scenario(themes: Sequence[str], seed: int) -> list[str]:
    """The part of the split for each scenario, given each one's theme: 80/15/5 within every theme, at least one each
    where a theme has three or more."""
    rng = np.random.default_rng([seed, 80])
    parts = [""] * len(themes)
    for theme in sorted(set(themes)):
        members = rng.permutation([i for i, t in enumerate(themes) if t == theme])
        n_test = max(round(SHARES[2] * len(members)), int(len(members) >= 3))
        n_validation = max(round(SHARES[1] * len(members)), int(len(members) >= 3))
        for rank, i in enumerate(members):
            parts[i] = "test" if rank < n_test else "validation" if rank < n_test + n_validation else "train"
    return parts


def is_dataset(path: Path | str) -> bool:
    """Whether a folder holds a dataset, be it an incomplete one."""
    # os.path, for it takes a name that is too long for one that is not there
    return any(os.path.exists(Path(path) / name) for name in ("manifest.json", "groups.safetensors", "partial"))


def load_dataset(path: Path | str) -> Dataset:
    """The dataset in that folder.

    Raises:
        DatasetError: if it is missing, incomplete, damaged, or of another version or vocabulary.
    """
    folder = Path(path)
    if not os.path.isfile(folder / "manifest.json"):
        raise DatasetError(f"{folder}: no dataset here (no manifest.json): make one with 'genc dataset build'")
    try:
        manifest = Manifest(**_read_json(folder / "manifest.json"))
        if manifest.schema != SCHEMA:
            raise DatasetError(
                f"{folder}: dataset schema {manifest.schema}; this version reads {SCHEMA}: build it anew"
            )
        if manifest.vocabulary_hash != vocabulary_hash():
            raise DatasetError(f"{folder}: made with another vocabulary of actions and categories: build it anew")
        return _assemble(folder, manifest)
    except (OSError, ValueError, LookupError, TypeError, SafetensorError) as error:
        raise DatasetError(f"{folder}: the dataset is damaged ({error}): build it anew") from error


def _assemble(folder: Path, manifest: Manifest) -> Dataset:
    said = _read_json(folder / "texts.json")
    stories = tuple(Story(s["slug"], s["theme"], s["split"], tuple(s["texts"])) for s in said["stories"])
    flat = load_file(folder / "groups.safetensors")
    tokens = tuple(
        Tokens(s, a, c)
        for s, a, c in zip(
            np.split(flat["structure"].astype(np.int64), np.cumsum(flat["n_structure"])[:-1]),
            np.split(flat["action"].astype(np.int64), np.cumsum(flat["n_steps"])[:-1]),
            np.split(flat["category"].astype(np.int64), np.cumsum(flat["n_steps"])[:-1]),
            strict=True,
        )
    )
    embeddings = load_file(folder / "texts.safetensors")["embeddings"]
    if len(tokens) != manifest.n_groups or embeddings.shape != (len(said["texts"]), manifest.dimension):
        raise ValueError("its files do not match its manifest")
    dataset = Dataset(
        manifest, tuple(said["texts"]), stories, flat["story"], flat["caption"], tokens, embeddings.astype(np.float32)
    )
    if len(dataset.counts) != len(dataset.story) or _outside(dataset):  # counting decodes, and so checks, every group
        raise ValueError("its groups, scenarios and texts do not match")
    return dataset


def _outside(dataset: Dataset) -> bool:
    """Whether something refers to a scenario or a text that is not there."""
    used = [*dataset.caption.tolist(), *(i for story in dataset.stories for i in story.texts)]
    return not (
        set(dataset.story.tolist()) <= set(range(len(dataset.stories))) and set(used) <= set(range(len(dataset.texts)))
    )


def groups_as_arrays(tokens: Sequence[Tokens]) -> dict[str, NDArray[Any]]:
    """The tokens of all groups as flat arrays with lengths: what `groups.safetensors` holds."""
    return {
        "structure": np.concatenate([t.structure for t in tokens]).astype(np.int16),
        "action": np.concatenate([t.action for t in tokens]).astype(np.int8),
        "category": np.concatenate([t.category for t in tokens]).astype(np.int8),
        "n_structure": np.array([len(t.structure) for t in tokens]),
        "n_steps": np.array([len(t.action) for t in tokens]),
    }


def manifest_json(manifest: Manifest) -> str:
    """The manifest as it stands in the folder."""
    return json.dumps(asdict(manifest), indent=1) + "\n"


def _counts(tokens: Tokens) -> tuple[int, int, int]:
    graph = decode(tokens)
    return graph.n_agents, graph.n_events, graph.n_nodes


def _read_json(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))
