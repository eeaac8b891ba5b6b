"""What the experiments share: the two themes, their models, their held-out groups, and how results are written."""

from __future__ import annotations

import argparse
import importlib
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from genc.evaluate.evaluation import Evaluation, Trial
from genc.evaluate.examine import examine
from genc.evaluate.material import HELD_OUT, Material, Remembered, read_material
from genc.evaluate.sources import BASELINES
from genc.learn.build import build_dataset
from genc.learn.dataset import Dataset, load_dataset
from genc.model.checkpoint import load_generator
from genc.model.paper.generator import PaperGenerator
from genc.model.source import GraphSource
from genc.scenario.corpus import load_corpus
from genc.words.embed import load_encoder

HERE = Path(__file__).parent
THEMES = ("university campus", "train station")
"""Of the paper's tables."""
TOLERANCE = 0.01
"""Of a repeated figure; equal versions on equal processors give equal figures."""


@dataclass(frozen=True)
class Result:
    """What came of an experiment.

    Attributes:
        figures: JSON values; the same in every run.
        table: Markdown, in the paper's layout, the paper's own figures beside ours.
        pictures: by file name, matplotlib figures.
        measured_here: JSON values that differ from run to run, such as times.
    """

    figures: Mapping[str, Any]
    table: str
    pictures: Mapping[str, Any] = field(default_factory=dict)
    measured_here: Mapping[str, Any] = field(default_factory=dict)


class Study:
    """Material and models, loaded when they are first asked for; evaluations are shared between experiments."""

    def __init__(self, dataset: Path, seed: int = 0) -> None:
        self.folder, self.seed = dataset, seed
        self.evaluation = cache(self._evaluation)
        self.material = cache(self._material)
        self.seen = cache(self._seen)
        self.dataset = cache(self._dataset)
        self.paper = cache(self._paper)
        self.codec = cache(lambda: load_generator(encoder=self.encoder()))

    def _dataset(self) -> Dataset:
        build_dataset(load_corpus(), load_encoder("minilm"), self.folder)
        return load_dataset(self.folder)

    def encoder(self) -> Remembered:
        """The vectors of the dataset's texts."""
        return Remembered(self.dataset())

    def _material(self, theme: str) -> Material:
        self.dataset()
        return read_material(self.folder, theme, HELD_OUT)

    def _seen(self, theme: str) -> Material:
        """As many training groups in the place of the held-out ones."""
        held_out = self.material(theme)
        rows = np.random.default_rng(self.seed).choice(len(held_out.train), len(held_out.test), replace=False)
        return replace(held_out, test=[held_out.train[i] for i in rows])

    def _paper(self, theme: str, variant: str = "full") -> PaperGenerator:
        """The paper's model of a theme, or an ablation of it."""
        name = folder_of(theme)
        place = f"paper-{name}" if variant == "full" else HERE / "models" / f"{name}-{variant}"
        generator = load_generator(place, self.encoder())
        assert isinstance(generator, PaperGenerator)
        return generator

    def source(self, theme: str, name: str) -> GraphSource:
        """A baseline, `codec`, or the paper's model: `full`, labels `drawn`, or one of those in `models/`."""
        if name in BASELINES:
            return BASELINES[name](self.material(theme))
        if name == "codec":
            return self.codec()
        if name == "drawn":
            return replace(self.paper(theme), drawn=True)
        return self.paper(theme, name)

    def evaluations(self, theme: str, names: Mapping[str, str], n_repeats: int) -> dict[str, Evaluation]:
        """By title the evaluation of each source."""
        return {title: self.evaluation(theme, name, n_repeats) for title, name in names.items()}

    def _evaluation(self, theme: str, name: str, n_repeats: int) -> Evaluation:
        """Of a source; `seen` is the paper's model asked with conditions of its training."""
        material = self.seen(theme) if name == "seen" else self.material(theme)
        source = self.source(theme, "full" if name == "seen" else name)
        return examine(source, material, Trial(n_repeats=n_repeats, seed=self.seed), name)


def folder_of(theme: str) -> str:
    """A theme as part of a folder's name."""
    return theme.replace(" ", "-")


def number(value: float | None, digits: int = 4) -> str:
    """A figure of a table; empty where there is none."""
    return "" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def run_experiment(name: str, study: Study, out: Path, *, check: bool) -> Iterator[str]:
    """Runs the experiment of a numbered folder, writes what came of it, and says so; or compares it with what is there.

    Raises:
        SystemExit: if a figure differs from the one on record.
    """
    module = importlib.import_module(f"reproduction.{name}.run")
    config, papers = _read(HERE / name / "config.json"), HERE / name / "paper.json"
    told = {"paper": _read(papers)} if papers.exists() else {}  # not every figure of the paper has numbers
    result: Result = module.run(study, **told, **config)
    yield result.table
    if check:
        recorded = _read(HERE / name / "result.json")
        worst, where = max(differences(recorded["figures"], json.loads(json.dumps(result.figures))), default=(0.0, ""))
        yield f"{name}: greatest difference from the record {worst:.2e} {where}".rstrip()
        if worst > TOLERANCE:
            raise SystemExit(f"{name}: {where} differs from the record by {worst:.1%}")
        return
    _write(out / name, config, result)
    yield f"{name}: written to {out / name}"


def _read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def differences(recorded: Any, found: Any, where: str = "") -> Iterator[tuple[float, str]]:
    """How far each figure is from the one on record, relative to it; infinite for what is missing or no number."""
    if isinstance(recorded, Mapping) and isinstance(found, Mapping):
        for key in {*recorded, *found}:
            yield from differences(recorded.get(key, math.inf), found.get(key, math.nan), f"{where}/{key}")
    elif isinstance(recorded, list) and isinstance(found, list) and len(recorded) == len(found):
        for i, (one, other) in enumerate(zip(recorded, found, strict=True)):
            yield from differences(one, other, f"{where}/{i}")
    elif recorded != found:
        numbers = all(isinstance(value, int | float) and math.isfinite(value) for value in (recorded, found))
        yield (abs(found - recorded) / max(abs(recorded), 1e-3) if numbers else math.inf), where


def _write(folder: Path, config: Mapping[str, Any], result: Result) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    said = {"config": config, "figures": result.figures, "measured_here": result.measured_here}
    (folder / "result.json").write_text(json.dumps(said, indent=1) + "\n", encoding="utf-8")
    (folder / "table.md").write_text(result.table.rstrip() + "\n", encoding="utf-8")
    for name, figure in result.pictures.items():
        figure.savefig(folder / name, dpi=100, metadata={"Software": None})


def door(names: Sequence[str], description: str | None) -> None:
    """The command line of one experiment, or of many."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dataset", type=Path, default=Path("out/dataset"), help="made if it is not there")
    parser.add_argument("--out", type=Path, default=HERE, help="where results go (in place of those on record)")
    parser.add_argument("--check", action="store_true", help="write nothing: compare with the results on record")
    if len(names) > 1:
        parser.add_argument("names", nargs="*", help="only these, such as 02 07")
    args = parser.parse_args()
    wanted = getattr(args, "names", None) or names
    study = Study(args.dataset)
    for name in names:
        if any(name.startswith(prefix) for prefix in wanted):
            for line in run_experiment(name, study, args.out, check=args.check):
                print(line, flush=True)


def experiments() -> list[str]:
    """The numbered folders."""
    return sorted(path.parent.name for path in HERE.glob("[0-9]*/run.py"))
