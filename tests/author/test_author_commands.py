"""`genc author`, as a user meets it."""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path

import authored
import pytest
from language_server import KEY, MODEL, SPOILT, Mishaps, accounts

from genc.learn.build import build_dataset
from genc.learn.dataset import load_dataset
from genc.learn.run import train
from genc.learn.train import TrainConfig
from genc.model.checkpoint import load_generator
from genc.model.codec import CodecConfig
from genc.pipeline import populate
from genc.scenario.author.seeds import read_seeds
from genc.scenario.corpus import load_scripts
from genc.words.embed import Hashing


@pytest.fixture
def author(genc, examples_file):
    """Runs a command of `genc author` against a server."""

    def run(server, *words: object, model: str = MODEL) -> tuple[int, str, list[str]]:
        address = server if isinstance(server, str) else server.address
        code, out, err = genc("author", *words, "--model", model, "--base-url", address, "--examples", examples_file)
        assert KEY not in out + "".join(err)
        return code, out, err

    return run


def test_a_theme_from_its_name_to_a_checked_corpus(serve, author, genc, tmp_path):
    server, seeds, ski = serve(Mishaps(rate=0.02, kinds=SPOILT)), tmp_path / "ski.txt", tmp_path / "ski"
    words = ("--theme", "Ski resort", "--count", 6, "--paraphrases", 3, "--encoder", "hashing", "--out", seeds)
    code, out, _ = author(server, "seeds", *words)
    assert code == 0
    assert out.startswith(f"{seeds}: 6 seeds; ")
    assert [seed.theme for seed in read_seeds(seeds)] == ["Ski resort"] * 6
    code, out, err = author(server, "scenarios", seeds, "--out", ski, "--price-in", 2, "--price-out", 8)
    assert (code, err) == (0, [])
    assert out.startswith(f"{ski}: 6 scenarios; ")
    assert out.endswith(f"next: genc dataset build {ski} --out DATASET\n")
    code, out, _ = genc("corpus", "check", ski)
    assert code == 0
    assert "scenarios: 6, groups: " in out
    assert [s.sentence for s in load_scripts(ski)] == [seed.sentence for seed in read_seeds(seeds)]
    assert [s.paraphrases for s in load_scripts(ski)] == [seed.wordings for seed in read_seeds(seeds)]
    code, _, _ = author(server, "scenarios", seeds, "--count", 2, "--structured", "json", "--out", tmp_path / "json")
    assert code == 0
    assert [s.environment for s in load_scripts(tmp_path / "json")] == [s.environment for s in load_scripts(ski)[:2]]


def test_what_was_authored_is_learned_and_played(serve, author, seeds_file, tmp_path):
    """Themes are data: nothing but the folder of scripts goes from one step to the next."""
    author(serve(), "scenarios", seeds_file(8), "--out", tmp_path / "ski")
    scenarios = load_scripts(tmp_path / "ski")
    manifest = build_dataset(scenarios, Hashing(), tmp_path / "dataset")
    assert manifest.themes == ["Ski resort"]
    small = CodecConfig(Hashing.dimension, 16, 2, 4, 8, encoder_depth=1, structure_depth=1, feature_depth=1)
    model = train(load_dataset(tmp_path / "dataset"), tmp_path / "model", TrainConfig(epochs=2, batch_size=64), small)
    generator, layout = load_generator(model), scenarios[0].environment
    world = populate("At the ski resort people queue.", n_agents=12, minutes=2, environment=layout, generator=generator)
    assert len(world.plan.people) == 12
    assert world.plan.environment == layout


@pytest.mark.parametrize("command", ["seeds", "scenarios"])
@pytest.mark.parametrize(
    ("mistake", "said"),
    [
        ("key", "refused the key (401): check the key in OPENAI_API_KEY"),
        ("model", "knows no model 'gpt-0' (404"),
        ("host", "127.0.0.1:9 cannot be reached: check --base-url and the connection"),
        ("name", "cannot be reached"),
        ("url", "the base URL is none"),
    ],
)
def test_what_a_user_can_mend_is_one_line(serve, author, seeds_file, tmp_path, command, mistake, said):
    server = serve(key="sk-another-one" if mistake == "key" else KEY)
    address = {"host": "http://127.0.0.1:9/v1", "name": "http://no-such-host.invalid/v1", "url": "me"}
    words = {
        "seeds": ("--theme", "Ski resort", "--encoder", "hashing", "--out", tmp_path / "s.txt"),
        "scenarios": (seeds_file(5), "--out", tmp_path / "ski"),
    }
    name = "gpt-0" if mistake == "model" else MODEL
    code, out, err = author(address.get(mistake, server), command, *words[command], model=name)
    assert (code, out, len(err)) == (2, "", 1)
    assert err[0].startswith("error: ")
    assert said in err[0]
    for path in tmp_path.rglob("*"):
        assert path.is_dir() or KEY.encode() not in path.read_bytes()


def test_a_budget_stops_the_run_and_more_lets_it_go_on(serve, author, seeds_file, tmp_path):
    seeds, server = seeds_file(8), serve()
    author(server, "scenarios", seeds, "--out", tmp_path / "whole")
    n_whole = len(server.books)
    words = ("scenarios", seeds, "--out", tmp_path / "ski", "--max-tokens-total")
    code, out, err = author(server, *words, 30_000)
    assert (code, out, len(err)) == (2, "", 1)
    assert "the budget of 30,000 tokens is used up" in err[0]
    assert "go on with the same command and a larger --max-tokens-total" in err[0]
    journal = authored.journal_of(tmp_path / "ski")
    # a reply may be dearer than any before it, which is what is set aside for it
    assert 10_000 < journal.usage().total <= 33_000
    journal.close()
    assert author(server, *words, 10_000_000)[0] == 0
    assert len(server.books) == 2 * n_whole
    assert authored.corpus_of(tmp_path / "ski") == authored.corpus_of(tmp_path / "whole")


def test_status_tells_what_the_server_has_in_its_books(serve, author, genc, seeds_file, tmp_path):
    server = serve(Mishaps(rate=0.05, kinds=("refusal", "broken", "cut"), seed=2))
    author(
        server, "scenarios", seeds_file(10), "--count", 8, "--out", tmp_path / "ski", "--price-in", 2, "--price-out", 8
    )
    books = accounts(server.books)
    figures = json.loads(genc("author", "status", tmp_path / "ski", "--json")[1])
    cost = (2 * books["n_prompt"] + 8 * books["n_reply"]) / 1e6
    assert figures["total"] == {"n_prompt": books["n_prompt"], "n_reply": books["n_reply"], "cost": pytest.approx(cost)}
    assert figures["scenarios"] == {"accepted": 8, "rejected": 0, "open": 0}
    assert len(figures["sentences"]) == 8
    _, out, _ = genc("author", "status", tmp_path / "ski", "--each")
    lines = out.splitlines()
    assert lines[:2] == [f"model: {MODEL} structured=schema", "scenarios: 8 accepted, 0 rejected, 0 open"]
    assert lines[5].split()[:6] == [
        *("total", str(books["delivered"]), str(books["deferred"]), str(books["lost"]), "0", f"{books['n_prompt']:,}")
    ]
    assert len(lines) == 7 + 8
    assert f"{cost / 8:.4f}" in lines[6]


def test_status_of_nothing(genc, tmp_path):
    code, _, err = genc("author", "status", tmp_path)
    assert code == 2
    assert "no journal here" in err[0]
    assert list(tmp_path.iterdir()) == []


def test_what_is_there_is_not_overwritten(serve, author, seeds_file, tmp_path):
    mine = tmp_path / "mine.txt"
    mine.write_text("mine")
    code, _, err = author(serve(), "seeds", "--theme", "x", "--out", mine)
    assert (code, mine.read_text()) == (2, "mine")
    assert "is there already" in err[0]
    folder = tmp_path / "ski"
    folder.mkdir()
    (folder / "01.txt").write_text("mine too")
    code, _, err = author(serve(), "scenarios", seeds_file(2), "--out", folder)
    assert (code, (folder / "01.txt").read_text()) == (2, "mine too")
    assert "is not of a run of 'genc author'" in err[0]


def test_seeds_among_scripts_are_refused(serve, author, seeds_file):
    seeds = seeds_file(2)
    code, _, err = author(serve(), "scenarios", seeds, "--out", seeds.parent)
    assert code == 2
    assert "taken for a script: name another folder" in err[0]


def test_a_model_that_gives_nothing_usable_is_told(serve, author, seeds_file, tmp_path):
    server = serve(Mishaps(always="echo"))
    code, _, err = author(server, "scenarios", seeds_file(2), "--out", tmp_path / "ski")
    assert (code, len(err)) == (2, 1)
    assert f"no reply could be used: read {tmp_path / 'ski/rejected.log'}" in err[0]
    words = ("--theme", "Ski resort", "--encoder", "hashing", "--out", tmp_path / "s.txt")
    code, _, err = author(server, "seeds", *words)
    assert (code, len(err)) == (2, 1)
    assert "gave no sentence for 'Ski resort' that could be used" in err[0]


def test_interrupted_by_hand_it_ends_well_and_goes_on(serve, seeds_file, examples_file, tmp_path):
    server = serve(Mishaps(delay_s=0.05))
    words = ("author", "scenarios", seeds_file(20), "--model", MODEL, "--base-url", server.address)
    run = authored.command(*words, "--examples", examples_file, "--out", tmp_path / "ski")
    while len(server.books) < 6:
        time.sleep(0.01)
    os.kill(run.pid or 0, signal.SIGINT)
    run.join()
    assert run.exitcode == 130
    n = len(server.books)
    journal = authored.journal_of(tmp_path / "ski")
    assert sum(account.n_answered for account in journal.by_step().values()) == n < 40
    journal.close()
    again = authored.command(*words, "--examples", examples_file, "--out", tmp_path / "ski")
    again.join()
    assert again.exitcode == 0
    assert len(server.books) == 40


def test_the_prompts_ship_with_the_package():
    from genc.scenario.author import prompts

    names = {"again", "environment", "events", "paraphrases", "seeds"}
    assert {path.stem for path in (Path(prompts.__file__).parent / "prompts").glob("*.md")} == names
