"""The journal and who asks through it: kept before used, asked once, waited for, paid for, and no more than agreed."""

from __future__ import annotations

import sqlite3
import threading
import time
from contextlib import closing

import pytest
from language_server import Mishaps, accounts

from genc.errors import BudgetError, JournalError, ProviderError
from genc.words.journal import Journal
from genc.words.journalled import Journalled, Patience, Stopped
from genc.words.language import NoReply, Prices, Question, Reply, Turn, Usage

FAST = Patience(first_wait_s=0.001, longest_wait_s=0.002)


def question(text: str = "what?", **more) -> Question:
    return Question((Turn("system", "rules"), Turn("user", text)), {"title": "Sentences"}, **more)


def lines(path, columns: str) -> list[tuple[object, ...]]:
    with closing(sqlite3.connect(path)) as db:
        return db.execute(f"SELECT {columns} FROM calls").fetchall()


class Told:
    """A model that says or raises what it was told to, and remembers what it was asked."""

    id = "told"

    def __init__(self, *said: Reply | Exception) -> None:
        self.said, self.asked = list(said), []

    def ask(self, asked: Question) -> Reply:
        self.asked.append(asked)
        answer = self.said.pop(0) if self.said else Reply("yes", Usage(10, 5))
        if isinstance(answer, Exception):
            raise answer
        return answer


@pytest.fixture
def journal(tmp_path):
    kept = Journal(tmp_path / "j.sqlite")
    yield kept
    kept.close()


def test_a_question_is_asked_once_also_by_the_next_run(journal, tmp_path):
    told = Told(Reply("once", Usage(7, 3), "length"))
    first = Journalled(told, journal, FAST).ask(question())
    journal.close()
    again = Journal(tmp_path / "j.sqlite")
    assert Journalled(told, again, FAST).ask(question()) == first == Reply("once", Usage(7, 3), "length")
    assert (len(told.asked), again.usage()) == (1, Usage(7, 3))
    again.close()


def test_what_makes_a_question_another_one(journal):
    told = Told()
    model = Journalled(told, journal, FAST)
    for asked in (question(), question("who?"), question(attempt=1), question(subject="other", step="other")):
        model.ask(asked)
    assert len(told.asked) == 3


def test_a_reply_is_in_the_journal_before_anybody_has_it(journal, tmp_path):
    class Watching(Told):
        def ask(self, asked):
            assert lines(tmp_path / "j.sqlite", "outcome") == [("open",)]
            return super().ask(asked)

    Journalled(Watching(), journal, FAST).ask(question())
    assert lines(tmp_path / "j.sqlite", "outcome, reply") == [("answered", "yes")]


def test_a_call_that_a_killed_run_left_open_counts_as_lost(journal, tmp_path):
    journal.begin(question(step="events"), "told")
    journal.close()
    again = Journal(tmp_path / "j.sqlite")
    assert again.by_step()["events"].n_lost == 1
    again.close()


def test_failures_are_tried_again_and_each_has_its_line(journal):
    told = Told(NoReply("deferred", "busy"), NoReply("lost", "gone"), NoReply("unsent", "away"))
    assert Journalled(told, journal, FAST).ask(question(step="events")).text == "yes"
    account = journal.by_step()["events"]
    assert (account.n_answered, account.n_deferred, account.n_lost, account.usage) == (1, 2, 1, Usage(10, 5))


def test_tries_end(journal):
    told = Told(*[NoReply("deferred", "server answered 500")] * 9)
    with pytest.raises(ProviderError, match="server answered 500, 8 times in a row: what came is kept"):
        Journalled(told, journal, FAST).ask(question())
    assert len(told.asked) == 8


def test_a_host_that_was_never_there_is_told_at_once(journal):
    told = Told(NoReply("unsent", "host cannot be reached"))
    with pytest.raises(ProviderError, match="cannot be reached: check --base-url"):
        Journalled(told, journal, FAST).ask(question())
    assert len(told.asked) == 1


def test_a_server_that_wants_quiet_gets_it_from_everybody(journal):
    told = Told(NoReply("deferred", "limit", 0.3))
    model = Journalled(told, journal, FAST)
    begun_s, ends_s = time.monotonic(), []

    def ask(text):
        model.ask(question(text))
        ends_s.append(time.monotonic() - begun_s)

    first = threading.Thread(target=ask, args=("one",))
    first.start()
    time.sleep(0.1)
    ask("two")
    first.join()
    assert min(ends_s) >= 0.3


def test_a_server_that_wants_an_hour_ends_the_run(journal):
    with pytest.raises(ProviderError, match=r"asks for 3,600 s of quiet: what came is kept"):
        Journalled(Told(NoReply("deferred", "limit", 3600)), journal, FAST).ask(question())


def test_nothing_is_asked_after_stop(journal):
    told = Told()
    model = Journalled(told, journal, FAST)
    model.ask(question("known"))
    model.stop()
    assert model.ask(question("known")).text == "yes"
    with pytest.raises(Stopped):
        model.ask(question("unknown"))
    assert len(told.asked) == 1


def test_a_budget_is_kept_and_goes_on_when_raised(journal):
    told = Told()
    spender = Journalled(told, journal, Patience(max_tokens=100))
    for n in range(6):
        spender.ask(question(f"question {n}"))
    with pytest.raises(BudgetError, match="larger --max-tokens-total"):
        spender.ask(question("question 7"))
    assert (len(told.asked), spender.spent) == (6, Usage(60, 30))
    more = Journalled(told, journal, Patience(max_tokens=400))
    for n in range(20):
        more.ask(question(f"question {n}"))
    assert (len(told.asked), journal.usage().total) == (20, 300)


def test_a_budget_is_kept_by_many_at_once(journal):
    class Slow(Told):
        def ask(self, asked):
            time.sleep(0.01)
            return super().ask(asked)

    told = Slow()
    model = Journalled(told, journal, Patience(max_tokens=100))
    model.ask(question("first, so that it is known what one costs"))
    ends = []

    def work(n):
        try:
            ends.append(model.ask(question(f"question {n}")))
        except BudgetError as error:
            ends.append(error)

    workers = [threading.Thread(target=work, args=(n,)) for n in range(12)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert (len(told.asked), len(ends), journal.usage().total) == (6, 12, 90)


def test_a_question_alone_may_be_too_much(journal):
    told = Told()
    with pytest.raises(BudgetError):
        Journalled(told, journal, Patience(max_tokens=100)).ask(question("word " * 1000))
    assert not told.asked


def test_accounts_agree_with_the_server(serve, ask):
    server = serve(Mishaps(rate=0.08, kinds=("limited", "broken", "cut", "no json", "hang up"), seed=3))
    model = ask(server)
    for n in range(20):
        model.ask(question(f"Sentence: {n} people wait at the station.\nWrite 1 other wordings.", step="paraphrases"))
    account, books = model.journal.by_step()["paraphrases"], accounts(server.books)
    assert (account.n_answered, account.n_deferred, account.n_lost) == (20, books["deferred"], books["lost"])
    assert account.usage == Usage(books["n_prompt"], books["n_reply"])
    assert books["deferred"] > 0
    assert books["lost"] > 0
    assert Prices(2, 8).cost(account.usage) == pytest.approx((2 * books["n_prompt"] + 8 * books["n_reply"]) / 1e6)


def test_one_run_at_a_time_but_anybody_may_look(journal, tmp_path):
    with pytest.raises(JournalError, match="another run is at work"):
        Journal(tmp_path / "j.sqlite")
    looking = Journal(tmp_path / "j.sqlite", read_only=True)
    assert looking.usage() == Usage()
    looking.close()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"no database at all, but long enough to be looked at as one" * 20, "cannot be used"),
        ("CREATE TABLE mine (x)", "no journal of genc"),
        ("PRAGMA application_id = 0x67656E63; PRAGMA user_version = 9; CREATE TABLE calls (x)", "version 9, not 1"),
    ],
    ids=["garbage", "foreign", "newer"],
)
def test_a_file_that_is_no_journal_is_left_alone(tmp_path, content, said):
    path = tmp_path / "j.sqlite"
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        with sqlite3.connect(path) as db:
            db.executescript(content)
        db.close()
    before = path.read_bytes()
    with pytest.raises(JournalError, match=said):
        Journal(path)
    assert path.read_bytes() == before


def test_looking_makes_no_journal(tmp_path):
    with pytest.raises(JournalError, match="no journal here"):
        Journal(tmp_path / "none.sqlite", read_only=True)
    assert list(tmp_path.iterdir()) == []
