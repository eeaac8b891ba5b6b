"""The figure of scaling: crowds of 20 to 160 agents, by a plain language model and by the learned generators.

    python -m reproduction.04_scaling.run
    python -m reproduction.04_scaling.run --out out/scaling      (after config.json names a language model)

For each size, some sentences of held-out scenarios; groups are sampled from the prior and composed until the size is
met. H_seq is the normalised entropy of the agents' action sequences; it falls with the number of agents for any
source whose sequences can repeat, so authored agents, as many, stand beside it. Where the `endpoint` of `config.json`
names a `model` and, if need be, a `base_url` (anything OpenAI-compatible; the key comes from the environment), the
vanilla source is asked too, each reply kept in `out/vanilla.sqlite`: its drop rate is the share of crowds whose size is
outside 0.8 to 1.2 of what was asked, or that could not be read. None is on record.
The paper shows this figure without numbers, but for the drop rates of smaller language models: 0.32 and 0.94 at 20.
"""

from __future__ import annotations

import math
import time
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.sequences import action_sequences, normalised_entropy
from genc.evaluate.tables import markdown_table
from genc.model.source import GraphSource
from genc.pipeline import sample_groups
from genc.plan.compose import compose
from reproduction.study import THEMES, Result, Study, door, number

THEME = THEMES[0]
SOURCES = {"Gen-C": "full", "Gen-C, labels drawn": "drawn", "codec": "codec"}
VANILLA = "LLM"


def run(study: Study, sizes: list[int], n_seeds: int, endpoint: dict[str, str] | None) -> Result:
    """Entropy and time of each source at each size; of the vanilla source tokens and drop rate too."""
    sentences = list(dict.fromkeys(s.sentence for s in study.material(THEME).test))
    entropies: dict[str, list[dict[str, float]]] = {}
    times_s: dict[str, list[dict[str, float]]] = {}
    for title, name in SOURCES.items():
        source = study.source(THEME, name)
        runs = [[_run(source, sentences, size, seed) for seed in range(n_seeds)] for size in sizes]
        entropies[title] = [_interval([entropy for entropy, _ in some]) for some in runs]
        times_s[title] = [_interval([time_s for _, time_s in some]) for some in runs]
    asked: dict[str, list[dict[str, float]]] = {}
    if endpoint is not None:
        entropies[VANILLA], times_s[VANILLA], asked = _vanilla(endpoint, sentences, sizes, n_seeds)
    entropies["authored"] = [_interval(_authored(study, size, n_seeds)) for size in sizes]
    header = [
        "agents",
        *(f"H_seq, {title}" for title in entropies),
        *(f"seconds, {title}" for title in times_s),
        *asked,
    ]
    columns = [*entropies.values(), *times_s.values(), *asked.values()]
    rows = [[str(size), *(_cell(column[i], 3) for column in columns)] for i, size in enumerate(sizes)]
    picture = _picture(sizes, entropies, times_s)
    told = f"{THEME.title()}, {n_seeds} seeds; mean ± half a 95 % interval\n\n" + markdown_table(header, rows)
    return Result({"entropy": entropies}, told, {"scaling.png": picture}, {"seconds": times_s, **asked})


def _run(source: GraphSource, sentences: list[str], size: int, seed: int) -> tuple[float, float]:
    """Entropy and seconds of one crowd."""
    rng = np.random.default_rng([size, seed])
    start_s = time.perf_counter()
    groups = compose(partial(sample_groups, source, sentences[seed % len(sentences)], rng), size)
    seconds = time.perf_counter() - start_s
    return normalised_entropy(action_sequences(groups)), seconds


def _vanilla(endpoint: dict[str, str], sentences: list[str], sizes: list[int], n_seeds: int) -> tuple[Any, Any, Any]:
    """Entropies of valid crowds, seconds, and tokens and drop rate, at each size."""
    from genc.errors import ScriptError
    from genc.model.vanilla import Vanilla, is_valid
    from genc.words.journal import Journal
    from genc.words.journalled import Journalled, Patience
    from genc.words.providers import Endpoint, OpenAIChat

    with closing(OpenAIChat(Endpoint(**endpoint))) as client, closing(Journal(Path("out/vanilla.sqlite"))) as journal:
        model = Journalled(client, journal, Patience())
        vanilla = Vanilla(model)
        runs: list[list[tuple[float, float, float, float]]] = []
        for size in sizes:
            runs.append([])
            for seed in range(n_seeds):
                start_s, before = time.perf_counter(), model.spent.n_reply
                try:
                    groups = vanilla.crowd(sentences[seed % len(sentences)], size, np.random.default_rng([size, seed]))
                except ScriptError:
                    groups = []
                told = (time.perf_counter() - start_s, float(model.spent.n_reply - before))
                entropy = normalised_entropy(action_sequences(groups)) if is_valid(groups, size) else math.nan
                runs[-1].append((entropy, *told, 100.0 * math.isnan(entropy)))
    entropies, seconds, tokens, dropped = ([_interval([r[i] for r in some]) for some in runs] for i in range(4))
    return entropies, seconds, {"reply tokens, LLM": tokens, "drop rate, %": dropped}


def _authored(study: Study, size: int, n_seeds: int) -> list[float]:
    """Entropies of as many agents drawn from held-out groups."""
    sequences = action_sequences([s.graph for s in study.material(THEME).test])
    rng = np.random.default_rng(study.seed)
    picks = [rng.choice(len(sequences), size, replace=False) for _ in range(n_seeds)]
    return [normalised_entropy([sequences[i] for i in pick]) for pick in picks]


def _interval(values: list[float]) -> dict[str, float]:
    """The mean of what is not nan, and half the width of its 95 % interval."""
    spread: NDArray[np.float64] = np.array([value for value in values if not math.isnan(value)])
    if len(spread) < 2:
        return {"mean": math.nan, "half": math.nan}
    return {"mean": float(spread.mean()), "half": float(1.96 * spread.std(ddof=1) / np.sqrt(len(spread)))}


def _cell(interval: dict[str, float], digits: int) -> str:
    return f"{number(interval['mean'], digits)} ± {number(interval['half'], digits)}"


def _picture(sizes: list[int], entropies: dict[str, Any], times_s: dict[str, Any]) -> Any:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 3.8), layout="constrained")
    panels = {"sequence entropy H_seq": entropies, "seconds a crowd": times_s}
    for axes, (title, columns) in zip(figure.subplots(1, 2), panels.items(), strict=True):
        for name, column in columns.items():
            mean, half = (np.array([point[key] for point in column]) for key in ("mean", "half"))
            axes.plot(sizes, mean, label=name)
            axes.fill_between(sizes, mean - half, mean + half, alpha=0.2)
        axes.set_xlabel("agents")
        axes.set_title(title)
        axes.legend(frameon=False)
        axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    door([Path(__file__).parent.name], __doc__)
