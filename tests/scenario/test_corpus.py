from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from genc.errors import BriefError, ScriptError
from genc.scenario.corpus import SHIPPED, corpus_hash, load_corpus, load_scripts, load_theme, themes
from genc.scenario.exchange import write_json
from genc.scenario.faults import faults, hints
from genc.scenario.scenario import Scenario
from genc.scenario.script import write_script


def test_the_shipped_corpus_is_whole(authored: tuple[Scenario, ...]) -> None:
    groups = [group for scenario in authored for group in scenario.groups]
    assert len(authored) == 288
    assert len(groups) == 5306
    assert sum(len(group.agents) for group in groups) == 10_954
    assert sum(len(e.agents) * len(e.pairs) for group in groups for e in group.events) == 78_707


def test_every_shipped_scenario_is_sound_and_leaves_nothing_to_wish(authored: tuple[Scenario, ...]) -> None:
    assert [fault for scenario in authored for fault in (*faults(scenario), *hints(scenario))] == []


def test_a_theme_is_a_folder() -> None:
    assert len(themes()) == len([folder for folder in SHIPPED.iterdir() if folder.is_dir()]) == 9
    assert "university campus" in themes()
    for theme in themes():
        assert {scenario.theme for scenario in load_theme(theme)} == {theme}


@pytest.mark.parametrize("name", ["university_campus", "University Campus", " university-campus "])
def test_a_theme_has_many_spellings(name: str) -> None:
    assert len(load_theme(name)) == 96


def test_an_unknown_theme_is_refused_with_the_nearest_and_the_known() -> None:
    with pytest.raises(BriefError, match=r"unknown theme 'trian station'; did you mean 'train station'\?.*city park"):
        load_theme("trian station")
    with pytest.raises(BriefError, match="unknown theme 'moon'; known are: airport terminal"):
        load_corpus(["train station", "moon"])


def test_a_choice_of_themes_keeps_its_order() -> None:
    assert [s.theme for s in load_corpus(["museum", "hospital"])] == ["museum"] * 16 + ["hospital"] * 16


def test_files_and_folders_are_read_together(tmp_path: Path, authored: tuple[Scenario, ...]) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "a.txt").write_text(write_script(authored[:2]), encoding="utf-8")
    (tmp_path / "deep" / "b.json").write_text(write_json(authored[2:3]), encoding="utf-8")
    (tmp_path / "c.txt").write_text(write_script(authored[3:4]), encoding="utf-8")
    assert load_scripts(tmp_path / "deep", tmp_path / "c.txt", tmp_path / "c.txt") == authored[:4]


def test_problems_of_all_files_are_told_at_once(tmp_path: Path, authored: tuple[Scenario, ...]) -> None:
    (tmp_path / "a.txt").write_text(write_script(authored[:1]), encoding="utf-8")
    (tmp_path / "b.txt").write_text(write_script(authored[:1]), encoding="utf-8")
    (tmp_path / "c.txt").write_text("=== c\nnonsense", encoding="utf-8")
    (tmp_path / "d.txt").write_text("", encoding="utf-8")
    with pytest.raises(ScriptError) as caught:
        load_scripts(tmp_path)
    told = str(caught.value)
    assert f"b.txt:3: a second scenario named {authored[0].slug!r}, first at {tmp_path}/a.txt:3" in told
    assert "c.txt:2: not understood: 'nonsense'" in told
    assert "d.txt: no scenario in it" in told


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ScriptError, match="no scripts in this folder"):
        load_scripts(tmp_path)


def test_the_hash_changes_with_content_and_order(authored: tuple[Scenario, ...]) -> None:
    some = authored[:3]
    assert corpus_hash(some) == corpus_hash(list(some))
    assert len(corpus_hash(some)) == 16
    others = [some[::-1], some[:2], (replace(some[0], sentence="Another."), *some[1:])]
    assert len({corpus_hash(each) for each in [some, *others]}) == 4
