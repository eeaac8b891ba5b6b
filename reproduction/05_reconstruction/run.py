"""The figure of reconstruction statistics: held-out groups beside groups sampled from the conditional prior.

    python -m reproduction.05_reconstruction.run

Both sets of bars have the conditions of the held-out groups; grey is the floor, training groups. The paper gives no
numbers but those of Table 1 for these statistics.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from genc.evaluate.evaluation import Evaluation
from genc.evaluate.measures import BINS_PER_STEP, N_CLUSTERING_BINS
from genc.evaluate.tables import markdown_table
from genc.words.vocabulary import ACTIONS, CATEGORIES
from reproduction.study import THEMES, Result, Study, door, number

PANELS = {
    "degree": 1.0,
    "clustering": 1 / N_CLUSTERING_BINS,
    "diameter": 1.0,
    "average path length": 1 / BINS_PER_STEP,
    "action": None,
    "category": None,
}
"""The measures, and the width of their bins."""
SHOWN = {"degree": 12, "diameter": 24, "average path length": 40}
"""Bins of long tails that are drawn."""
SETS = {"authored": "#333333", "train": "#b9b9b9", "generated": "#1f77b4"}


def run(study: Study, n_repeats: int) -> Result:
    """One picture for each theme, and the divergences."""
    evaluations = {theme: study.evaluation(theme, "full", n_repeats) for theme in THEMES}
    drawn = {theme: study.evaluation(theme, "drawn", n_repeats) for theme in THEMES}
    figures = {
        theme: {
            "KLD": {name: evaluation[name].generated.mean for name in PANELS},
            "KLD, labels drawn": {name: drawn[theme][name].generated.mean for name in PANELS},
            "floor": {name: evaluation[name].floor.mean for name in PANELS},
            "shares": {name: vars(evaluation.histograms[name]) for name in PANELS},
        }
        for theme, evaluation in evaluations.items()
    }
    rows = [
        [name, *(number(figures[theme][column][name]) for theme in THEMES for column in list(figures[theme])[:3])]
        for name in PANELS
    ]
    titles = [f"{theme.title()}, {what}" for theme in THEMES for what in ("KLD", "labels drawn", "floor")]
    pictures = {f"{theme.replace(' ', '_')}.png": _picture(evaluations[theme], theme) for theme in THEMES}
    return Result(figures, markdown_table(["", *titles], rows), pictures)


def _picture(evaluation: Evaluation, theme: str) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 6.4), layout="constrained")
    for axes, (name, width) in zip(figure.subplots(2, 3).flat, PANELS.items(), strict=True):
        _panel(axes, evaluation, name, width)
    figure.suptitle(f"{theme.title()}: share of nodes (degree, clustering, action, category) or groups")
    figure.axes[0].legend(frameon=False)
    return figure


def _panel(axes: Any, evaluation: Evaluation, name: str, width: float | None) -> None:
    histogram = evaluation.histograms[name]
    n_bins = min(SHOWN.get(name, 10**6), len(histogram.authored))
    place = np.arange(n_bins)
    for i, (which, colour) in enumerate(SETS.items()):
        axes.bar(place + 0.28 * (i - 1), getattr(histogram, which)[:n_bins], 0.28, color=colour, label=which)
    axes.set_title(f"{name}, KLD {evaluation[name].generated.mean:.3f} (floor {evaluation[name].floor.mean:.3f})")
    if width is None:
        axes.set_xticks(place, ACTIONS if name == "action" else CATEGORIES, rotation=60, ha="right", fontsize=8)
    else:
        step = max(1, n_bins // 8)
        axes.set_xticks(place[::step], [f"{width * bin_:g}" for bin_ in place[::step]])
    axes.spines[["top", "right"]].set_visible(False)


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
