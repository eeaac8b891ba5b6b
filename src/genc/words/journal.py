"""The journal: every question sent and every reply received, in one SQLite file, written before anything is used.

A line is written before a question leaves the house, and filled in when its reply is there. A line that a killed run
left open stands for a question whose reply, if there was one, is lost.
"""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from genc.errors import JournalError
from genc.words.language import Question, Reply, Usage

VERSION = 1
_APPLICATION = 0x67656E63
"""`genc` in ASCII: tells our files from other SQLite files."""
_TABLES = f"""
PRAGMA application_id = {_APPLICATION};
PRAGMA user_version = {VERSION};
CREATE TABLE calls (
  id INTEGER PRIMARY KEY, key TEXT NOT NULL, subject TEXT NOT NULL, step TEXT NOT NULL, question TEXT NOT NULL,
  asked_at TEXT NOT NULL, seconds REAL, outcome TEXT NOT NULL,
  reply TEXT, ending TEXT, n_prompt INTEGER NOT NULL DEFAULT 0, n_reply INTEGER NOT NULL DEFAULT 0);
CREATE UNIQUE INDEX answered ON calls (key) WHERE outcome = 'answered';
CREATE TABLE results (subject TEXT PRIMARY KEY, place INTEGER NOT NULL, state TEXT NOT NULL, words TEXT NOT NULL);
CREATE TABLE notes (name TEXT PRIMARY KEY, value TEXT NOT NULL);
"""


@dataclass(frozen=True)
class Account:
    """What was asked for one purpose, or about one subject.

    Attributes:
        n_answered, n_deferred, n_lost, n_refused: calls that brought a reply; that the server put off or that never
            reached it; that were sent without a reply arriving; that the server refused for good.
        usage: tokens of the answered ones.
        seconds: time spent on them.
    """

    n_answered: int
    n_deferred: int
    n_lost: int
    n_refused: int
    usage: Usage
    seconds: float


_RESULTS = "SELECT subject, state, words FROM results ORDER BY place"
_ACCOUNT = """
total(outcome = 'answered'), total(outcome IN ('deferred', 'unsent')), total(outcome IN ('lost', 'open')),
total(outcome = 'refused'), total(n_prompt), total(n_reply), total(seconds)
"""


class Journal:
    """The journal of one folder, open for writing by one run at a time; safe to use from many threads.

    Raises:
        JournalError: if the file is no journal, damaged, of another version, or in use by another run.
    """

    def __init__(self, path: Path, *, read_only: bool = False) -> None:
        self._path = path
        self._gate = threading.Lock()
        with self._told(), ExitStack() as opened:
            if not read_only:
                opened.enter_context(closing(_only_run(path)))
            elif not path.is_file():
                raise JournalError(f"{path}: no journal here; name the folder or the seeds that 'genc author' wrote")
            connected = sqlite3.connect(path, timeout=30, check_same_thread=False, isolation_level=None)
            self._db = opened.enter_context(closing(connected))
            self._check(read_only)
            if not read_only:
                self._db.execute("UPDATE calls SET outcome = 'lost' WHERE outcome = 'open'")
            self._opened = opened.pop_all()

    def close(self) -> None:
        """Lets go of the file."""
        self._opened.close()

    def find(self, key: str) -> Reply | None:
        """The reply to a question, if one was ever received."""
        rows = self._run(
            "SELECT reply, n_prompt, n_reply, ending FROM calls WHERE key = ? AND outcome = 'answered'", key
        )
        return next((Reply(text, Usage(n_prompt, n_reply), ending) for text, n_prompt, n_reply, ending in rows), None)

    def begin(self, question: Question, model_id: str) -> int:
        """Notes that a question is about to be sent; gives the number of its line."""
        now = datetime.now(UTC).isoformat(timespec="seconds")
        written = question.written(model_id), now, "open"
        line = question.key(model_id), question.subject, question.step, *written
        marks = (
            "INSERT INTO calls (key, subject, step, question, asked_at, outcome) VALUES (?, ?, ?, ?, ?, ?) RETURNING id"
        )
        return int(self._run(marks, *line)[0][0])

    def answer(self, call: int, reply: Reply, seconds: float) -> None:
        """Keeps a reply."""
        self._run(
            "UPDATE calls SET outcome = 'answered', reply = ?, ending = ?, n_prompt = ?, n_reply = ?, seconds = ? "
            "WHERE id = ?",
            *(reply.text, reply.ending, reply.usage.n_prompt, reply.usage.n_reply, seconds, call),
        )

    def fail(self, call: int, outcome: str, seconds: float) -> None:
        """Notes that a call brought no reply: `unsent`, `deferred`, `lost` or `refused`."""
        self._run("UPDATE calls SET outcome = ?, seconds = ? WHERE id = ?", outcome, seconds, call)

    def expect(self, subjects: Sequence[str]) -> None:
        """Notes these subjects, in this order, in place of all that were there; new ones are `open`."""
        with self._told(), self._gate, self._all_or_nothing():
            before = {subject: (state, words) for subject, state, words in self._db.execute(_RESULTS)}
            rows = ((s, place, *before.get(s, ("open", ""))) for place, s in enumerate(subjects))
            self._db.execute("DELETE FROM results")
            self._db.executemany("INSERT INTO results VALUES (?, ?, ?, ?)", rows)

    def settle(self, subject: str, state: str, words: str = "") -> None:
        """Notes what became of a subject: `accepted`, or `rejected` for the reasons in `words`."""
        self._run("UPDATE results SET state = ?, words = ? WHERE subject = ?", state, words, subject)

    def note(self, notes: Mapping[str, str]) -> None:
        """Keeps settings of the run for whoever asks later; a later value takes the place of an earlier one."""
        with self._told(), self._gate, self._all_or_nothing():
            self._db.executemany("INSERT OR REPLACE INTO notes VALUES (?, ?)", notes.items())

    def notes(self) -> dict[str, str]:
        """What `note` kept."""
        return dict(self._run("SELECT name, value FROM notes"))

    def results(self) -> list[tuple[str, str, str]]:
        """Subject, state and words of everything settled, in order of place."""
        return self._run(_RESULTS)

    def usage(self) -> Usage:
        """All tokens that were received."""
        ((n_prompt, n_reply),) = self._run("SELECT total(n_prompt), total(n_reply) FROM calls")
        return Usage(int(n_prompt), int(n_reply))

    def dearest(self) -> dict[str, int]:
        """For each purpose, the tokens of the reply that cost most."""
        rows = "SELECT step, max(n_prompt + n_reply) FROM calls WHERE outcome = 'answered' GROUP BY step"
        return {step: int(n) for step, n in self._run(rows)}

    def by_step(self) -> dict[str, Account]:
        """The account of each purpose, in order of first use."""
        rows = self._run(f"SELECT step, {_ACCOUNT} FROM calls GROUP BY step ORDER BY min(id)")
        return {step: _account(figures) for step, *figures in rows}

    def by_subject(self) -> dict[str, Account]:
        """The account of each subject, in order of first use."""
        rows = self._run(f"SELECT subject, {_ACCOUNT} FROM calls GROUP BY subject ORDER BY min(id)")
        return {subject: _account(figures) for subject, *figures in rows}

    def _check(self, read_only: bool) -> None:
        if not self._run("SELECT 1 FROM sqlite_master"):
            if read_only:
                raise JournalError(f"{self._path}: an empty journal; repeat the command that began it")
            self._db.executescript(f"BEGIN; {_TABLES} COMMIT;")
        application, version = (self._run(f"PRAGMA {name}")[0][0] for name in ("application_id", "user_version"))
        if application != _APPLICATION:
            raise JournalError(f"{self._path}: a database, but no journal of genc: name another folder")
        if version != VERSION:
            raise JournalError(
                f"{self._path}: a journal of version {version}, not {VERSION}: use the genc that wrote it"
            )

    def _run(self, statement: str, *values: object) -> list[tuple]:  # type: ignore[type-arg]
        with self._told(), self._gate:
            return self._db.execute(statement, values).fetchall()

    @contextmanager
    def _all_or_nothing(self) -> Iterator[None]:
        self._db.execute("BEGIN")
        try:
            yield
        except BaseException:
            self._db.execute("ROLLBACK")
            raise
        self._db.execute("COMMIT")

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Says in one line what the database says in its own way."""
        try:
            yield
        except sqlite3.Error as error:
            raise JournalError(
                f"{self._path}: the journal cannot be used ({error}): check the disk, or restore it"
            ) from error


def _only_run(path: Path) -> sqlite3.Connection:
    """A lock that the system takes away when the process ends, however it ends; works wherever SQLite does."""
    lock = sqlite3.connect(
        path.with_name(f".{path.name}.lock"), timeout=0, check_same_thread=False, isolation_level=None
    )
    try:
        lock.execute("BEGIN EXCLUSIVE")
    except sqlite3.OperationalError as error:
        lock.close()
        if "locked" not in str(error):
            raise
        raise JournalError(f"{path}: another run is at work here: wait for it, or name another folder") from None
    return lock


def _account(figures: list[float]) -> Account:
    n_answered, n_deferred, n_lost, n_refused, n_prompt, n_reply, seconds = figures
    usage = Usage(int(n_prompt), int(n_reply))
    return Account(int(n_answered), int(n_deferred), int(n_lost), int(n_refused), usage, seconds)
