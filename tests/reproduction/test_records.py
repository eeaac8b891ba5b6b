"""The records of the paper's experiments: complete, and readable beside their tables."""

from __future__ import annotations

import importlib
import json
import math
import re
from pathlib import Path

import pytest

REPRODUCTION = Path(__file__).parents[2] / "reproduction"
NAMES = sorted(path.parent.name for path in REPRODUCTION.glob("[0-9]*/run.py"))


@pytest.fixture(autouse=True)
def importable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(REPRODUCTION.parent)


def test_every_experiment_is_there_and_on_record() -> None:
    assert [name[:2] for name in NAMES] == [f"{i:02}" for i in range(1, 9)]
    for name in NAMES:
        assert {"config.json", "result.json", "table.md"} <= {path.name for path in (REPRODUCTION / name).iterdir()}


@pytest.mark.parametrize("name", NAMES)
def test_a_record_was_made_with_the_config_that_stands_beside_it(name: str) -> None:
    record = json.loads((REPRODUCTION / name / "result.json").read_text(encoding="utf-8"))
    assert record["config"] == json.loads((REPRODUCTION / name / "config.json").read_text(encoding="utf-8"))
    assert callable(importlib.import_module(f"reproduction.{name}.run").run)


@pytest.mark.parametrize("name", ["02_ablation", "03_perturbation", "07_latent_space"])
def test_the_figures_of_the_paper_and_of_the_record_stand_in_the_table(name: str) -> None:
    folder = REPRODUCTION / name
    shown = {float(cell) for cell in re.findall(r"-?\d+\.\d+", (folder / "table.md").read_text(encoding="utf-8"))}
    for value in _numbers(json.loads((folder / "paper.json").read_text(encoding="utf-8"))):
        assert any(math.isclose(value, cell, abs_tol=1e-9) for cell in shown), value
    found = list(_numbers(json.loads((folder / "result.json").read_text(encoding="utf-8"))["figures"]))
    told = sum(any(math.isclose(value, cell, abs_tol=6e-4) for cell in shown) for value in found)
    assert told > 0.6 * len(found)


def test_differences_are_relative_and_miss_nothing() -> None:
    from reproduction.study import differences

    recorded = {"a": [1.0, 2.0], "b": {"c": "x"}, "d": 4}
    assert list(differences(recorded, recorded)) == []
    assert list(differences(recorded, {**recorded, "a": [1.0, 2.1]})) == [(pytest.approx(0.05), "/a/1")]
    for other in ({**recorded, "b": {"c": "y"}}, {**recorded, "a": [1.0]}, {"a": [1.0, 2.0]}, {**recorded, "e": 1}):
        assert max(differences(recorded, other))[0] == math.inf


def _numbers(value: object) -> list[float]:
    if isinstance(value, dict):
        return [number for item in value.values() for number in _numbers(item)]
    return [float(value)] if isinstance(value, int | float) else []
