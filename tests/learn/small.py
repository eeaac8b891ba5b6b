"""A small dataset: eight authored scenarios, hashed words."""

from __future__ import annotations

from pathlib import Path

from genc.learn.build import build_dataset
from genc.learn.dataset import Dataset, load_dataset
from genc.scenario.corpus import load_theme
from genc.scenario.scenario import Scenario
from genc.words.embed import Hashing


def scenarios() -> tuple[Scenario, ...]:
    return load_theme("museum")[:8]


def dataset(folder: Path) -> Dataset:
    build_dataset(scenarios(), Hashing(), folder)
    return load_dataset(folder)
