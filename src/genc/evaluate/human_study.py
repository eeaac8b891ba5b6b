"""What people expect: prompts, ranked answers, and the action probabilities in them (Gen-C, User Study).

People read a prompt and rank the five actions of the thirteen that they expect most. A *specific* prompt is a
sentence S_in; a *general* one asks what people do in a place of the theme, without context. `docs/study.md` describes
the files. What is compared with `performed_actions` of generated groups, by `distances.js_divergence`, is
`expected_actions`, and beside it stands `human_floor`: how far people are from each other.

The shipped prompts are written anew, as many of each kind and theme as in the paper, which does not print its own.
The shipped answers are invented: they show the format and let the harness run.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from genc.evaluate.csv_rows import read_rows, settle
from genc.evaluate.distances import js_divergence
from genc.graph.signed_graph import Labelled
from genc.scenario.faults import suggest
from genc.words.vocabulary import ACTION_INDEX, ACTIONS, Action, parse_action

Floats = NDArray[np.float64]

_SHIPPED = Path(__file__).parent / "study"
PROMPTS = _SHIPPED / "prompts.csv"
SYNTHETIC_RESPONSES = _SHIPPED / "synthetic_responses.csv"
"""Invented: nobody was asked."""

KINDS = ("specific", "general")
N_RANKS = 5
BORDA = (5.0, 4.0, 3.0, 2.0, 1.0)
"""The weight of each rank. Equal weights ask only whether an action was named, `(1, 0, 0, 0, 0)` which was first."""

_PROMPT_COLUMNS = ("id", "theme", "kind", "text")
_RESPONSE_COLUMNS = ("participant", "prompt", *(f"rank{i + 1}" for i in range(N_RANKS)))

_PAGE = "docs/study.md"


@dataclass(frozen=True)
class Prompt:
    """What a person reads: `theme` as scripts spell it, `kind` one of `KINDS`."""

    id: str
    theme: str
    kind: str
    text: str


@dataclass(frozen=True)
class Response:
    """What one person answered to one prompt (its id): five actions, the most common first."""

    participant: str
    prompt: str
    ranking: tuple[Action, ...]


def read_prompts(path: Path | str = PROMPTS) -> list[Prompt]:
    """The prompts of a CSV file, by default those of the package.

    Raises:
        StudyError: if the file cannot be read, or with every problem of it.
    """
    rows, problems = read_rows(path, _PROMPT_COLUMNS)
    first: dict[str, str] = {}
    for where, cells in rows:
        for column, cell in zip(_PROMPT_COLUMNS, cells, strict=True):
            if not cell:
                problems.append(f"{where}: {column} is empty; fill it")
        if cells[2] and cells[2] not in KINDS:
            problems.append(f"{where}: unknown kind {cells[2]!r}; {suggest(cells[2], KINDS)}")
        if first.setdefault(cells[0], where) != where:
            problems.append(f"{where}: a second prompt {cells[0]!r}, first at {first[cells[0]]}; give it its own id")
    settle(path, rows, problems, _PAGE)
    return [Prompt(*cells) for _, cells in rows]


def read_responses(path: Path | str, prompts: Sequence[Prompt]) -> list[Response]:
    """The answers of a CSV file: one row for each person and prompt.

    Raises:
        StudyError: if the file cannot be read, or with every problem of it.
    """
    rows, problems = read_rows(path, _RESPONSE_COLUMNS)
    known = {prompt.id for prompt in prompts}
    first: dict[tuple[str, str], str] = {}
    for where, (participant, prompt, *ranks) in rows:
        problems += [f"{where}: {problem}" for problem in _problems_of(participant, prompt, ranks, known)]
        before = first.setdefault((participant, prompt), where)
        if before != where:
            what = f"a second answer of {participant!r} to {prompt!r}, first at {before}"
            problems.append(f"{where}: {what}; keep one of them")
    settle(path, rows, problems, _PAGE)
    return [Response(row[0], row[1], tuple(Action(_folded(cell)) for cell in row[2:])) for _, row in rows]


def expected_actions(responses: Sequence[Response], weights: Sequence[float] = BORDA) -> Floats:
    """The probability of each action in these answers `[13]`, sum 1.

    An answer gives each action the weight of its rank; answers are averaged within each prompt and prompts with one
    another, so that one with more answers counts no more.

    The paper does not say: how ranks become probabilities. Borda's weights, 5 to 1, use the whole ranking and assume
    no more than that ranks are evenly apart. Whatever the weights, one answer reaches five actions at most.

    Raises:
        ValueError: if there are no answers.
    """
    if not responses:
        raise ValueError("no answers to expect anything from")
    answers: defaultdict[str, list[Floats]] = defaultdict(list)
    for response in responses:
        answer = np.zeros(len(ACTIONS))
        answer[[ACTION_INDEX[action] for action in response.ranking]] = weights
        answers[response.prompt].append(answer / answer.sum())
    expected: Floats = np.mean([np.mean(of_prompt, axis=0) for of_prompt in answers.values()], axis=0)
    return expected


def performed_actions(groups: Sequence[Labelled]) -> Floats:
    """The share of each action among the nodes of all these groups `[13]`."""
    counts = np.bincount(np.concatenate([group.action for group in groups]), minlength=len(ACTIONS))
    shares: Floats = counts / counts.sum()
    return shares


def human_floor(
    responses: Sequence[Response], n_repeats: int, rng: np.random.Generator, weights: Sequence[float] = BORDA
) -> float:
    """The mean divergence, in bits, between what two halves of the people expect, split anew each time.

    Somewhat more than what a generator would score that knew the minds of all: a half has more noise than the whole.

    Raises:
        ValueError: if there are fewer than two people.
    """
    people = sorted({response.participant for response in responses})
    if len(people) < 2:
        raise ValueError(f"answers of {len(people)} people cannot be split in two halves")
    return float(np.mean([_between_halves(responses, rng.permutation(people), weights) for _ in range(n_repeats)]))


def _between_halves(responses: Sequence[Response], people: NDArray[np.str_], weights: Sequence[float]) -> float:
    inside = set(people[: len(people) // 2].tolist())
    halves = [[r for r in responses if (r.participant in inside) is side] for side in (True, False)]
    return js_divergence(*(expected_actions(half, weights) for half in halves))


def _problems_of(participant: str, prompt: str, ranks: Sequence[str], known: Collection[str]) -> list[str]:
    found = [] if participant else ["participant is empty; give each person any name or number"]
    if prompt not in known:
        found.append(f"unknown prompt {prompt!r}; {suggest(prompt, sorted(known))}")
    for column, cell in zip(_RESPONSE_COLUMNS[2:], ranks, strict=True):
        if not cell:
            found.append(f"{column} is empty; an answer ranks {N_RANKS} actions")
        elif parse_action(_folded(cell)) is None:
            found.append(f"{column} is no action: {cell!r}; {suggest(cell, ACTIONS)}")
    for cell, n in Counter(_folded(cell) for cell in ranks if cell).items():
        if n > 1:
            found.append(f"{cell!r} is ranked {n} times; name {N_RANKS} different actions")
    return found


def _folded(action: str) -> str:
    return action.casefold()
