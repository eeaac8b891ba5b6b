"""The assessment of the authored data: what follows what, and how various lives are, theme against theme.

    python -m reproduction.01_data_assessment.run

The paper sets a language model's train station against annotated video. No such annotations can be shipped, so the
figures on record compare the two authored themes; `genc assess` takes annotations of your own as a CSV file.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from genc.evaluate.sequences import action_sequences, entropy_interval
from genc.evaluate.transitions import transition_counts, transition_matrix
from genc.words.vocabulary import ACTIONS
from reproduction.study import THEMES, Result, Study, door, number, table

PAPER = {"LLM, train station (paper)": (0.949, 0.916, 0.970), "annotated video (paper)": (0.936, 0.935, 0.939)}
N_SHOWN = 8


def run(study: Study) -> Result:
    """Entropies with intervals, the greatest differences between the themes, and the matrices as pictures."""
    dataset = study.dataset()
    groups = {t: [s for part in ("train", "validation", "test") for s in dataset.split(part, t)] for t in THEMES}
    sequences = {t: [action_sequences([s.graph]) for s in some] for t, some in groups.items()}
    lives = {t: [life for group in some for life in group] for t, some in sequences.items()}
    scenarios = {t: [s.scenario for s, g in zip(groups[t], sequences[t], strict=True) for _ in g] for t in THEMES}
    size = min(map(len, lives.values())) // 2
    rng = np.random.default_rng(study.seed)
    entropies = {t: entropy_interval(lives[t], size, rng, scenarios[t]) for t in THEMES}
    matrices = {t: transition_matrix(lives[t]) for t in THEMES}
    told = [[name, *(number(value, 3) for value in interval)] for name, interval in PAPER.items()]
    told += [[f"{t}, {size} agents", *(number(v, 3) for v in vars(i).values())] for t, i in entropies.items()]
    figures = {
        "n_agents": {t: len(lives[t]) for t in THEMES},
        "entropy": {t: vars(interval) for t, interval in entropies.items()},
        "transitions": {t: transition_counts(lives[t]).tolist() for t in THEMES},
    }
    text = table(["normalised entropy of action sequences", "", "95 % from", "to"], told)
    text += "\n\n" + _differences(matrices)
    return Result(figures, text, {"transitions.png": _picture(matrices)})


def _differences(matrices: dict[str, Any]) -> str:
    """The transitions whose shares differ most."""
    one, other = matrices.values()
    gap = np.nan_to_num(one - other)
    greatest = np.argsort(-np.abs(gap), axis=None, kind="stable")[:N_SHOWN]
    rows = []
    for i, j in zip(*np.unravel_index(greatest, gap.shape), strict=True):
        rows.append([f"{ACTIONS[i]} → {ACTIONS[j]}", number(one[i, j], 2), number(other[i, j], 2), f"{gap[i, j]:+.2f}"])
    return table(["share of what follows", *matrices, "difference"], rows)


def _picture(matrices: dict[str, Any]) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(15, 5), layout="constrained")
    one, other = matrices.values()
    panels = {**matrices, "difference": one - other}
    for axes, (title, matrix) in zip(figure.subplots(1, 3), panels.items(), strict=True):
        signed = title == "difference"
        image = axes.imshow(matrix, cmap="RdBu_r" if signed else "viridis", vmin=-0.5 if signed else 0, vmax=0.5)
        axes.set_xticks(range(len(ACTIONS)), ACTIONS, rotation=60, ha="right", fontsize=8)
        axes.set_yticks(range(len(ACTIONS)), ACTIONS, fontsize=8)
        axes.set_title(title)
        figure.colorbar(image, ax=axes, shrink=0.8)
    return figure


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
