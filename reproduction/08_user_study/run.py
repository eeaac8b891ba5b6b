"""The user study: action probabilities of the model beside what people expect, by Jensen-Shannon divergence in bits.

    python -m reproduction.08_user_study.run
    python -m reproduction.08_user_study.run --out out/study      (with the responses that config.json names)

`config.json` names the CSV of responses (docs/study.md says how to collect one). The one on record is SYNTHETIC: it
shows that the harness works and says nothing of people, and no figure of it belongs beside the paper's. Specific
prompts: some runs of each sentence, pooled. General prompts: all held-out groups of the theme, as in the paper.
"""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from genc.evaluate.distances import js_divergence
from genc.evaluate.human_study import (
    KINDS,
    PROMPTS,
    SYNTHETIC_RESPONSES,
    Prompt,
    expected_actions,
    human_floor,
    performed_actions,
    read_prompts,
    read_responses,
)
from genc.evaluate.material import ASKS
from genc.evaluate.tables import markdown_table
from genc.words.brief import Brief
from genc.words.embed import load_encoder
from genc.words.vocabulary import ACTIONS
from reproduction.study import THEMES, Result, Study, door, number

SOURCES = ("drawn", "full", "codec")


def run(study: Study, paper: Any, responses: str | None, n_runs: int, n_halvings: int) -> Result:
    """The divergences of each theme and kind of prompt, and bars of both probabilities."""
    prompts = read_prompts(PROMPTS)
    answers = read_responses(responses or SYNTHETIC_RESPONSES, prompts)
    rng = np.random.default_rng(study.seed)
    figures: dict[str, Any] = {"responses": responses or "synthetic", "n_people": len({a.participant for a in answers})}
    rows, bars = [], {}
    for theme, kind in product(THEMES, KINDS):
        asked = [p for p in prompts if p.theme == theme and p.kind == kind]
        of_these = [a for a in answers if a.prompt in {p.id for p in asked}]
        expected = expected_actions(of_these)
        found = {name: _performed(study, theme, kind, asked, name, n_runs) for name in SOURCES}
        uniform = np.full(len(ACTIONS), 1 / len(ACTIONS))
        column = {name: js_divergence(expected, shares) for name, shares in found.items()}
        column |= {"uniform": js_divergence(expected, uniform), "people": human_floor(of_these, n_halvings, rng)}
        figures[f"{theme}, {kind}"] = {"jsd": column, "probabilities": {k: v.tolist() for k, v in found.items()}}
        rows.append(
            [f"{theme}, {kind}", number(paper[theme][kind], 3), *(number(value, 3) for value in column.values())]
        )
        bars[f"{theme}, {kind}"] = (expected, found["drawn"])
    whose = "synthetic answers" if responses is None else responses
    header = [f"JSD, bits ({whose})", "Gen-C, paper (29 people)", *("Gen-C, labels drawn", "Gen-C", "codec")]
    return Result(
        figures, markdown_table([*header, "uniform", "people, half by half"], rows), {"actions.png": _picture(bars)}
    )


def _performed(study: Study, theme: str, kind: str, prompts: list[Prompt], name: str, n_runs: int) -> Any:
    """The action probabilities of a source, for specific sentences or over all held-out conditions."""
    rng = np.random.default_rng([study.seed, n_runs])
    if kind == "general":
        return performed_actions(
            study.source(theme, name).sample([ASKS["full"](s) for s in study.material(theme).test], rng)
        )
    from dataclasses import replace

    source = replace(study.source(theme, name), encoder=load_encoder("minilm"))
    return performed_actions(source.sample([Brief(p.text) for p in prompts] * n_runs, rng))


def _picture(bars: dict[str, tuple[Any, Any]]) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 6.4), layout="constrained")
    place = np.arange(len(ACTIONS))
    for axes, (title, (expected, found)) in zip(figure.subplots(2, 2).flat, bars.items(), strict=True):
        axes.bar(place - 0.2, expected, 0.4, color="#333333", label="answers")
        axes.bar(place + 0.2, found, 0.4, color="#1f77b4", label="Gen-C, labels drawn")
        axes.set_xticks(place, ACTIONS, rotation=60, ha="right", fontsize=8)
        axes.set_title(title)
        axes.spines[["top", "right"]].set_visible(False)
    figure.axes[0].legend(frameon=False)
    return figure


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
