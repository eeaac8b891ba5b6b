"""`LanguageModel`: something that answers a question with a text and says what it cost."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, Protocol

CHARACTERS_A_TOKEN = 4
"""A rule of thumb, used only where nobody counted."""


class Turn(NamedTuple):
    """One thing said in a conversation."""

    role: Literal["system", "user", "assistant"]
    text: str


@dataclass(frozen=True)
class Question:
    """A conversation that wants its next turn.

    Attributes:
        turns: what was said so far, the model's own replies included.
        schema: JSON Schema of the reply; its `title` names it.
        attempt: counts how often these very turns were asked before because the reply was of no use.
        subject: what it is about, and `step` what it is for: entries of the accounts, not sent.
    """

    turns: tuple[Turn, ...]
    schema: Mapping[str, Any]
    attempt: int = 0
    subject: str = field(default="", compare=False)
    step: str = field(default="", compare=False)

    def written(self, model_id: str) -> str:
        """All that decides the reply, as JSON."""
        return json.dumps([model_id, self.turns, self.schema, self.attempt], ensure_ascii=False, sort_keys=True)

    def key(self, model_id: str) -> str:
        """The same question to the same model has the same key, in every run."""
        return hashlib.sha256(self.written(model_id).encode("utf-8", "replace")).hexdigest()

    @property
    def n_tokens_about(self) -> int:
        """How long the question is, roughly."""
        n_characters = sum(len(turn.text) for turn in self.turns) + len(json.dumps(self.schema))
        return n_characters // CHARACTERS_A_TOKEN


@dataclass(frozen=True)
class Usage:
    """Tokens: those of the question, and those of the reply."""

    n_prompt: int = 0
    n_reply: int = 0

    def __add__(self, other: Usage) -> Usage:
        return Usage(self.n_prompt + other.n_prompt, self.n_reply + other.n_reply)

    @property
    def total(self) -> int:
        """Both."""
        return self.n_prompt + self.n_reply


@dataclass(frozen=True)
class Prices:
    """What a million tokens costs, in whatever currency."""

    prompt: float = 0.0
    reply: float = 0.0

    def cost(self, usage: Usage) -> float:
        """What so many tokens cost."""
        return (usage.n_prompt * self.prompt + usage.n_reply * self.reply) / 1e6


@dataclass(frozen=True)
class Reply:
    """What came back, whatever it is worth.

    Attributes:
        text: the reply, empty if there is none.
        usage: what it cost.
        ending: why it ends: `stop`, `length` (cut off), `refusal` (the text says why), `content_filter`.
    """

    text: str
    usage: Usage
    ending: str = "stop"


class NoReply(Exception):
    """A try that brought nothing; another one may.

    Attributes:
        outcome: `unsent` (never reached the server), `deferred` (the server said to come later) or `lost` (sent,
            but no reply arrived whole: it may have been billed).
        words: what happened, in words that hold no secret.
        wait_s: how long the server wants to be left alone.
    """

    def __init__(self, outcome: Literal["unsent", "deferred", "lost"], words: str, wait_s: float | None = None) -> None:
        super().__init__(words)
        self.outcome, self.words, self.wait_s = outcome, words, wait_s


class LanguageModel(Protocol):
    """Answers questions.

    Attributes:
        id: the model's name and all settings that change what it says.
    """

    id: str

    def ask(self, question: Question) -> Reply:
        """One reply; may be called from many threads at once.

        Raises:
            NoReply: if none came, and trying again makes sense.
            ProviderError: if none will come.
        """
        ...
