"""`genc assess` on all that it takes, and what it refuses."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from genc.evaluate import provenance
from genc.evaluate.annotations import SYNTHETIC_ANNOTATIONS
from genc.learn.build import build_dataset
from genc.scenario.corpus import load_theme
from genc.scenario.script import write_script
from genc.words.embed import Hashing

DOCS = Path(__file__).parents[2] / "docs" / "assessment.md"


def test_whatever_has_lives_can_be_assessed(genc, tmp_path):
    build_dataset(load_theme("museum")[:6], Hashing(), tmp_path / "data")
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts" / "1.txt").write_text(write_script(load_theme("hospital")[:3]), encoding="utf-8")
    for a, b, said in (
        ("Museum", tmp_path / "data", "B has 6 scenarios"),
        (tmp_path / "data", tmp_path / "scripts", "B has 3 scenarios"),
        (tmp_path / "scripts", SYNTHETIC_ANNOTATIONS, "made one on both sides"),
    ):
        code, out, err = genc("assess", a, b, "--out", tmp_path / "r", "--seed", 3)
        assert code == 0, err
        assert any(said in line for line in err)
        assert all(line.startswith("note: ") for line in err)
        assert f"{tmp_path / 'r' / 'assessment.md'}: read it" in out
        figures = json.loads((tmp_path / "r" / "assessment.json").read_text(encoding="utf-8"))
        assert figures["seed"] == 3
        assert figures["merged"] == (b == SYNTHETIC_ANNOTATIONS)
        assert f"A: entropy of {figures['size']} action sequences {figures['A']['entropy']['mean']:.4f} (" in out


def test_two_authored_corpora_are_merged_on_demand(genc, tmp_path):
    assert genc("assess", "museum", "hospital", "--merge", "--out", tmp_path)[0] == 0
    figures = json.loads((tmp_path / "assessment.json").read_text(encoding="utf-8"))
    assert figures["merged"]
    assert all(figures["A"]["transition_counts"][i][i] == 0 for i in range(13))


@pytest.mark.parametrize(
    ("wish", "said"),
    [
        (["museum"], "'B'"),
        (["museum", "mars"], "mars: no such file or folder, and unknown theme 'mars'"),
        (["museum", "x" * 300], "unknown theme"),
        (["museum", "none.csv"], "none.csv: cannot be read"),
        (["museum", "."], "no scripts in this folder"),
        (["museum", "bad.csv"], "bad.csv:2: action is no action: 'fly'"),
        (["bad.txt", "museum"], "bad.txt"),
        (["museum", "hospital", "--seed", -1], "--seed"),
        (["museum", "hospital", "--out", "bad.txt/r"], "bad.txt"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_each_bad_wish_is_one_line(genc, tmp_path, monkeypatch, wish, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.csv").write_text("clip,window,person,action\nx,0,a,fly\n")
    (tmp_path / "bad.txt").write_text("")
    if wish[1:] == ["."]:
        (tmp_path / "bad.txt").unlink()
    code, out, err = genc("assess", *wish)
    assert (code, out, len(err)) == (2, "", 1), err
    assert err[0].startswith("error: ")
    assert said in err[0]
    assert not (tmp_path / "out").exists()


def test_a_missing_extra_is_said_before_anything_is_done(genc, tmp_path, monkeypatch):
    monkeypatch.setattr(provenance, "find_spec", lambda name: None)
    code, _, err = genc("assess", "museum", "mars", "--out", tmp_path / "r")
    assert (code, len(err)) == (2, 1)
    assert "genc[evaluate]" in err[0]


def test_the_docs_name_only_real_options(genc):
    _, shown, _ = genc("assess", "--help")
    options = set(re.findall(r"(--[a-z]+)", DOCS.read_text(encoding="utf-8"))) - {"--"}
    assert options == {"--out", "--merge"}
    assert all(option in shown for option in options)
