"""Asking for sentences: seeds of a theme, and other wordings of a seed; what is too near to another is left out."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError
from pydantic_core import ErrorDetails

from genc.errors import ScriptError
from genc.scenario.author.dialogue import N_ASKS, ask_until_sound
from genc.scenario.author.prompts import prompt
from genc.scenario.author.replies import Sentences, schema_of
from genc.scenario.draft import clean
from genc.words.embed import TextEncoder
from genc.words.language import LanguageModel, Question

NEAR_SEED = 0.85
"""Cosine from which two seeds tell the same scene. Among those of a shipped theme the highest is 0.83."""
NEAR_WORDING = 0.97
"""Cosine from which two wordings differ in a comma."""
_AT_ONCE = 20
_MOST_SHOWN = 80
"""Sentences shown as taken already: the newest."""
_FRUITLESS = 3
"""Replies without anything new after which a theme or a sentence is exhausted."""


@dataclass(frozen=True)
class Want:
    """What kind of sentences, and how different.

    Attributes:
        step: the prompt, and the entry of the accounts.
        subject: a theme or a sentence.
        n: how many.
        fewest_words, most_words: their length.
        near: cosine from which two are the same.
    """

    step: str
    subject: str
    n: int
    fewest_words: int
    most_words: int
    near: float


def ask_seeds(model: LanguageModel, theme: str, n: int, shown: Sequence[str], encoder: TextEncoder) -> tuple[str, ...]:
    """Up to `n` sentences for a theme, no two alike, and none like the `shown` examples; fewer if no more come."""
    want = Want("seeds", theme, n, 8, 60, NEAR_SEED)
    return _collect(model, want, {"theme": theme, "examples": "\n".join(shown)}, _Kept(encoder, shown))


def ask_wordings(model: LanguageModel, sentence: str, n: int, encoder: TextEncoder) -> tuple[str, ...]:
    """Up to `n` other wordings of a sentence, no two alike; fewer if no more come."""
    want = Want("paraphrases", sentence, n, 3, 60, NEAR_WORDING)
    return _collect(model, want, {"sentence": sentence}, _Kept(encoder, [sentence]))


class _Kept:
    """Sentences no two of which are near to each other.

    Attributes:
        texts: those kept.
        offered: all that ever came, those refused too.
    """

    def __init__(self, encoder: TextEncoder, others: Sequence[str]) -> None:
        self._encoder = encoder
        self.texts: list[str] = []
        self.offered: list[str] = []
        self._vectors: NDArray[np.float32] = encoder.encode(others)
        self._said = {_bare(text) for text in others}

    def add(self, texts: Sequence[str], near: float, most: int) -> bool:
        """Keeps what is new among these, up to so many in all; says if there was any."""
        before = len(self.texts)
        self.offered += texts
        for text, vector in zip(texts, self._encoder.encode(texts) if texts else (), strict=True):
            known = _bare(text) in self._said or float((self._vectors @ vector).max(initial=-1.0)) >= near
            if not known and len(self.texts) < most:
                self.texts.append(text)
                self._said.add(_bare(text))
                self._vectors = np.concatenate([self._vectors, vector[None]])
        return len(self.texts) > before


def _collect(model: LanguageModel, want: Want, words: dict[str, str], kept: _Kept) -> tuple[str, ...]:
    fruitless = 0
    while len(kept.texts) < want.n and fruitless < _FRUITLESS:
        # a few more than are missing, for some will be too near to others; and never the same question twice
        count = max(1, min(_AT_ONCE, want.n - len(kept.texts) + 2) - fruitless)
        taken = "\n".join(kept.offered[-_MOST_SHOWN:]) or "(none)"
        turns = prompt(want.step, count=count, taken=taken, **words)
        question = Question(turns, schema_of(Sentences), fruitless * N_ASKS, want.subject, want.step)
        try:
            found = ask_until_sound(model, question, lambda text: read_sentences(text, want))
        except ScriptError:
            found = []
        fruitless = 0 if kept.add(found, want.near, want.n) else fruitless + 1
    return tuple(kept.texts)


def read_sentences(text: str, want: Want) -> list[str]:
    """The usable sentences of a reply.

    Raises:
        ScriptError: if there is none, with what is wrong with each.
    """
    try:
        found = [clean(sentence) for sentence in Sentences.model_validate_json(text).sentences]
    except ValidationError as error:
        raise ScriptError([_told(fault) for fault in error.errors(include_url=False, include_input=False)]) from None
    lines = [f"reply: {sentence[:60]!r}: {why}" for sentence in found if (why := _unfit(sentence, want))]
    sound = [sentence for sentence in found if not _unfit(sentence, want)]
    if not sound:
        raise ScriptError(lines or ["reply: no sentences in it; write those that were asked for"])
    return sound


def _unfit(sentence: str, want: Want) -> str:
    """Why a sentence is of no use; nothing if it is."""
    n_words = len(sentence.split())
    if not want.fewest_words <= n_words <= want.most_words:
        return f"{n_words} words; write {want.fewest_words} to {want.most_words}"
    if sentence.startswith(("#", "T:")) or set(sentence) & set("{}$"):
        return "no sentence about a scene; write plain prose"
    return ""


def _told(fault: ErrorDetails) -> str:
    where = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in fault["loc"])
    return f'reply{where}: {fault["msg"]}; write {{"sentences": ["..."]}}'


def _bare(text: str) -> str:
    """The words alone: texts that differ in case or marks only are the same."""
    return " ".join(re.findall(r"\w+", text.casefold()))
