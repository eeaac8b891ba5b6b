"""What a source answers, and what that says of the answers alone."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from genc.evaluate.adherence import adherence
from genc.evaluate.evaluation import ADHERENCE, CHARACTER, Figure
from genc.evaluate.figures import interval, percent
from genc.evaluate.material import Material
from genc.evaluate.sequences import Interval
from genc.graph.crowd_graph import CrowdGraph
from genc.model.source import Decoded, GraphSource, MatrixSource
from genc.words.brief import Brief

VALID, COPIES, CHANGED, SPEED = "valid", "copies of training groups", "changed by repair", "speed"


@dataclass(frozen=True, eq=False)
class Answers:
    """What a source answered, draw after draw, one group for each brief.

    Attributes:
        decoded: of a `MatrixSource`, each group before and after its repair; else None.
        seconds: it took.
    """

    briefs: Sequence[Brief]
    groups: Sequence[CrowdGraph]
    decoded: Sequence[Decoded] | None
    seconds: float


def ask(source: GraphSource, briefs: Sequence[Brief], rng: np.random.Generator) -> Answers:
    """What a source answers to these briefs, and how long it takes."""
    start_s = time.perf_counter()
    if isinstance(source, MatrixSource):
        decoded = source.decode(briefs, rng)
        return Answers(briefs, [answer.group for answer in decoded], decoded, time.perf_counter() - start_s)
    return Answers(briefs, source.sample(briefs, rng), None, time.perf_counter() - start_s)


def copies(answers: Answers, material: Material) -> Figure:
    """Groups that are equal to a training group in everything; the test set has some too, most of them small."""
    learned = {sample.graph for sample in material.train}
    told = {"authored": [sample.graph for sample in material.test], "generated": answers.groups}
    columns = {of: percent(interval([sum(g in learned for g in groups) / len(groups)])) for of, groups in told.items()}
    return Figure(CHARACTER, COPIES, "%", "as authored", **columns)


def kept(answers: Answers) -> Iterator[Figure]:
    """Whether the groups are valid and what was asked for, how far they were mended, and how fast they came."""
    found = adherence(answers.briefs, answers.groups)
    mended = None if answers.decoded is None else np.array([answer.change_rate for answer in answers.decoded])
    decoded = {} if mended is None else {"decoded": percent(interval([float((mended == 0).mean())]))}
    yield _share(VALID, "100 %", found.valid, **decoded)
    for what in ("agents", "events", "nodes"):
        if not math.isnan(share := getattr(found, what)):
            yield _share(f"{what} as asked", "100 %", share)
    if not math.isnan(found.action_gap):
        yield _share("actions not as asked", "low", found.action_gap)
    if mended is not None:
        yield _share(CHANGED, "low", float(mended.mean()))
    yield Figure(ADHERENCE, SPEED, "groups/s", "high", generated=interval([len(answers.groups) / answers.seconds]))


def _share(name: str, best: str, share: float, **columns: Interval) -> Figure:
    return Figure(ADHERENCE, name, "%", best, generated=percent(interval([share])), **columns)
