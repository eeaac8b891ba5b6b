"""What can be evaluated on: datasets and scripts, and what is refused."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from genc.errors import BriefError, CheckpointError, DatasetError, ScriptError
from genc.evaluate import material as materials
from genc.evaluate.baselines import Perturb, Random, Retrieval, Shuffle
from genc.evaluate.material import Remembered, read_material, samples
from genc.evaluate.sources import load_source
from genc.learn.build import build_dataset
from genc.learn.dataset import load_dataset
from genc.scenario.corpus import load_theme, themes
from genc.scenario.scenario import Scenario
from genc.scenario.script import write_script
from genc.words.embed import Hashing


def scenarios() -> tuple[Scenario, ...]:
    """Ten of one theme, six of another."""
    one, other = themes()[:2]
    return (*load_theme(one)[:10], *load_theme(other)[:6])


@pytest.fixture(scope="module")
def dataset(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("material") / "data"
    build_dataset(scenarios(), Hashing(), place)
    return place


@pytest.fixture
def _small_corpus(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(materials, "load_corpus", scenarios)


def hidden(folder: Path, some: Sequence[Scenario]) -> Path:
    """Scripts that no corpus has: these scenarios with another name, sentence and caption."""
    folder.mkdir()
    for i, s in enumerate(some):
        groups = (replace(s.groups[0], caption="they came in from the snow"), *s.groups[1:])
        told = replace(s, slug=f"hidden-{i}", sentence=f"{s.sentence} It snows.", groups=groups)
        (folder / f"{i}.txt").write_text(write_script([told]), encoding="utf-8")
    return folder


def test_a_dataset_gives_the_part_asked_for_and_trains_on_its_own(dataset: Path) -> None:
    data = load_dataset(dataset)
    for part, splits in (("test", ["test"]), ("validation", ["validation"]), ("held-out", ["validation", "test"])):
        found = read_material(dataset, part=part)
        assert found.test == [s for split in splits for s in data.split(split)]
        assert found.train == data.split("train")
        assert found.facts["dataset_hash"] == data.manifest.hash
    assert read_material(dataset).test == data.split("test")
    assert isinstance(found.encoder(), Remembered)


def test_a_theme_is_compared_with_training_of_its_own(dataset: Path) -> None:
    theme = themes()[0]
    found = read_material(dataset, theme.upper().replace(" ", "_"), "held-out")
    assert {s.theme for s in found.test} == {s.theme for s in found.train} == {theme}
    with pytest.raises(BriefError, match=themes()[1]):
        read_material(dataset, "the moon")


def test_remembered_vectors_are_those_of_the_encoder(dataset: Path) -> None:
    data = load_dataset(dataset)
    texts = [s.caption for s in data.split("test")]
    np.testing.assert_array_equal(Remembered(data).encode(texts), Hashing().encode(texts))


@pytest.mark.usefixtures("_small_corpus")
def test_scripts_are_all_compared_with_the_shipped_corpus(tmp_path: Path) -> None:
    some = scenarios()[:3]
    found = read_material(hidden(tmp_path / "scripts", some))
    assert [s.graph for s in found.test] == [s.graph for s in samples(some, 0)]
    assert {s.theme for s in found.train} == {themes()[0]}  # of the theme compared, for there are enough
    assert not found.notes
    copied = tmp_path / "copied.txt"
    copied.write_text(write_script([replace(s, sentence=f"{s.sentence} It snows.") for s in some]), encoding="utf-8")
    assert "3 of these scenarios come with genc" in read_material(copied).notes[0]
    assert all(s.sentence.endswith("It snows.") for s in found.test)


@pytest.mark.usefixtures("_small_corpus")
def test_what_is_compared_does_not_stand_in_training(tmp_path: Path) -> None:
    (tmp_path / "known.txt").write_text(write_script(scenarios()[:3]), encoding="utf-8")
    found = read_material(tmp_path / "known.txt")
    assert not {s.sentence for s in found.test} & {s.sentence for s in found.train}
    assert found.notes[0].startswith("3 of these scenarios")


@pytest.mark.usefixtures("_small_corpus")
def test_a_theme_that_was_never_trained_on_is_compared_with_all(tmp_path: Path) -> None:
    place = hidden(tmp_path / "scripts", [replace(s, theme="space station") for s in scenarios()[:2]])
    found = read_material(place, "Space Station")
    assert {s.theme for s in found.train} == set(themes()[:2])
    assert "that of all themes" in found.notes[0]


@pytest.mark.usefixtures("_small_corpus")
def test_what_is_no_material_is_refused(dataset: Path, tmp_path: Path) -> None:
    few = replace(scenarios()[0], groups=scenarios()[0].groups[:3])
    (tmp_path / "empty").mkdir()
    (tmp_path / "half" / "partial").mkdir(parents=True)
    (tmp_path / "one.txt").write_text(write_script([few]), encoding="utf-8")
    for path, part, error, said in (
        (tmp_path / "none", None, ScriptError, "no such file"),
        (tmp_path / "empty", None, DatasetError, "neither a dataset"),
        (tmp_path / "half", None, DatasetError, "no dataset here"),
        (tmp_path / "one.txt", "test", DatasetError, "scripts have no test part"),
        (tmp_path / "one.txt", None, DatasetError, "groups to compare with"),
        (dataset, "best", DatasetError, "'best'"),
    ):
        with pytest.raises(error, match=said) as caught:
            read_material(path, None, part)
        assert "\n" not in str(caught.value)


def test_sources_are_found_by_name(dataset: Path, tmp_path: Path) -> None:
    material = read_material(dataset)
    kinds = {"random": Random, "perturb": Perturb, "shuffle": Shuffle, "retrieval": Retrieval}
    for name, kind in kinds.items():
        assert isinstance(load_source(name, material), kind)
    with pytest.raises(CheckpointError, match="nor a baseline"):
        load_source("gpt", material)
    with pytest.raises(CheckpointError, match="no model here"):
        load_source(tmp_path, material)
