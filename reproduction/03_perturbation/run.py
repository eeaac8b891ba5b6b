"""Table 2: the model against groups spoilt at random, on measures of order and company.

    python -m reproduction.03_perturbation.run

Perturb's nodes and edges are added and removed at random, its features uniform; it is measured as it is, and repaired.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from genc.evaluate.evaluation import Evaluation, Figure
from genc.evaluate.tables import markdown_table
from reproduction.study import THEMES, Result, Study, door, number

ROWS = {
    "Act. Trans.": "action transition",
    "Loc. Trans.": "category transition",
    "Joint KLD": "joint",
    "Interact Rate": "interaction participation",
}
OURS = {"Perturb": "perturb", "Gen-C": "full", "Gen-C, labels drawn": "drawn", "codec": "codec"}


def run(study: Study, paper: Any, n_repeats: int) -> Result:
    """The table of each theme."""
    figures: dict[str, Any] = {}
    tables = []
    for theme in THEMES:
        evaluations = study.evaluations(theme, OURS, n_repeats)
        figures[theme] = {title: _column(evaluation) for title, evaluation in evaluations.items()}
        of_model = evaluations["Gen-C"]
        figures[theme]["floor"] = {row: _value(of_model[name], "floor") for row, name in ROWS.items()}
        figures[theme]["GT"] = {row: _value(of_model[name], "authored") for row, name in ROWS.items()}
        tables += [f"### {theme.title()}", _table(figures[theme], paper[theme])]
    return Result(figures, "\n\n".join(tables))


def _column(evaluation: Evaluation) -> dict[str, dict[str, float | None]]:
    columns = {"as decoded": "decoded", "repaired": "generated"}
    return {
        title: {row: _value(evaluation[name], column) for row, name in ROWS.items()}
        for title, column in columns.items()
        if getattr(evaluation["degree"], column) is not None
    }


def _value(figure: Figure, column: str) -> float | None:
    """The figure's mean; rates are shares, as in the paper."""
    interval = getattr(figure, column)
    return None if interval is None else interval.mean / (100 if figure.unit == "%" else 1)


def _table(figures: dict[str, Any], paper: dict[str, Any]) -> str:
    columns = [
        *((f"{title}, paper", paper[title]) for title in ("Perturb", "Gen-C", "GT")),
        *((f"{title}, as decoded", figures[title]["as decoded"]) for title in ("Perturb", "Gen-C")),
        *((f"{title}, repaired", figures[title]["repaired"]) for title in ("Perturb", "Gen-C", "Gen-C, labels drawn")),
        ("codec", figures["codec"]["repaired"]),
        ("GT", figures["GT"]),
        ("floor", figures["floor"]),
    ]
    rows = [[row, *(number(column.get(row), 3) for _, column in columns)] for row in ROWS]
    return markdown_table(["", *(title for title, _ in columns)], rows)


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
