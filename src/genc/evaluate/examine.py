"""A source examined: every measure of what it generates, beside authored groups and their floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np
from tqdm import tqdm

from genc.evaluate.answers import Answers, ask, copies, kept
from genc.evaluate.comparison import NAMES
from genc.evaluate.crowd import Crowd, Lineup
from genc.evaluate.evaluation import Evaluation, Figure, Histogram, Trial
from genc.evaluate.figures import MEASURED
from genc.evaluate.material import ASKS, Material
from genc.evaluate.measures import histograms
from genc.evaluate.pairs import top_pairs
from genc.evaluate.provenance import check_extra, provenance
from genc.evaluate.random_gin import RandomGin
from genc.graph.crowd_graph import Ints
from genc.learn.dataset import Sample
from genc.model.source import GraphSource


def examine(source: GraphSource, material: Material, trial: Trial | None = None, name: str | None = None) -> Evaluation:
    """Everything that can be measured of a source: how near its groups are to the test groups, whether they are what
    was asked for, and what they are beyond that.

    The source is asked for one group for each test group, `n_repeats` times over; each of these draws is measured for
    itself, because every distance shrinks as a draw grows. A floor is what training groups score that are drawn in
    their place, as many.

    Args:
        name: of the source, for the report.

    Raises:
        ExtraError: if the extra `evaluate` is not installed.
    """
    check_extra()
    trial = trial or Trial()
    chances = np.random.default_rng(trial.seed).spawn(1 + len(MEASURED))
    with tqdm(total=2 + len(MEASURED), desc="evaluating", unit="step", disable=None, leave=False) as progress:
        answers = ask(source, [ASKS[trial.ask](sample) for sample in material.test] * trial.n_repeats, chances[0])
        progress.update()
        lineup = _line_up(answers, material)
        progress.update()
        figures: list[Figure] = []
        for measure, chance in zip(MEASURED, chances[1:], strict=True):
            figures += measure(lineup, chance)
            progress.update()
    return Evaluation(
        facts={
            "model": name or type(source).__name__,
            "model_hash": getattr(source, "hash", None),
            **getattr(source, "settings", {}),
            **material.facts,
            "n_train": len(material.train),
            "n_test": len(material.test),
            **asdict(trial),
            **provenance(),
        },
        figures=(*figures, copies(answers, material), *kept(answers)),
        pairs={of: top_pairs(crowd.groups) for of, crowd in lineup.all.items()},
        histograms=_shares(lineup),
        notes=material.notes,
    )


def _line_up(answers: Answers, material: Material) -> Lineup:
    evaluator = RandomGin()
    of_train, of_test = _clusters(material.train, material.test)
    of_answers = np.resize(of_test, len(answers.groups))
    made = {"generated": Crowd.of(answers.groups, of_answers, evaluator)}
    if answers.decoded is not None:
        made["decoded"] = Crowd.of([answer.graph for answer in answers.decoded], of_answers, evaluator)
    return Lineup(
        Crowd.of([s.graph for s in material.train], of_train, evaluator),
        Crowd.of([s.graph for s in material.test], of_test, evaluator),
        made,
    )


def _clusters(train: Sequence[Sample], test: Sequence[Sample]) -> tuple[Ints, Ints]:
    """For each training and each test group the number of its scenario; of the group itself if there is but one."""
    number = {name: i for i, name in enumerate(dict.fromkeys(s.scenario for s in (*train, *test)))}
    of_train, of_test = (np.array([number[s.scenario] for s in some]) for some in (train, test))
    if len(set(of_test.tolist())) == 1:
        of_test = len(number) + np.arange(len(test))
    return of_train, of_test


def _shares(lineup: Lineup) -> dict[str, Histogram]:
    """For each measure the share of each bin."""
    crowds = (lineup.test, lineup.train, lineup.made["generated"])
    pooled = [histograms(crowd.profile.sum(0)) for crowd in crowds]
    return {name: Histogram(*((of[i] / max(of[i].sum(), 1)).tolist() for of in pooled)) for i, name in enumerate(NAMES)}
