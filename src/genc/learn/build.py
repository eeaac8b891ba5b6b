"""Scripts to a dataset folder; interrupted at any moment, the same call goes on where it was."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from safetensors.numpy import load_file, save
from tqdm import tqdm

from genc.errors import DatasetError
from genc.files import ensure_folder, write_text, written_beside
from genc.graph.codec import Tokens, encode
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.learn.dataset import (
    SCHEMA,
    SPLITS,
    Manifest,
    Story,
    groups_as_arrays,
    load_dataset,
    manifest_json,
    split_by_scenario,
)
from genc.scenario.corpus import corpus_hash
from genc.scenario.rehearse import rehearse
from genc.scenario.scenario import Scenario
from genc.words.embed import TextEncoder
from genc.words.vocabulary import vocabulary_hash

BLOCK = 512
"""Texts embedded between two savings."""


@dataclass(frozen=True, eq=False)
class _Draft:
    """Everything of a dataset but the embeddings."""

    texts: tuple[str, ...]
    stories: tuple[Story, ...]
    story: NDArray[np.int64]
    caption: NDArray[np.int64]
    tokens: tuple[Tokens, ...]


def build_dataset(scenarios: Sequence[Scenario], encoder: TextEncoder, folder: Path | str, seed: int = 0) -> Manifest:
    """Makes the dataset of these scenarios in `folder` and gives back its manifest.

    A folder that already holds this very dataset is left as it is. The manifest is written last: until it is there
    the folder counts as incomplete, and the same call goes on with what it finds.

    Raises:
        DatasetError: if the folder holds another dataset, or there are too few scenarios to split.
        OutputError: if it cannot be written.
    """
    if max(Counter(s.theme for s in scenarios).values(), default=0) < len(SPLITS):
        raise DatasetError(
            f"{len(scenarios)} scenarios cannot be split into {', '.join(SPLITS)}: at least 3 of one theme are needed"
        )
    draft = _draft(scenarios, seed)
    manifest = _manifest(scenarios, draft, encoder, seed)
    place = ensure_folder(folder)
    if (place / "manifest.json").exists():
        if load_dataset(place).manifest != manifest:
            raise DatasetError(f"{place}: holds another dataset: name another folder, or remove this one")
        _clear(place / "partial")
        return manifest
    embeddings = _embed(draft.texts, encoder, place / "partial")
    flat = {**groups_as_arrays(draft.tokens), "story": draft.story, "caption": draft.caption}
    with written_beside(place / "groups.safetensors") as beside:
        beside.write_bytes(save(flat))
    with written_beside(place / "texts.safetensors") as beside:
        beside.write_bytes(save({"embeddings": embeddings}))
    said = {"texts": draft.texts, "stories": [vars(story) for story in draft.stories]}
    write_text(place / "texts.json", json.dumps(said, ensure_ascii=False, indent=1) + "\n")
    write_text(place / "manifest.json", manifest_json(manifest))
    _clear(place / "partial")
    return manifest


def _draft(scenarios: Sequence[Scenario], seed: int) -> _Draft:
    number: dict[str, int] = {}

    def note(text: str) -> int:
        return number.setdefault(text, len(number))

    parts = split_by_scenario([s.theme for s in scenarios], seed)
    stories, story, caption, tokens = [], [], [], []
    for i, (scenario, part) in enumerate(zip(scenarios, parts, strict=True)):
        said = tuple(note(text) for text in (scenario.sentence, *scenario.paraphrases))
        stories.append(Story(scenario.slug, scenario.theme, part, said))
        for group, said_of_it in told_groups(scenario, np.random.default_rng([seed, i])):
            tokens.append(encode(group))
            story.append(i)
            caption.append(note(said_of_it))
    return _Draft(tuple(number), tuple(stories), np.array(story), np.array(caption), tuple(tokens))


def told_groups(scenario: Scenario, rng: np.random.Generator) -> list[tuple[CrowdGraph, str]]:
    """The groups of a scenario, rehearsed, each with its caption; in order of their first event."""
    rehearsal = rehearse(scenario, rng)
    graph = weave(rehearsal.records)
    _, first = np.unique(graph.part, return_index=True)
    captions = [rehearsal.captions[rehearsal.group_of[agent]] for agent in graph.agent[first].tolist()]
    return list(zip(graph.groups(), captions, strict=True))


def _manifest(scenarios: Sequence[Scenario], draft: _Draft, encoder: TextEncoder, seed: int) -> Manifest:
    part_of = [draft.stories[s].split for s in draft.story]
    return Manifest(
        schema=SCHEMA,
        corpus_hash=corpus_hash(scenarios),
        vocabulary_hash=vocabulary_hash(),
        encoder=encoder.id,
        dimension=encoder.dimension,
        seed=seed,
        themes=sorted({s.theme for s in scenarios}),
        n_scenarios=len(scenarios),
        n_groups=len(draft.tokens),
        split={name: part_of.count(name) for name in SPLITS},
    )


def _embed(texts: Sequence[str], encoder: TextEncoder, partial: Path) -> NDArray[np.float32]:
    """`[n, dimension]`, block by block; a block that an earlier call has saved is not embedded again."""
    key = hashlib.sha256("\0".join([encoder.id, *texts]).encode()).hexdigest()[:12]
    ensure_folder(partial)
    blocks = []
    for start in tqdm(range(0, len(texts), BLOCK), desc="embedding texts", unit="block", disable=None):
        saved = partial / f"{key}-{start:06d}.safetensors"
        if not saved.exists():
            content = save({"block": encoder.encode(texts[start : start + BLOCK])})
            with written_beside(saved) as beside:
                beside.write_bytes(content)
        blocks.append(load_file(saved)["block"])
    return np.concatenate(blocks)


def _clear(partial: Path) -> None:
    shutil.rmtree(partial, ignore_errors=True)
