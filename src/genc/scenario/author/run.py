"""Runs of authoring: many questions at once, the same result in whatever order the replies come."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TypeVar

from tqdm import tqdm

from genc.errors import GencError, OutputError, ScriptError
from genc.files import write_text
from genc.scenario.author.dialogue import N_ASKS
from genc.scenario.author.events import Wish, ask_events
from genc.scenario.author.examples import draw
from genc.scenario.author.layout import ask_layout
from genc.scenario.author.seeds import Seed
from genc.scenario.author.wordings import ask_seeds, ask_wordings
from genc.scenario.scenario import Environment, Scenario
from genc.scenario.script import write_script
from genc.words.embed import TextEncoder
from genc.words.journalled import Journalled, Stopped
from genc.words.language import LanguageModel, Prices, Usage

_S = TypeVar("_S")
_T = TypeVar("_T")
_A_FILE = 20
"""Seeds whose scenarios share a file."""
_N_SENTENCES_SHOWN = 8
_HEAD = "# Made by 'genc author scenarios' and made anew by its next run here: edit a copy.\n"
REJECTED = "rejected.log"
"""Not `.txt`: every .txt file of a folder is taken for a script."""


@dataclass(frozen=True)
class Manner:
    """How a run works.

    Attributes:
        examples: authored scenarios to draw few-shot examples from.
        seed: of what is drawn.
        n_parallel: questions on the way at once.
        n_shown: examples in a question of Q1 and Q2.
        n_asks: questions until a layout or the events of a scenario are given up.
        prices: of tokens, for the progress bar.
    """

    examples: Sequence[Scenario]
    seed: int = 0
    n_parallel: int = 4
    n_shown: int = 2
    n_asks: int = N_ASKS
    prices: Prices = field(default_factory=Prices)


@dataclass(frozen=True)
class Rejection:
    """A seed without a scenario, and the validator's last words about it."""

    sentence: str
    step: str
    faults: tuple[str, ...]

    def __str__(self) -> str:
        return "\n  ".join([f"{self.step}: {self.sentence}", *self.faults]) + "\n"


def author_seeds(
    model: Journalled, theme: str, counts: tuple[int, int], manner: Manner, encoder: TextEncoder
) -> tuple[Seed, ...]:
    """Seeds of a theme with their other wordings; fewer than wanted where a model has no new ones.

    Args:
        model: who is asked.
        theme: what the sentences are about.
        counts: sentences, and wordings of each besides.
        manner: how.
        encoder: tells what is too near to something else.

    Raises:
        BudgetError, ProviderError, JournalError: if the run had to end early.
    """
    n_seeds, n_wordings = counts
    shown = [scenario.sentence for scenario in draw(manner.examples, _N_SENTENCES_SHOWN, manner.seed, theme)]
    sentences = ask_seeds(model, theme, n_seeds, shown, encoder)

    def work(sentence: str) -> tuple[str, ...]:
        return ask_wordings(model, sentence, n_wordings, encoder)

    found = dict(_each(work, sentences, model, manner, "paraphrases")) if n_wordings else {}
    return tuple(Seed(theme, sentence, found.get(i, ())) for i, sentence in enumerate(sentences))


def author_scenarios(
    model: Journalled, seeds: Sequence[Seed], folder: Path, wish: Wish, manner: Manner
) -> tuple[list[Scenario], list[Rejection]]:
    """Scenarios for these seeds, in their order, and the seeds for which there is none; both written to the folder.

    What is written depends on the replies alone; a run that ends early writes what they suffice for.

    Raises:
        OutputError: if the folder holds scripts of somebody else, or cannot be written.
        BudgetError, ProviderError, JournalError: if the run had to end early.
    """
    _check_own(folder)
    names = _slugs(seeds)
    model.journal.expect([seed.sentence for seed in seeds])
    accepted: dict[int, Scenario] = {}
    rejected: dict[int, Rejection] = {}
    failure: GencError | None = None
    try:
        for i, outcome in _each(partial(author_scenario, model, wish, manner), seeds, model, manner, "scenarios"):
            if isinstance(outcome, Scenario):
                accepted[i] = replace(outcome, slug=names[i])
                model.journal.settle(seeds[i].sentence, "accepted")
            else:
                rejected[i] = outcome
                model.journal.settle(seeds[i].sentence, "rejected", "\n".join(outcome.faults))
    except GencError as error:
        failure = error
    _write(folder, accepted, rejected)
    if failure is not None:
        raise failure
    return _in_order(accepted), _in_order(rejected)


def author_scenario(model: LanguageModel, wish: Wish, manner: Manner, seed: Seed) -> Scenario | Rejection:
    """The scenario of a seed, or why there is none."""
    examples = draw(manner.examples, manner.n_shown, manner.seed, seed.sentence)
    stage = Scenario("seed", seed.theme, seed.sentence, seed.wordings, Environment(()), ())
    step = "environment"
    try:
        stage = replace(stage, environment=ask_layout(model, seed.sentence, examples, manner.n_asks))
        step = "events"
        return ask_events(model, stage, wish, examples, manner.n_asks)
    except ScriptError as error:
        return Rejection(seed.sentence, step, error.problems)


def _each(
    work: Callable[[_S], _T], items: Sequence[_S], model: Journalled, manner: Manner, label: str
) -> Iterator[tuple[int, _T]]:
    """Index and result of each item, as they come; after an error only those that need no more questions still come."""
    failure: GencError | None = None
    with (
        ThreadPoolExecutor(manner.n_parallel) as pool,
        tqdm(total=len(items), desc=label, unit="sentence", disable=None) as bar,
    ):
        running = {pool.submit(work, item): i for i, item in enumerate(items)}
        try:
            for future in as_completed(running):
                try:
                    result = future.result()
                except Stopped:
                    continue
                except GencError as error:
                    failure = failure or error
                    model.stop()
                    continue
                bar.set_postfix_str(spent(model.spent, manner.prices))
                bar.update()
                yield running[future], result
        except BaseException:
            model.stop()
            pool.shutdown(cancel_futures=True)
            raise
    if failure is not None:
        raise failure


def spent(usage: Usage, prices: Prices) -> str:
    """Tokens and, where there are prices, their cost."""
    tokens = f"{usage.total:,} tokens"
    return f"{tokens}, cost {prices.cost(usage):,.2f}" if prices != Prices() else tokens


def _slugs(seeds: Sequence[Seed]) -> list[str]:
    """A name for each seed, of the first telling words of its sentence; used once in a theme."""
    n_taken: Counter[tuple[str, str]] = Counter()
    names = []
    for seed in seeds:
        words = re.findall(r"\w+", seed.sentence.casefold())
        name = "-".join(([word for word in words if len(word) > 3] or words or ["scene"])[:4])
        n_taken[seed.theme, name] += 1
        # a number behind a dot: no word has one, so no other name can be the same
        names.append(name if (n := n_taken[seed.theme, name]) == 1 else f"{name}.{n}")
    return names


def _check_own(folder: Path) -> None:
    for script in folder.glob("[0-9][0-9]*.txt"):
        if not script.read_text(encoding="utf-8", errors="replace").startswith(_HEAD):
            raise OutputError(f"{script} is not of a run of 'genc author': move it, or name another folder")


def _write(folder: Path, accepted: Mapping[int, Scenario], rejected: Mapping[int, Rejection]) -> None:
    """Scripts of twenty seeds each, and the log; nothing that an earlier run left behind stays."""
    files: dict[Path, list[Scenario]] = {}
    for i in sorted(accepted):
        files.setdefault(folder / f"{i // _A_FILE + 1:02d}.txt", []).append(accepted[i])
    for path, members in files.items():
        write_text(path, _HEAD + write_script(members))
    for old in set(folder.glob("[0-9][0-9]*.txt")) - set(files):
        old.unlink()
    if rejected:
        write_text(folder / REJECTED, "\n".join(map(str, _in_order(rejected))))
    else:
        (folder / REJECTED).unlink(missing_ok=True)


def _in_order(found: Mapping[int, _T]) -> list[_T]:
    return [found[i] for i in sorted(found)]
