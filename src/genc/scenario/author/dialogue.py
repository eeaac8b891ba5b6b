"""Asking until a reply holds, with the validator's words, and no longer than agreed."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

from genc.errors import ScriptError
from genc.scenario.author.prompts import mending
from genc.words.language import LanguageModel, Question, Reply, Turn

_T = TypeVar("_T")
N_ASKS = 4
"""One question and three times the validator's words."""
_MOST_WORDS = 20
"""Faults told at once; more are as a rule the same one over and over."""
_FENCE = re.compile(r"\s*```\w*\n(.*)\n```\s*", re.DOTALL)


def ask_until_sound(model: LanguageModel, question: Question, read: Callable[[str], _T], n_asks: int = N_ASKS) -> _T:
    """What `read` makes of the first reply that it can read.

    Each further question holds the last reply, if there was any, and what was wrong with it.

    Raises:
        ScriptError: with what was wrong with the last reply, if `n_asks` of them could not be read.
    """
    asked = question
    for attempt in range(1, n_asks + 1):
        reply = model.ask(asked)
        try:
            return read(_text_of(reply))
        except ScriptError as error:
            faults = error.problems
        asked = _again(question, reply, faults, attempt)
    raise ScriptError(faults)


def _again(question: Question, reply: Reply, faults: Sequence[str], attempt: int) -> Question:
    """The question with what was wrong with its reply; never the same twice, or the same would come back."""
    said = mending("\n".join(f"- {fault}" for fault in faults[:_MOST_WORDS]), attempt + 1)
    *before, asked = question.turns
    if reply.text and reply.ending in ("stop", "length"):
        turns = [*before, asked, Turn("assistant", reply.text), Turn("user", said)]
    else:
        # two turns of one side in a row, or an empty one, are more than some servers can take
        turns = [*before, Turn(asked.role, f"{asked.text}\n\n{said}")]
    return replace(question, turns=tuple(turns), attempt=question.attempt + attempt)


def _text_of(reply: Reply) -> str:
    """The text of a whole reply, out of the fence that some models put round it."""
    if reply.ending in ("refusal", "content_filter"):
        raise ScriptError([f"the model refused ({reply.ending}): {' '.join(reply.text.split())[:120]}"])
    if reply.ending == "length":
        raise ScriptError(["the reply was cut off for its length; write less"])
    if not reply.text.strip():
        raise ScriptError(["the reply is empty; answer with the JSON that was asked for"])
    fenced = _FENCE.fullmatch(reply.text)
    return fenced[1] if fenced else reply.text
