"""Authoring from a server that does everything wrong, and killed again and again: what comes out, what it cost.

    python benchmarks/authoring.py --scenarios 200 --rate 0.04 --kills 20

The server is the one of the tests (`tests/author/language_server.py`), in a process of its own. `README.md` beside this
file says what the numbers mean.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from genc.errors import GencError
from genc.scenario.author.seeds import Seed, write_seeds
from genc.scenario.corpus import load_corpus, load_scripts
from genc.words.language import Usage

ASKED = Path(__file__).parents[1] / "tests/author"
sys.path.insert(0, str(ASKED))
import authored  # noqa: E402
from language_server import KEY, MODEL, SPOILT, TROUBLE, Entry, accounts  # noqa: E402

THEME = "Ski resort"


@dataclass(frozen=True)
class Served:
    """A server in a process of its own."""

    address: str

    def books(self) -> list[Entry]:
        """Its entries so far."""
        with urllib.request.urlopen(self.address.removesuffix("/v1") + "/books") as answer:
            return [Entry(**entry) for entry in json.load(answer)]


@contextmanager
def serving(*options: object) -> Iterator[Served]:
    """Such a server, as long as the block lasts."""
    program = [sys.executable, str(ASKED / "language_server.py"), *map(str, options)]
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            yield Served(server.stdout.readline().strip())
        finally:
            server.terminate()


def author(served: Served, seeds: Path, folder: Path, *more: object) -> authored.BaseProcess:
    """A run of `genc author scenarios`, begun."""
    words = ("author", "scenarios", seeds, "--out", folder, "--model", MODEL, "--base-url", served.address)
    return authored.command(*words, *more)


def finished(run: authored.BaseProcess) -> bool:
    run.join()
    return run.exitcode == 0


def everything_wrong(seeds: Path, folder: Path, rate: float) -> Iterator[str]:
    """The run with every fault at once, and what the two books say."""
    with serving("--rate", rate, "--seed", 1, "--slow-s", 3) as served:
        start_s, n_runs = time.perf_counter(), 1
        while not finished(author(served, seeds, folder, "--timeout", 1.5, "--parallel", 8)):
            n_runs += 1
        took_s, books = time.perf_counter() - start_s, served.books()
    journal = authored.journal_of(folder)
    steps, states = journal.by_step(), Counter(state for _, state, _ in journal.results())
    journal.close()
    ours, theirs = sum((account.usage for account in steps.values()), Usage()), accounts(books)
    faults = Counter(entry.fault or "none" for entry in books)
    delivered = Counter(entry.question for entry in books if entry.delivered)
    yield f"requests             {len(books):,}: " + ", ".join(f"{n} {fault}" for fault, n in faults.most_common())
    yield f"runs, seconds        {n_runs}, {took_s:.1f}"
    yield f"accepted, rejected   {states['accepted']}, {states['rejected']}"
    loaded = load_scripts(folder)
    yield f"sound scenarios      {len(loaded)}, groups {sum(len(scenario.groups) for scenario in loaded):,}"
    yield f"replies got twice    {sum(n > 1 for n in delivered.values())} of {len(delivered):,}"
    for name, mine, its in (
        ("tokens in", ours.n_prompt, theirs["n_prompt"]),
        ("tokens out", ours.n_reply, theirs["n_reply"]),
        ("replies", sum(a.n_answered for a in steps.values()), theirs["delivered"]),
        ("put off", sum(a.n_deferred for a in steps.values()), theirs["deferred"]),
        ("lost on the way", sum(a.n_lost for a in steps.values()), theirs["lost"]),
    ):
        yield f"{name:20} {mine:,} in the journal, {its:,} in the server's books{'' if mine == its else '  DIFFERENT'}"
    leaks = [path.name for path in folder.iterdir() if KEY.encode() in path.read_bytes()]
    yield f"files with the key   {len(leaks)}"


def killed(seeds: Path, folder: Path, n_kills: int) -> Iterator[str]:
    """The run killed at random moments, beside one that was left alone."""
    with serving("--rate", 0.03, "--spoilt-only", "--seed", 2, "--delay-s", 0.05) as served:
        finished(author(served, seeds, folder / "whole"))
        n_whole, rng, n = len(served.books()), random.Random(3), 0
        while n < n_kills:
            run = author(served, seeds, folder / "killed")
            time.sleep(rng.uniform(0.0, 4.0))
            n += run.is_alive()
            run.kill()
            run.join()
        finished(author(served, seeds, folder / "killed"))
        n_killed = len(served.books()) - n_whole
    same = authored.corpus_of(folder / "killed") == authored.corpus_of(folder / "whole")
    yield f"killed               {n} times, the corpus is {'the same' if same else 'DIFFERENT'} byte for byte"
    journal = authored.journal_of(folder / "killed")
    n_lost = sum(account.n_lost for account in journal.by_step().values())
    journal.close()
    yield f"requests             {n_killed:,}, {n_whole:,} without kills; {n_lost} were on the way when a kill came"
    yield f"replies kept twice   {len(authored.answered_twice(folder / 'killed'))}"


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenarios", type=int, default=200)
    parser.add_argument("--rate", type=float, default=0.04, help=f"of each of {len(SPOILT) + len(TROUBLE)} faults")
    parser.add_argument("--kills", type=int, default=20)
    asked = parser.parse_args()
    os.environ["OPENAI_API_KEY"] = KEY
    tails = [scenario.sentence.partition(", ")[2] or scenario.sentence for scenario in load_corpus()]
    seeds = [Seed(THEME, f"At the ski resort, {tail}") for tail in tails][: asked.scenarios]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "seeds.txt"
        path.write_text(write_seeds(seeds), encoding="utf-8")
        for line in everything_wrong(path, Path(folder) / "wrong", asked.rate):
            print(line, flush=True)
        for line in killed(path, Path(folder), asked.kills):
            print(line, flush=True)


if __name__ == "__main__":
    try:
        main()
    except GencError as error:
        sys.exit(f"error: {error}")
