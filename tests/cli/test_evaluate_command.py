"""`genc evaluate` on a dataset and on scripts nobody has seen, and what it refuses."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from genc.evaluate import material, provenance
from genc.learn.build import build_dataset
from genc.scenario.corpus import load_theme, themes
from genc.scenario.script import write_script
from genc.words.embed import Hashing

DOCS = Path(__file__).parents[2] / "docs" / "evaluation.md"
FILES = {"report.html", "report.md", "result.json"}


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    place = tmp_path_factory.mktemp("evaluate") / "data"
    build_dataset(load_theme(themes()[0])[:8], Hashing(), place)
    return place


@pytest.fixture
def hidden(tmp_path, monkeypatch):
    """A folder of two scripts that no corpus has; the shipped corpus is a small one."""
    monkeypatch.setattr(material, "load_corpus", lambda: load_theme(themes()[0])[2:8])
    monkeypatch.setattr(material, "load_encoder", lambda name: Hashing())
    place = tmp_path / "hidden"
    place.mkdir()
    for i, scenario in enumerate(load_theme(themes()[0])[:2]):
        told = replace(scenario, slug=f"hidden-{i}", sentence=f"{scenario.sentence} It snows.")
        (place / f"{i}.txt").write_text(write_script([told]), encoding="utf-8")
    return place


def figures(folder: Path) -> dict[str, dict]:
    said = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    return {"facts": said["facts"]} | {f["name"]: f for f in said["figures"]}


@pytest.mark.parametrize("source", ["random", "perturb", "shuffle", "retrieval", "a folder"])
def test_each_source_is_evaluated_on_hidden_scripts(genc, model, hidden, tmp_path, source):
    name = model if source == "a folder" else source
    code, out, err = genc("evaluate", "--model", name, "--dataset", hidden, "--out", tmp_path / "r", "--repeats", 1)
    assert (code, err) == (0, [])
    assert "times the floor" in out
    assert str(tmp_path / "r" / "report.html") in out
    assert {file.name for file in (tmp_path / "r").iterdir()} == FILES
    found = figures(tmp_path / "r")
    assert found["facts"]["part"] == "scripts"
    assert found["facts"]["n_scenarios"] == 2
    assert found["valid"]["generated"]["mean"] == 100
    assert (found["degree"]["decoded"] is not None) == (source == "perturb")


def test_a_dataset_is_evaluated_by_part_theme_and_way_of_asking(genc, data, tmp_path):
    args = ["--split", "held-out", "--theme", themes()[0], "--ask", "caption", "--repeats", 2, "--seed", 5]
    code, _, err = genc("evaluate", "--model", "shuffle", "--dataset", data, "--out", tmp_path / "r", *args)
    assert (code, err) == (0, [])
    facts = figures(tmp_path / "r")["facts"]
    assert {k: facts[k] for k in ("part", "ask", "n_repeats", "seed", "model")} == {
        "part": "held-out",
        "ask": "caption",
        "n_repeats": 2,
        "seed": 5,
        "model": "shuffle",
    }


def test_each_bad_wish_is_one_line(genc, data, tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "file").write_text("")
    good = {"--model": "shuffle", "--dataset": data, "--out": tmp_path / "r", "--repeats": 1}
    for wish, said in (
        ({"--model": "gpt"}, "nor a baseline"),
        ({"--model": tmp_path / "empty"}, "no model here"),
        ({"--dataset": tmp_path / "empty"}, "neither a dataset"),
        ({"--dataset": tmp_path / "none"}, "no such file"),
        ({"--dataset": tmp_path / "file"}, "no scenario"),
        ({"--theme": "the moon"}, "the moon"),
        ({"--split": "best"}, "'best'"),
        ({"--ask": "nicely"}, "nicely"),
        ({"--repeats": 0}, "0 repeats"),
        ({"--repeats": "many"}, "--repeats"),
        ({"--seed": -1}, "--seed"),
        ({"--out": tmp_path / "file" / "r"}, "file"),
    ):
        code, out, err = genc("evaluate", *(word for pair in (good | wish).items() for word in pair))
        assert (code, out, len(err)) == (2, "", 1), (wish, err)
        assert said in err[0], (wish, err)
        assert not (tmp_path / "r").exists()


def test_a_missing_extra_is_said_before_anything_is_done(genc, data, tmp_path, monkeypatch):
    monkeypatch.setattr(provenance, "find_spec", lambda name: None)
    code, _, err = genc("evaluate", "--model", "shuffle", "--dataset", data, "--out", tmp_path / "r")
    assert (code, len(err)) == (2, 1)
    assert "genc[evaluate]" in err[0]


def test_the_snippet_of_the_docs_runs(data, tmp_path, capsys):
    (snippet,) = re.findall(r"```python\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.S)
    told = snippet.replace("out/dataset", str(data)).replace("out/shuffle", str(tmp_path / "r"))
    exec(compile(told, DOCS.name, "exec"), {})
    assert float(capsys.readouterr().out) > 0
    assert {file.name for file in (tmp_path / "r").iterdir()} == FILES


def test_the_docs_name_every_row_and_only_real_options(genc, data, tmp_path):
    told = DOCS.read_text(encoding="utf-8")
    genc("evaluate", "--model", "shuffle", "--dataset", data, "--split", "held-out", "--out", tmp_path, "--repeats", 1)
    for name in set(figures(tmp_path)) - {"facts"}:
        assert name.removesuffix(" as asked").removesuffix(", random GIN") in told, name
    _, shown, _ = genc("evaluate", "--help")
    for option in set(re.findall(r"`(--[a-z]+)", told)):
        assert option in shown, option
