"""Table 4 and its figure: how near generated groups come to the training set in the latent spaces of a fixed evaluator.

    python -m reproduction.07_latent_space.run

The evaluator of a theme is the encoders of its own model, trained on training groups alone: posterior means of
structure (S) and features (F). T is the training set, P one generated group for each held-out condition and draw.
"Mix" is the model of the other theme, asked with this theme's conditions. The floor puts the held-out authored groups
in the place of P. Such an evaluator can be gamed (a collapsed posterior repeats the condition, whatever the group), so
an untrained one with node and edge attributes and a two-sample classifier stand beside it.

The paper does not say: whether P is sampled with training or with held-out conditions, and which encoder sees Mix.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from genc.evaluate.latent import bandwidth, frechet_distance, mmd_squared
from genc.evaluate.tables import markdown_table
from genc.graph.codec import canonical
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import full_brief
from genc.model.condition import Conditions
from genc.model.paper.generator import PaperGenerator
from genc.model.paper.graphs import Batch
from genc.words.brief import Brief
from reproduction.study import THEMES, Result, Study, door, number

Floats = NDArray[np.float64]
SPACES = ("S", "F")
UNTRAINED = ("FID, random GIN", "MMD², random GIN", "two-sample accuracy")
SOURCES = {"Gen-C": "full", "Gen-C, labels drawn": "drawn", "codec": "codec", "random": "random"}


def run(study: Study, paper: Any, n_repeats: int, n_plotted: int) -> Result:
    """The table and one picture for each theme."""
    figures: dict[str, Any] = {}
    tables, pictures = [], {}
    for theme, other in zip(THEMES, reversed(THEMES), strict=True):
        latents = _latents(study, theme, other, n_repeats)
        figures[theme] = {space: _distances(latents[space]) for space in SPACES}
        figures[theme]["untrained"] = {
            title: _untrained(study, theme, name, n_repeats) for title, name in SOURCES.items()
        }
        figures[theme]["untrained"]["floor"] = {
            name: study.evaluation(theme, "full", n_repeats)[name].floor.mean for name in UNTRAINED
        }
        tables += [f"### {theme.title()}", _table(figures[theme], paper[theme]), _untrained_table(figures[theme])]
        pictures[f"{theme.replace(' ', '_')}.png"] = _picture(latents, theme, n_plotted)
    return Result(figures, "\n\n".join(tables), pictures)


def _latents(study: Study, theme: str, other: str, n_repeats: int) -> dict[str, dict[str, Floats]]:
    """For S and F, the latents of the training set and of each set that is compared with it."""
    material, evaluator = study.material(theme), study.paper(theme)
    briefs = [full_brief(s.sentence, s.graph) for s in material.test]
    train = [full_brief(s.sentence, s.graph) for s in material.train]
    embedded = {
        "T": embed(evaluator, train, [s.graph for s in material.train]),
        "floor": embed(evaluator, briefs, [s.graph for s in material.test]),
    }
    sources = {title: study.source(theme, name) for title, name in SOURCES.items()}
    sources["Mix"] = study.paper(other)
    for i, (title, source) in enumerate(sources.items()):
        asked = briefs * n_repeats
        groups = source.sample(asked, np.random.default_rng([study.seed, i]))
        embedded[title] = embed(evaluator, asked, groups)
    return {space: {title: pair[i] for title, pair in embedded.items()} for i, space in enumerate(SPACES)}


@torch.inference_mode()
def embed(evaluator: PaperGenerator, briefs: Sequence[Brief], groups: Sequence[CrowdGraph]) -> tuple[Floats, Floats]:
    """The posterior means of groups under the conditions they answer, for structure and for features."""
    means: list[list[Floats]] = [[], []]
    for start in range(0, len(groups), 512):
        some = [canonical(group) for group in groups[start : start + 512]]
        batch = Batch.packed([Batch.of(group, np.arange(group.n_nodes)) for group in some])
        given = Conditions.of(briefs[start : start + 512], evaluator.encoder)
        for kept, mean in zip(means, evaluator.model.posterior_means(batch, given), strict=True):
            kept.append(mean.numpy().astype(np.float64))
    return np.concatenate(means[0]), np.concatenate(means[1])


def _distances(latents: dict[str, Floats]) -> dict[str, dict[str, float]]:
    train = latents["T"]
    gamma = bandwidth(train)
    return {
        title: {"FID": frechet_distance(train, some), "MMD²": mmd_squared(train, some, gamma)}
        for title, some in latents.items()
        if title != "T"
    }


def _untrained(study: Study, theme: str, name: str, n_repeats: int) -> dict[str, float]:
    evaluation = study.evaluation(theme, name, n_repeats)
    return {figure: evaluation[figure].generated.mean for figure in UNTRAINED}


def _table(figures: dict[str, Any], paper: dict[str, Any]) -> str:
    columns = ["floor", "Gen-C", "Mix", "Gen-C, labels drawn", "codec", "random"]
    rows = []
    for space in SPACES:
        for measure in ("FID", "MMD²"):
            told = [number(paper[space][f"{measure[:3]}{mix}"]) for mix in ("", " (Mix)")]
            rows.append([f"{space} {measure}", *told, *(number(figures[space][c][measure]) for c in columns)])
    return markdown_table(["", "Gen-C, paper", "Mix, paper", "floor", "Gen-C, ours", "Mix, ours", *columns[3:]], rows)


def _untrained_table(figures: dict[str, Any]) -> str:
    columns = ["floor", *SOURCES]
    rows = [[name, *(number(figures["untrained"][c][name], 3) for c in columns)] for name in UNTRAINED]
    return markdown_table(["", *columns], rows)


def _picture(latents: dict[str, dict[str, Floats]], theme: str, n_plotted: int) -> Any:
    """Training and generated latents on the first two principal axes of the training set."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 8), layout="constrained")
    grid = figure.subplots(2, 2)
    for row, space in zip(grid, SPACES, strict=True):
        train = latents[space]["T"]
        axes_of_train = np.linalg.svd(train - train.mean(0), full_matrices=False)[2][:2]
        for axes, title in zip(row, ("Gen-C", "Mix"), strict=True):
            for label, some, colour in (("training", train, "#333333"), (title, latents[space][title], "#d1495b")):
                x, y = ((some[:n_plotted] - train.mean(0)) @ axes_of_train.T).T
                axes.scatter(x, y, s=5, alpha=0.35, color=colour, linewidths=0, label=label)
            axes.set_title({"S": "structure", "F": "features"}[space] + f", {title}")
            axes.legend(frameon=False, markerscale=3)
            axes.spines[["top", "right"]].set_visible(False)
    figure.suptitle(f"{theme.title()}: posterior means, principal axes of the training set")
    return figure


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
