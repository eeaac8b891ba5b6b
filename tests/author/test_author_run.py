"""Whole runs against a server that does everything wrong, and runs that are killed."""

from __future__ import annotations

import random
import time
from collections import Counter
from dataclasses import replace

import authored
import pytest
from language_server import KEY, MODEL, SPOILT, TROUBLE, Mishaps, accounts

from genc.errors import ProviderError
from genc.scenario.author.events import Wish, ask_events
from genc.scenario.author.run import Manner, author_scenarios, author_seeds
from genc.scenario.author.seeds import Seed
from genc.scenario.corpus import load_scripts
from genc.words.embed import Hashing
from genc.words.journalled import Journalled, Patience
from genc.words.language import Usage

WISH = Wish.of_groups(16)
PATIENT = Patience(n_tries=30, first_wait_s=0.01, longest_wait_s=0.1)


@pytest.fixture
def manner(examples):
    return Manner(examples, n_parallel=8)


def test_every_fault_at_once(serve, ask, manner, many_seeds, tmp_path, genc):
    """A reduced version of `benchmarks/authoring.py`, which takes 200 scenarios."""
    server = serve(Mishaps(rate=0.045, seed=6, slow_s=1.6))
    model = ask(server, patience=PATIENT, timeout_s=0.8)
    accepted, rejected = author_scenarios(model, many_seeds[:24], tmp_path / "ski", WISH, manner)
    assert len({entry.fault for entry in server.books} & {*SPOILT, *TROUBLE}) >= 10

    assert len(accepted) + len(rejected) == 24
    assert len(accepted) >= 22
    assert load_scripts(tmp_path / "ski") == tuple(accepted)
    code, out, _ = genc("corpus", "check", tmp_path / "ski")
    assert code == 0, out
    delivered = Counter(entry.question for entry in server.books if entry.delivered)
    assert max(delivered.values()) == 1

    total, books = sum((a.usage for a in model.journal.by_step().values()), Usage()), accounts(server.books)
    assert total == Usage(books["n_prompt"], books["n_reply"]) == model.spent
    assert sum((a.usage for a in model.journal.by_subject().values()), Usage()) == total
    for count in ("deferred", "lost"):
        assert sum(getattr(a, f"n_{count}") for a in model.journal.by_step().values()) == books[count]
    assert [state for _, state, _ in model.journal.results()].count("accepted") == len(accepted)
    for path in tmp_path.rglob("*"):
        assert path.is_dir() or KEY.encode() not in path.read_bytes(), path


def test_what_is_rejected_is_told_with_the_validators_words(serve, ask, manner, many_seeds, tmp_path):
    server = serve(Mishaps(always="unknown location"))
    accepted, rejected = author_scenarios(ask(server), many_seeds[:3], tmp_path / "ski", WISH, manner)
    assert (accepted, len(rejected), len(server.books)) == ([], 3, 12)
    log = (tmp_path / "ski/rejected.log").read_text()
    assert log.count("environment: At the ski resort, ") == 3
    assert "unknown category 'portal'" in log
    assert not list((tmp_path / "ski").glob("*.txt"))


def test_the_order_of_replies_does_not_matter(serve, ask, examples, many_seeds, tmp_path):
    folders = []
    for n in (1, 16):
        model = ask(serve(Mishaps(rate=0.05, kinds=SPOILT, seed=2)), f"{n}.sqlite")
        author_scenarios(model, many_seeds[:12], tmp_path / str(n), WISH, Manner(examples, n_parallel=n))
        folders.append(authored.corpus_of(tmp_path / str(n)))
    assert folders[0] == folders[1]
    assert folders[0]


def test_a_run_again_asks_nothing_and_a_longer_list_only_what_is_new(serve, ask, manner, many_seeds, tmp_path):
    server = serve()
    model = ask(server)
    author_scenarios(model, many_seeds[:4], tmp_path / "ski", WISH, manner)
    before = authored.corpus_of(tmp_path / "ski")
    author_scenarios(model, many_seeds[:4], tmp_path / "ski", WISH, manner)
    assert (len(server.books), authored.corpus_of(tmp_path / "ski")) == (8, before)
    author_scenarios(model, [many_seeds[9], *many_seeds[:4]], tmp_path / "ski", WISH, manner)
    assert len(server.books) == 10
    author_scenarios(model, many_seeds[:4], tmp_path / "ski", WISH, manner)
    assert authored.corpus_of(tmp_path / "ski") == before


def test_killed_twenty_times_it_gives_the_same_corpus(serve, seeds_file, examples_file, tmp_path):
    server = serve(Mishaps(rate=0.02, kinds=SPOILT, seed=4, delay_s=0.03))
    words = ("author", "scenarios", seeds_file(22), "--model", MODEL, "--base-url", server.address)
    words += ("--examples", examples_file, "--parallel", "2", "--out")
    whole = authored.command(*words, tmp_path / "whole")
    whole.join()
    assert whole.exitcode == 0
    n_whole = len(server.books)

    rng, n_kills = random.Random(1), 0
    while n_kills < 20:
        run = authored.command(*words, tmp_path / "killed")
        time.sleep(rng.uniform(0.02, 0.25))
        if run.is_alive():
            run.kill()
            n_kills += 1
        run.join()
    last = authored.command(*words, tmp_path / "killed")
    last.join()
    assert last.exitcode == 0
    assert authored.corpus_of(tmp_path / "killed") == authored.corpus_of(tmp_path / "whole")
    assert len(authored.corpus_of(tmp_path / "whole")) >= 2
    assert authored.answered_twice(tmp_path / "killed") == []
    journal = authored.journal_of(tmp_path / "killed")
    n_lost = sum(account.n_lost for account in journal.by_step().values())
    journal.close()
    # only what was on its way when a run was killed had to be asked again
    assert len(server.books) - n_whole <= n_whole + n_lost


def test_a_server_that_dies_ends_the_run_and_what_came_is_kept(serve, ask, manner, many_seeds, tmp_path):
    server = serve(Mishaps())
    model = ask(server, patience=Patience(n_tries=2, first_wait_s=0.01))
    server.mishaps = Mishaps(rate=1.0, kinds=("broken",), seed=1)
    with pytest.raises(ProviderError, match="answered 500, 2 times in a row: what came is kept"):
        author_scenarios(model, many_seeds[:5], tmp_path / "ski", WISH, manner)


def test_seeds_are_as_many_as_asked_for_and_no_two_alike(serve, ask, manner):
    server = serve(Mishaps(rate=0.05, kinds=SPOILT, seed=1))
    seeds = author_seeds(ask(server), "Ski resort", (30, 5), manner, Hashing())
    assert len(seeds) == 30
    sentences = [seed.sentence for seed in seeds]
    vectors = Hashing().encode(sentences)
    near = vectors @ vectors.T
    assert len(set(sentences)) == 30
    assert max(near[i, j] for i in range(30) for j in range(i)) < 0.85
    assert all("ski resort" in sentence for sentence in sentences)
    assert sum(len(seed.wordings) for seed in seeds) >= 60
    assert {seed.theme for seed in seeds} == {"Ski resort"}


def test_a_theme_that_is_exhausted_gives_what_there_is(serve, ask, manner):
    seeds = author_seeds(ask(serve()), "Ski resort", (400, 0), manner, Hashing())
    assert 50 < len(seeds) < 289


def test_a_crowd_of_so_many_comes_from_the_same_question(serve, ask, manner, examples):
    stage = replace(examples[0], groups=())
    crowd = ask_events(ask(serve()), stage, Wish.of_agents(60), [], n_asks=1)
    n_agents = sum(len(group.agents) for group in crowd.groups)
    assert 0.8 <= n_agents / 60 <= 1.25
    assert crowd.environment == stage.environment


def test_a_run_that_cannot_go_on_leaves_what_an_earlier_one_wrote(serve, ask, manner, many_seeds, tmp_path):
    server = serve()
    model = ask(server)
    author_scenarios(model, many_seeds[:6], tmp_path / "ski", WISH, manner)
    before = authored.corpus_of(tmp_path / "ski")
    server.mishaps = Mishaps(always="broken")
    again = Journalled(model._model, model.journal, Patience(n_tries=1))
    with pytest.raises(ProviderError):
        author_scenarios(again, [*many_seeds[:6], *many_seeds[50:60]], tmp_path / "ski", WISH, manner)
    assert authored.corpus_of(tmp_path / "ski") == before
    assert [state for _, state, _ in model.journal.results()] == ["accepted"] * 6 + ["open"] * 10


def test_names_are_used_once(serve, ask, manner, tmp_path):
    seeds = [Seed("a", f"In the great hall {n} people wait for a late train.") for n in range(3)]
    accepted, _ = author_scenarios(
        ask(serve()), [*seeds, Seed("b", "In the great hall people wait.")], tmp_path, WISH, manner
    )
    name = "great-hall-people-wait"
    assert [scenario.slug for scenario in accepted] == [name, f"{name}.2", f"{name}.3", name]
