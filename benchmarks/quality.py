"""How close generated groups are to authored ones: nine divergences from the test split, beside their floors.

    python benchmarks/quality.py --dataset out/dataset --json out/quality.json

`README.md` beside this file says how to read the table.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from genc.errors import GencError
from genc.evaluate.adherence import Adherence, adherence
from genc.evaluate.baselines import Retrieval, Shuffle
from genc.evaluate.comparison import NAMES, Divergences, compare, floor
from genc.evaluate.material import ASKS, PARTS, read_material
from genc.evaluate.measures import Profile, profile
from genc.learn.dataset import Sample
from genc.model.checkpoint import SHIPPED, load_generator
from genc.model.source import GraphSource
from genc.words.brief import Brief
from genc.words.embed import TextEncoder

FLOOR_REPEATS = 1000
"""Half a millisecond each. The mean of a few is noisy: in one resample two or three large groups rule the degree."""


@dataclass(frozen=True)
class Column:
    """A source, and one way of asking it for the groups of the test split."""

    title: str
    source: GraphSource
    briefs: list[Brief]


@dataclass(frozen=True)
class Outcome:
    """What came of a column."""

    title: str
    divergences: Divergences
    adherence: Adherence
    groups_per_s: float

    def total_error(self, ground: Divergences) -> float:
        """The standard error of the total ratio that comes of drawing so few times."""
        totals = self.divergences.nats.sum(1)
        return float(totals.std()) / math.sqrt(len(totals)) / ground.total


def columns(model: GraphSource, encoder: TextEncoder, train: Sequence[Sample], test: Sequence[Sample]) -> list[Column]:
    """The generator as the paper conditions it and with text alone, then the baselines."""
    full, sentence, caption = ([ASKS[way](s) for s in test] for way in ("full", "sentence", "caption"))
    groups = [s.graph for s in train]
    retrieval = Retrieval(groups, [(s.sentence, *s.paraphrases, s.caption) for s in train], encoder)
    return [
        Column("full condition", model, full),
        Column("sentence alone", model, sentence),
        Column("caption alone", model, caption),
        Column("shuffle, full condition", Shuffle(groups), full),
        Column("retrieval by sentence", retrieval, sentence),
        Column("retrieval by caption", retrieval, caption),
    ]


def outcome(column: Column, test: Profile, n_repeats: int, rng: np.random.Generator) -> Outcome:
    """Asks `n_repeats` times for one group for each brief, and measures what comes."""
    briefs = column.briefs * n_repeats
    start = time.perf_counter()
    groups = column.source.sample(briefs, rng)
    groups_per_s = len(groups) / (time.perf_counter() - start)
    draws = np.split(profile(groups), n_repeats)
    return Outcome(column.title, compare(test, draws), adherence(briefs, groups), groups_per_s)


def table(ground: Divergences, outcomes: Sequence[Outcome]) -> Iterator[str]:
    """The lines of a table: nats, and in brackets how many times the floor."""
    yield _row("", "floor", *(o.title for o in outcomes))
    yield "|---|" + "---:|" * (len(outcomes) + 1)
    ratios = [o.divergences.ratios(ground) for o in outcomes]
    for name in NAMES:
        cells = (f"{o.divergences.means[name]:.4f} ({r[name]:.2f})" for o, r in zip(outcomes, ratios, strict=True))
        yield _row(name, f"{ground.means[name]:.4f}", *cells)
    totals = ((o.divergences, o.total_error(ground)) for o in outcomes)
    cells = (f"{d.total:.4f} ({d.total_ratio(ground):.2f} ± {error:.2f})" for d, error in totals)
    yield _row("total", f"{ground.total:.4f}", *cells)
    for what in ("valid", "agents", "events", "nodes"):
        yield _row(f"{what}, %", "", *(_percent(getattr(o.adherence, what)) for o in outcomes))
    yield _row("action gap, %", "", *(_percent(o.adherence.action_gap) for o in outcomes))
    yield _row("groups/s", "", *(f"{o.groups_per_s:,.0f}" for o in outcomes))


def as_json(ground: Divergences, outcomes: Sequence[Outcome]) -> dict[str, object]:
    """Everything in the table, and how it spreads from draw to draw."""
    return {
        "floor": {"means": ground.means, "spreads": ground.spreads},
        "columns": {
            o.title: {
                "means": o.divergences.means,
                "spreads": o.divergences.spreads,
                "ratios": o.divergences.ratios(ground),
                "total_ratio": o.divergences.total_ratio(ground),
                "total_error": o.total_error(ground),
                "adherence": {what: None if math.isnan(v) else v for what, v in asdict(o.adherence).items()},
                "groups_per_s": o.groups_per_s,
            }
            for o in outcomes
        },
    }


def _percent(share: float) -> str:
    return "" if math.isnan(share) else f"{100 * share:.2f}"


def _row(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |"


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", type=Path, default=SHIPPED, help="a folder that 'genc train' made (the shipped one)")
    parser.add_argument("--dataset", type=Path, required=True, help="a folder made by 'genc dataset build'")
    parser.add_argument("--split", choices=PARTS, default="test", help="what to compare with")
    parser.add_argument("--theme", help="only this theme, spelled as in the dataset's manifest")
    parser.add_argument("--repeats", type=int, default=20, help="groups drawn for each brief")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", type=Path, help="write the figures here too")
    return parser.parse_args()


def main() -> None:
    args = _arguments()
    material = read_material(args.dataset, args.theme, args.split)
    train, test = material.train, material.test
    tested = profile([s.graph for s in test])
    ground = floor(profile([s.graph for s in train]), tested, FLOOR_REPEATS, np.random.default_rng(args.seed))
    encoder = material.encoder()
    outcomes = [
        outcome(column, tested, args.repeats, np.random.default_rng([args.seed, i]))
        for i, column in enumerate(columns(load_generator(args.model, encoder), encoder, train, test))
    ]
    print(
        f"{len(test)} groups of the {args.split} split, {args.repeats} draws, seed {args.seed}; nats (times the floor)"
    )
    print(*table(ground, outcomes), sep="\n")
    if args.json:
        run = {"model": str(args.model), "split": args.split, "theme": args.theme, "n_groups": len(test)}
        run |= {"n_repeats": args.repeats, "seed": args.seed}
        args.json.write_text(json.dumps(run | as_json(ground, outcomes), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    try:
        main()
    except GencError as error:
        sys.exit(f"error: {error}")
