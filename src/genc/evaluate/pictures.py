"""Pictures of an evaluation, each one SVG, by matplotlib (the extra `evaluate`)."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.evaluation import Evaluation, Histogram
from genc.evaluate.measures import BINS_PER_STEP
from genc.words.vocabulary import ACTIONS, CATEGORIES

AUTHORED, TRAINING, GENERATED = "#333333", "#b9b9b9", "#1f77b4"
WIDTH_IN = 9.0
_STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
}

Draw = Callable[[Any, Evaluation], None]


def pictures(evaluation: Evaluation) -> dict[str, str]:
    """By caption the SVG of each picture."""
    drawn: dict[str, tuple[float, Draw]] = {
        "What people do and where: share of all nodes, %": (3.9, _labels),
        "The shape of groups: share of nodes (degree) and of groups, %": (2.9, _shapes),
        "What follows what: generated less authored, in percentage points of all transitions": (4.6, _transitions),
    }
    return {caption: _svg(height_in, draw, evaluation) for caption, (height_in, draw) in drawn.items()}


def _svg(height_in: float, draw: Draw, evaluation: Evaluation) -> str:
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_STYLE | {"svg.hashsalt": draw.__name__}):
        figure = Figure(figsize=(WIDTH_IN, height_in), layout="constrained")
        draw(figure, evaluation)
        page = io.StringIO()
        figure.savefig(page, format="svg", metadata={"Date": None, "Creator": None})
    return page.getvalue()[page.getvalue().index("<svg") :]


def _labels(figure: Any, evaluation: Evaluation) -> None:
    panels = figure.subplots(1, 2, width_ratios=(1, 1))
    for axes, name, words in zip(panels, ("action", "category"), (ACTIONS, CATEGORIES), strict=True):
        _bars(axes, evaluation.histograms[name], words)
        axes.set_title(name)
    _legend(figure, panels[0])


def _bars(axes: Any, histogram: Histogram, words: Sequence[str]) -> None:
    """Horizontal bars, the most frequent of the test set on top."""
    authored, train, generated = (100 * np.array(s) for s in (histogram.authored, histogram.train, histogram.generated))
    order = np.argsort(authored, kind="stable")
    at = np.arange(len(words))
    axes.barh(at + 0.2, authored[order], 0.38, color=AUTHORED, label="test groups")
    axes.barh(at - 0.2, generated[order], 0.38, color=GENERATED, label="generated")
    axes.scatter(train[order], at, marker="|", s=110, color="#e07b00", zorder=3, label="training groups")
    axes.set_yticks(at, [words[i] for i in order])


def _shapes(figure: Any, evaluation: Evaluation) -> None:
    panels = figure.subplots(1, 3)
    bins = {"degree": (1.0, -0.5), "diameter": (1.0, -0.5), "average path length": (1 / BINS_PER_STEP, 0.0)}
    for axes, (name, (width, start)) in zip(panels, bins.items(), strict=True):
        histogram = evaluation.histograms[name]
        columns = [np.array(s) for s in (histogram.train, histogram.authored, histogram.generated)]
        n_shown = max(_reach(column) for column in columns)
        edges = start + width * np.arange(n_shown + 1)
        looks = ((TRAINING, "training groups"), (AUTHORED, "test groups"), (GENERATED, "generated"))
        for column, (colour, label) in zip(columns, looks, strict=True):
            axes.stairs(100 * column[:n_shown], edges, color=colour, label=label, linewidth=1.4)
        axes.set_title(name)
    _legend(figure, panels[0])


def _legend(figure: Any, axes: Any) -> None:
    """Below all panels, where it hides nothing."""
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)


def _reach(shares: NDArray[np.float64]) -> int:
    """Bins up to which 99.5 % of all lies: the longest tails would leave the rest no room."""
    return int(np.searchsorted(shares.cumsum(), 0.995)) + 1


def _transitions(figure: Any, evaluation: Evaluation) -> None:
    panels = figure.subplots(1, 2, width_ratios=(13, 9))
    for axes, name, words in zip(panels, ("action", "category"), (ACTIONS, CATEGORIES), strict=True):
        histogram = evaluation.histograms[f"{name} transition"]
        more = 100 * np.subtract(histogram.generated, histogram.authored).reshape(len(words), -1)
        bound = max(float(np.abs(more).max()), 1e-9)
        image = axes.imshow(more, cmap="RdBu", vmin=-bound, vmax=bound)
        axes.set_xticks(range(len(words)), words, rotation=60, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(words)), words)
        axes.set_title(f"{name}: from row to column")
        figure.colorbar(image, ax=axes, shrink=0.75)
