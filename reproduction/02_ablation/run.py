"""Table 1: KL divergence from the authored groups, for the model, its two ablations and the random baseline.

    python -m reproduction.02_ablation.run

"as decoded": entries of 0.5 and more in size are edges (what the paper, which names no repair, must have measured);
"repaired": the nearest valid group. Beyond the paper: the floor; Gen-C and Single with KL terms that are means over
the dimensions of a latent, as some code has them; Gen-C asked with conditions of its training, compared with the
groups that had them (what a split by group in place of one by scenario comes near to); its labels drawn rather than the
likeliest taken; its weights of the epoch that did best on validation groups; and the `codec` generator of this
package, which was trained on all themes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from genc.evaluate.evaluation import Evaluation
from genc.evaluate.tables import markdown_table
from reproduction.study import THEMES, Result, Study, door, number

ROWS = {
    "Degree": "degree",
    "Clustering Coefficient": "clustering",
    "Diameter": "diameter",
    "Average Path Length": "average path length",
    "Action": "action",
    "Location": "category",
}
PAPERS = {"w/o Canonical": "unordered", "Single": "single", "Random": "random", "Gen-C": "full"}
OURS = {
    **PAPERS,
    "KL per dimension": "kl-per-dimension",
    "Single, KL per dimension": "single-kl-per-dimension",
    "training conditions": "seen",
    "labels drawn": "drawn",
    "best epoch": "best",
    "codec": "codec",
}


def run(study: Study, paper: Any, n_repeats: int) -> Result:
    """The table of each theme, twice: beside the paper's figures, and with everything repaired."""
    figures: dict[str, Any] = {}
    tables = []
    for theme in THEMES:
        evaluations = study.evaluations(theme, OURS, n_repeats)
        figures[theme] = {title: _column(evaluation) for title, evaluation in evaluations.items()}
        figures[theme]["floor"] = {row: evaluations["Gen-C"][name].floor.mean for row, name in ROWS.items()}
        n_test = len(study.material(theme).test)
        tables += [
            f"### {theme.title()}: KLD in nats, {n_test} held-out groups, mean of {n_repeats} draws",
            "As decoded, beside the paper's figures (Random is valid as it is):",
            _beside(figures[theme], paper[theme]),
            "As decoded, beyond the paper:",
            _wide(figures[theme], "as decoded"),
            "Repaired:",
            _wide(figures[theme], "repaired"),
        ]
    return Result(figures, "\n\n".join(tables))


def _column(evaluation: Evaluation) -> dict[str, Any]:
    """The rows of the table as decoded (where there is such a thing) and as repaired, and the rate of changes."""
    column: dict[str, Any] = {"repaired": {row: evaluation[name].generated.mean for row, name in ROWS.items()}}
    if evaluation["degree"].decoded is not None:
        column["as decoded"] = {row: evaluation[name].decoded.mean for row, name in ROWS.items()}
        column["changed by repair, %"] = evaluation["changed by repair"].generated.mean
        column["valid as decoded, %"] = evaluation["valid"].decoded.mean
    return column


def _beside(figures: dict[str, Any], paper: dict[str, Any]) -> str:
    rows = []
    for row in ROWS:
        cells = [row]
        for title in PAPERS:
            column = figures[title]
            cells += [number(paper[title][row]), number(column.get("as decoded", column["repaired"])[row])]
        rows.append([*cells, number(figures["floor"][row])])
    header = ["", *(f"{title}, {whose}" for title in PAPERS for whose in ("paper", "ours")), "floor"]
    return markdown_table(header, rows)


def _wide(figures: dict[str, Any], state: str) -> str:
    columns = {title: figures[title] for title in OURS if state in figures[title]}
    rows = [
        [row, *(number(column[state][row]) for column in columns.values()), number(figures["floor"][row])]
        for row in ROWS
    ]
    extra = "valid as decoded, %" if state == "as decoded" else "changed by repair, %"
    rows.append([extra, *(number(column.get(extra), 1) for column in columns.values()), ""])
    return markdown_table(["", *columns, "floor"], rows)


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
