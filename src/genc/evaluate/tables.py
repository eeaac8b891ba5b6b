"""An evaluation as tables of words, for any kind of page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from genc.evaluate.evaluation import ADHERENCE, CHARACTER, DISTANCE, Evaluation, Figure
from genc.evaluate.pairs import Pair
from genc.evaluate.sequences import Interval

TITLES = {
    DISTANCE: "How far from the test groups",
    CHARACTER: "Of what kind",
    ADHERENCE: "As asked",
}
READING = (
    "Read each value beside its floor: what training groups score in the place of generated ones, as many as the test "
    "set has. A distance of 1 × floor is as near as authored groups are to each other; it can be less where the "
    "condition gives the answer away. docs/evaluation.md says what each row measures.",
    "Beside a value that differs from draw to draw stands where 95 % of the draws lie; beside a sequence entropy, its "
    "95 % interval.",
)
_DIGITS = {"nats": 4, "%": 1, "sd²": 1, "groups/s": 0, "": 4}
_COLUMNS = {"authored": "test groups", "training": "training groups", "generated": "generated", "decoded": "as decoded"}


@dataclass(frozen=True)
class Cell:
    """What stands in a cell, and what stands beside it in smaller letters."""

    text: str = ""
    aside: str = ""


@dataclass(frozen=True)
class Table:
    """A title, the heads of the columns, and rows of as many cells."""

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[Cell]]


def tables(evaluation: Evaluation) -> Iterator[Table]:
    """All figures, section by section, then the pairs."""
    for section, title in TITLES.items():
        yield _figures(title, [f for f in evaluation.figures if f.section == section])
    columns = {_COLUMNS[of]: pairs for of, pairs in evaluation.pairs.items()}
    ranks = range(max(len(pairs) for pairs in columns.values()))
    rows = [[Cell(str(k + 1)), *(_pair(pairs[k : k + 1]) for pairs in columns.values())] for k in ranks]
    yield Table("Most frequent pairs of action and place", ["", *columns], rows)


def facts(evaluation: Evaluation) -> Table:
    """What the evaluation was made of and with."""
    told = [(name.replace("_", " "), value) for name, value in evaluation.facts.items() if value is not None]
    return Table("Made of and with", ["", ""], [[Cell(name), Cell(f"{value}")] for name, value in told])


def markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown; all columns but the first are numbers."""
    lines = [heads, ["---", *["---:"] * (len(heads) - 1)], *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |" for cells in lines)


def _figures(title: str, figures: Sequence[Figure]) -> Table:
    """Columns that are empty throughout are left out."""
    columns: dict[str, list[Cell]] = {
        "": [Cell(f.name, f.unit) for f in figures],
        "best": [Cell(f.best) for f in figures],
        "test groups": [_value(f, f.authored) for f in figures],
        "floor": [_value(f, f.floor) for f in figures],
        "generated": [_value(f, f.generated) for f in figures],
        "× floor": [_ratio(f, f.generated) for f in figures],
        "as decoded": [_value(f, f.decoded) for f in figures],
        "decoded × floor": [_ratio(f, f.decoded) for f in figures],
    }
    shown = {head: cells for head, cells in columns.items() if any(cell.text for cell in cells)}
    return Table(title, list(shown), list(zip(*shown.values(), strict=True)))


def _pair(pair: Sequence[Pair]) -> Cell:
    return Cell(f"{pair[0].action}@{pair[0].category}", f"{100 * pair[0].share:.1f} %") if pair else Cell()


def _value(figure: Figure, value: Interval | None) -> Cell:
    if value is None:
        return Cell()
    mean, low, high = (f"{number:,.{_DIGITS[figure.unit]}f}" for number in (value.mean, value.low, value.high))
    return Cell(mean, f"{low} to {high}" if (low, high) != (mean, mean) else "")


def _ratio(figure: Figure, value: Interval | None) -> Cell:
    ratio = figure.ratio(value)
    return Cell() if ratio is None else Cell(f"{ratio:.2f}")
