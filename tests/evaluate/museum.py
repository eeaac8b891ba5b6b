"""A small material: four authored scenarios to compare with, twelve to train on."""

from __future__ import annotations

from genc.evaluate.material import Material, samples
from genc.scenario.corpus import load_theme
from genc.words.embed import Hashing


def material(note: str = "") -> Material:
    scenarios = load_theme("museum")
    facts = {"dataset": "museum", "dataset_hash": "0" * 16}
    return Material(samples(scenarios[4:], 0), samples(scenarios[:4], 0), facts, (note,) if note else (), Hashing)
