"""The quality benchmark on a source that is known: training groups by lot."""

from __future__ import annotations

import importlib
import json
import math
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from genc.evaluate.baselines import Shuffle
from genc.evaluate.comparison import floor
from genc.evaluate.measures import profile
from genc.graph.weave import weave
from genc.learn.dataset import Sample
from genc.scenario.corpus import load_theme, themes
from genc.scenario.rehearse import rehearse
from genc.words.embed import Hashing


@pytest.fixture(scope="module")
def quality() -> ModuleType:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(Path(__file__).parents[2] / "benchmarks")
        return importlib.import_module("quality")


@pytest.fixture(scope="module")
def samples() -> list[Sample]:
    found = []
    for scenario in load_theme(themes()[0]):
        for i, graph in enumerate(weave(rehearse(scenario, np.random.default_rng(0)).records).groups()):
            caption = f"group {i} of {scenario.slug}"
            found.append(Sample(graph, scenario.theme, scenario.slug, scenario.sentence, (), caption))
    return found


def test_every_column_is_measured_and_written(quality: ModuleType, samples: list[Sample]) -> None:
    train, test = samples[40:], samples[:40]
    tested = profile([s.graph for s in test])
    ground = floor(profile([s.graph for s in train]), tested, 20, np.random.default_rng(0))
    columns = quality.columns(Shuffle([s.graph for s in train]), Hashing(), train, test)
    outcomes = [quality.outcome(c, tested, 2, np.random.default_rng(0)) for c in columns]

    lines = list(quality.table(ground, outcomes))
    assert {line.count("|") for line in lines} == {len(columns) + 3}
    figures = json.loads(json.dumps(quality.as_json(ground, outcomes), allow_nan=False))
    assert set(figures["columns"]) == {c.title for c in columns}
    full = figures["columns"]["full condition"]
    assert full["total_ratio"] == pytest.approx(sum(full["means"].values()) / ground.total)
    assert full["adherence"]["agents"] is not None
    assert figures["columns"]["sentence alone"]["adherence"]["agents"] is None
    assert not any(math.isnan(ratio) for c in figures["columns"].values() for ratio in c["ratios"].values())
