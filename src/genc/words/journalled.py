"""A language model that forgets nothing: asked through a journal, with patience and within a budget."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from genc.errors import BudgetError, GencError, ProviderError
from genc.words.journal import Journal
from genc.words.language import LanguageModel, NoReply, Question, Reply, Usage


@dataclass(frozen=True)
class Patience:
    """How often and how slowly a question is tried again, and how much may be spent.

    Attributes:
        n_tries: for one question.
        first_wait_s: after the first failure; doubled after each further one up to `longest_wait_s`.
        most_wait_s: what a server may ask for by `Retry-After` before the run ends for now.
        max_tokens: of all replies in the journal together, those of earlier runs included.
    """

    n_tries: int = 8
    first_wait_s: float = 0.5
    longest_wait_s: float = 60.0
    most_wait_s: float = 300.0
    max_tokens: int | None = None


class Stopped(Exception):
    """The run was told to end: this question is not asked any more."""


class Journalled:
    """A `LanguageModel` that asks another one, once for each question, ever.

    A question that the journal holds a reply to is not asked. A reply is in the journal before it is given away. Each
    try has its own line there, which is why the tries are made here and not in the client. Failures on the way never
    show in what is given: a run ends with an error, and when it goes on it asks that question again.
    """

    def __init__(self, model: LanguageModel, journal: Journal, patience: Patience) -> None:
        self.id = model.id
        self.journal = journal
        self._model, self._patience = model, patience
        self._stop = threading.Event()
        self._purse = threading.Condition()
        self._spent = journal.usage()
        self._promised = 0
        self._dearest = journal.dearest()
        self._quiet_until_s = 0.0
        self._heard = False

    @property
    def spent(self) -> Usage:
        """Tokens of all replies in the journal."""
        return self._spent

    def stop(self) -> None:
        """Begins no other call; those on the way come home."""
        self._stop.set()
        with self._purse:
            self._purse.notify_all()

    def ask(self, question: Question) -> Reply:
        """The reply to a question: from the journal, else from the model.

        Raises:
            BudgetError: if it would probably cost more than is left.
            ProviderError: if the model refuses, or has been tried too often.
            Stopped: after `stop`.
        """
        known = self.journal.find(question.key(self.id))
        n_tries = 0
        while known is None:
            self._wait_for_quiet()
            try:
                known = self._try(question)
            except NoReply as failure:
                n_tries += 1
                self._pause(failure, n_tries, question.key(self.id))
        return known

    def _try(self, question: Question) -> Reply:
        with self._within_budget(question):
            call = self.journal.begin(question, self.id)
            begun_s = time.monotonic()
            try:
                reply = self._model.ask(question)
            except (NoReply, GencError) as failure:
                outcome = failure.outcome if isinstance(failure, NoReply) else "refused"
                self.journal.fail(call, outcome, time.monotonic() - begun_s)
                raise
            self.journal.answer(call, reply, time.monotonic() - begun_s)
            self._pay(question, reply.usage)
        return reply

    @contextmanager
    def _within_budget(self, question: Question) -> Iterator[None]:
        """Sets aside what the call will cost; if that is not there, waits for what other calls leave."""
        with self._purse:
            while self._is_short(question):
                if self._stop.is_set():
                    raise Stopped
                if not self._promised:
                    raise BudgetError(
                        f"the budget of {self._patience.max_tokens:,} tokens is used up ({self._spent.total:,} spent, "
                        f"about {self._cost(question):,} wanted for the next reply): what came is kept; go on with the "
                        "same command and a larger --max-tokens-total"
                    )
                self._purse.wait()
            cost = self._cost(question)
            self._promised += cost
        try:
            yield
        finally:
            with self._purse:
                self._promised -= cost
                self._purse.notify_all()

    def _is_short(self, question: Question) -> bool:
        most = self._patience.max_tokens
        if most is None:
            return False
        # the first of its kind goes alone, so that it is known what one costs
        is_first = question.step not in self._dearest and self._promised > 0
        return is_first or self._spent.total + self._promised + self._cost(question) > most

    def _cost(self, question: Question) -> int:
        """What a call will cost: as much as the dearest of its kind so far."""
        return max(self._dearest.get(question.step, 0), question.n_tokens_about)

    def _pay(self, question: Question, usage: Usage) -> None:
        with self._purse:
            self._heard = True
            self._spent += usage
            self._dearest[question.step] = max(self._dearest.get(question.step, 0), usage.total)

    def _pause(self, failure: NoReply, n_tries: int, key: str) -> None:
        """Waits before the next try, everybody if the server asked for it; raises if there is to be none."""
        patience, asked_s = self._patience, failure.wait_s or 0.0
        go_on = "what came is kept; go on with the same command"
        self._heard |= failure.outcome != "unsent"
        if not self._heard:
            raise ProviderError(f"{failure.words}: check --base-url and the connection")
        if n_tries >= patience.n_tries:
            raise ProviderError(f"{failure.words}, {n_tries} times in a row: {go_on} later")
        if asked_s > patience.most_wait_s:
            raise ProviderError(f"{failure.words} and asks for {asked_s:,.0f} s of quiet: {go_on} after that")
        self._quiet_until_s = max(self._quiet_until_s, time.monotonic() + asked_s)
        # between half and all of it, so that those who failed together do not come back together
        share = 0.5 + int(key[:4], 16) / 0x20000
        self._sleep(share * min(patience.longest_wait_s, patience.first_wait_s * 2 ** (n_tries - 1)))

    def _wait_for_quiet(self) -> None:
        while (left_s := self._quiet_until_s - time.monotonic()) > 0:
            self._sleep(left_s)
        self._sleep(0)

    def _sleep(self, seconds: float) -> None:
        if self._stop.wait(seconds):
            raise Stopped
