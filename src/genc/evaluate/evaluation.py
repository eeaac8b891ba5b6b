"""`Evaluation`: all that came of examining a source, as data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

from genc.errors import BriefError
from genc.evaluate.material import ASKS, Facts
from genc.evaluate.pairs import Pair
from genc.evaluate.sequences import Interval

SCHEMA = 1
DISTANCE, CHARACTER, ADHERENCE = "distance", "character", "adherence"
"""Sections: how far from the test groups, of what kind in themselves, and whether they are what was asked for."""


@dataclass(frozen=True)
class Trial:
    """How a source is examined.

    Attributes:
        ask: how it is asked for the groups of the test set, one of `ASKS`.
        n_repeats: groups asked for each group of the test set, in as many draws.
        seed: of all chance.

    Raises:
        BriefError: for a way of asking that there is not, or no repeats.
    """

    ask: str = "full"
    n_repeats: int = 20
    seed: int = 0

    def __post_init__(self) -> None:
        if self.ask not in ASKS:
            raise BriefError(f"groups cannot be asked for by {self.ask!r}; choose {', '.join(ASKS)}")
        if not 1 <= self.n_repeats <= 1000:
            raise BriefError(f"{self.n_repeats} repeats cannot be drawn: ask for 1 to 1000")


@dataclass(frozen=True)
class Figure:
    """One measure of a source; what was not measured, or has no meaning, is None.

    Intervals over draws go from the 2.5th to the 97.5th percentile.

    Attributes:
        section: `DISTANCE`, `CHARACTER` or `ADHERENCE`.
        name, unit: of the measure; the unit is "nats", "%", "sd²" (of the features of training groups),
            "groups/s" or "".
        best: what would be best: "low", "high", "as authored" or a value.
        authored: of the test set itself.
        floor: of training groups in place of generated ones, as many as the test set has.
        generated: of the generated groups.
        decoded: of what a `MatrixSource` decodes, before it is repaired.
    """

    section: str
    name: str
    unit: str
    best: str
    authored: Interval | None = None
    floor: Interval | None = None
    generated: Interval | None = None
    decoded: Interval | None = None

    def ratio(self, value: Interval | None) -> float | None:
        """How many times its floor a distance is; None where a floor about 0 gives such a quotient no meaning."""
        if self.section != DISTANCE or self.floor is None or value is None or self.floor.low <= 0:
            return None
        return value.mean / self.floor.mean


@dataclass(frozen=True)
class Histogram:
    """The share of each bin of a measure, in the test set, in training groups and in generated groups."""

    authored: Sequence[float]
    train: Sequence[float]
    generated: Sequence[float]


@dataclass(frozen=True)
class Evaluation:
    """All that came of examining a source.

    Attributes:
        facts: source, material, versions and machine: what a reader needs to do it again.
        figures: in the order of the report.
        pairs: the most frequent pairs of action and category of "authored", "training", "generated" groups and, of a
            `MatrixSource`, "decoded" graphs.
        histograms: by name of the measure.
        notes: what a reader must know, one sentence each.
    """

    facts: Facts
    figures: tuple[Figure, ...]
    pairs: Mapping[str, Sequence[Pair]]
    histograms: Mapping[str, Histogram]
    notes: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> Figure:
        """The figure of that name."""
        return next(figure for figure in self.figures if figure.name == name)

    def as_json(self) -> dict[str, object]:
        """The whole evaluation as JSON values."""
        return {
            "schema": SCHEMA,
            "facts": dict(self.facts),
            "figures": [asdict(f) | self._ratios(f) for f in self.figures],
            "pairs": {of: [asdict(pair) for pair in pairs] for of, pairs in self.pairs.items()},
            "histograms": {name: asdict(histogram) for name, histogram in self.histograms.items()},
            "notes": list(self.notes),
        }

    @staticmethod
    def _ratios(figure: Figure) -> dict[str, float | None]:
        return {"ratio": figure.ratio(figure.generated), "decoded_ratio": figure.ratio(figure.decoded)}
