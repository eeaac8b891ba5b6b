"""Table 3: what is done where most often, by authored groups and by the model.

python -m reproduction.06_top_pairs.run
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from reproduction.study import THEMES, Result, Study, door

OURS = {"Gen-C, ours": "full", "Gen-C, ours, labels drawn": "drawn", "codec": "codec"}


def run(study: Study, paper: Any, n_repeats: int) -> Result:
    """The four most frequent pairs of each source."""
    figures: dict[str, Any] = {}
    lines = []
    for theme in THEMES:
        evaluations = study.evaluations(theme, OURS, n_repeats)
        pairs = {"authored, all but held-out": evaluations["Gen-C, ours"].pairs["training"]}
        pairs["authored, held-out"] = evaluations["Gen-C, ours"].pairs["authored"]
        pairs |= {title: evaluation.pairs["generated"] for title, evaluation in evaluations.items()}
        figures[theme] = {
            title: [{"pair": f"{p.action}@{p.category}", "share": p.share} for p in some]
            for title, some in pairs.items()
        }
        told = {f"{title}, paper": text for title, text in paper[theme].items()}
        told |= {title: ", ".join(map(str, some)) for title, some in pairs.items()}
        lines += [f"### {theme.title()}", "| | four most frequent pairs |\n|---|---|\n" + _rows(told)]
    return Result(figures, "\n\n".join(lines))


def _rows(told: dict[str, str]) -> str:
    return "\n".join(f"| {title} | {text} |" for title, text in told.items())


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
