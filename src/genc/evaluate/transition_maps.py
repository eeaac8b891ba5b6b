"""Transition matrices as pictures, by matplotlib (the extra `evaluate`)."""

from __future__ import annotations

from pathlib import PurePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.assessment import Assessment, Side
from genc.evaluate.transitions import transition_counts
from genc.words.vocabulary import ACTION_INDEX, ACTIONS

_SIZE_IN = (15.0, 5.1)
_STYLE: dict[Any, Any] = {"font.family": "sans-serif", "font.size": 9, "axes.titlesize": 11}
_SHARES = ("Blues", 0.0, 0.6)
_DIFFERENCES = ("RdBu", -0.3, 0.3)
"""One scale for all pictures, so that they compare; what lies outside has the last colour."""
_UNKNOWN = "#d9d9d9"
_SHOWN = 0.045
"""Shares below have no number in their cell."""
_LONGEST_NAME = 36


def transition_maps(assessment: Assessment) -> Any:
    """A matplotlib figure of three heat maps: A, B, and A less B; all in per cent of what follows.

    Grey rows are unknown: nobody goes on from there. The third has a number where the 95 % interval leaves out 0.
    """
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=_SIZE_IN, layout="constrained")
        panels = figure.subplots(1, 3)
        for axes, (letter, side) in zip(panels, assessment.sides.items(), strict=False):
            _map(axes, side.transitions, _SHARES, side.transitions >= _SHOWN)
            _count(axes, side)
            axes.set_title(f"{letter}: {_short(side.lives.name)}")
        _map(panels[2], assessment.difference, _DIFFERENCES, _sure(assessment))
        panels[2].set_title("A − B, percentage points (blue: more in A)")
        panels[0].set_ylabel("from")
    return figure


def _map(axes: Any, shares: NDArray[np.float64], colours: tuple[str, float, float], shown: NDArray[np.bool_]) -> None:
    """One heat map; the cells of `shown` have a number."""
    name, low, high = colours
    axes.set_facecolor(_UNKNOWN)
    axes.imshow(shares, cmap=name, vmin=low, vmax=high)
    axes.set_xticks(range(len(ACTIONS)), ACTIONS, rotation=60, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(ACTIONS)), ACTIONS)
    axes.set_xlabel("to")
    axes.tick_params(length=0)
    for i, j in np.argwhere(shown).tolist():
        dark = abs(shares[i, j]) > 0.6 * high
        number = f"{100 * shares[i, j]:.0f}" if low == 0 else f"{100 * shares[i, j]:+.0f}"
        axes.text(j, i, number, ha="center", va="center", fontsize=7, color="white" if dark else "black")


def _count(axes: Any, side: Side) -> None:
    """At the right of each row, of how many transitions its shares are."""
    n_left = transition_counts(side.lives.sequences).sum(1)
    for i, n in enumerate(n_left.tolist()):
        axes.text(len(ACTIONS) - 0.3, i, f"{n:,}", va="center", fontsize=7, color="#555555")


def _sure(assessment: Assessment) -> NDArray[np.bool_]:
    sure = np.zeros((len(ACTIONS), len(ACTIONS)), dtype=bool)
    for deviation in assessment.deviations:
        sure[ACTION_INDEX[deviation.before], ACTION_INDEX[deviation.after]] = deviation.sure > 0
    return sure


def _short(name: str) -> str:
    """The last part of a path, or a whole name, at most so long that it fits above a map."""
    last = PurePath(name).name or name
    return last if len(last) <= _LONGEST_NAME else f"{last[: _LONGEST_NAME - 1]}…"
