"""Runs of the command in processes of their own, and what they leave."""

from __future__ import annotations

import os
import signal
import sqlite3
import sys
from collections import Counter
from collections.abc import Sequence
from multiprocessing import get_context, set_start_method
from multiprocessing.process import BaseProcess
from pathlib import Path

from genc.words.journal import Journal

_FORKS = get_context("forkserver")
_FORKS.set_forkserver_preload(
    ["openai", "genc.cli", "tqdm", "genc.scenario.author.run", "genc.words.providers", "genc.scenario.corpus"]
)


def command(*words: object) -> BaseProcess:
    """`genc` with these words, begun in a fresh process that is cheap to begin."""
    process = _FORKS.Process(target=_main, args=([str(word) for word in words], dict(os.environ)))
    process.start()
    return process


def _main(words: Sequence[str], environment: dict[str, str]) -> None:
    from genc.cli import main

    # so that locks leave no names behind when the process is killed
    set_start_method("fork", force=True)
    # a shell starts what runs in its background deaf to an interruption, and so would this be
    signal.signal(signal.SIGINT, signal.default_int_handler)
    os.environ.update(environment)
    sys.argv = ["genc", *words]
    sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115 - the process ends with it
    main()


def corpus_of(folder: Path) -> dict[str, bytes]:
    """All that a run leaves but its journal, and what a killed one left half done."""
    kept = (path for path in folder.iterdir() if path.suffix in (".txt", ".log"))
    return {path.name: path.read_bytes() for path in kept}


def journal_of(folder: Path) -> Journal:
    """The journal of a folder, to look at."""
    return Journal(folder / "journal.sqlite", read_only=True)


def answered_twice(folder: Path) -> list[str]:
    """Questions to which the journal has two replies."""
    with sqlite3.connect(folder / "journal.sqlite") as db:
        rows = db.execute("SELECT key FROM calls WHERE outcome = 'answered'").fetchall()
    db.close()
    return [key for (key,), n in Counter(rows).items() if n > 1]
