from __future__ import annotations

import json
import subprocess
import sys
import time

import numpy as np
import pytest
import small

from genc.errors import DatasetError
from genc.learn.build import build_dataset
from genc.learn.dataset import SPLITS, load_dataset, split_by_scenario
from genc.words.embed import Hashing

FILES = ("manifest.json", "texts.json", "groups.safetensors", "texts.safetensors")


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return small.dataset(tmp_path_factory.mktemp("dataset") / "museum")


def test_every_group_is_there_with_its_texts(built):
    authored = {(s.slug, g.caption): len(g.agents) for s in small.scenarios() for g in s.groups}
    found = {(s.scenario, s.caption): s.graph.n_agents for part in SPLITS for s in built.split(part)}
    assert found == authored
    sample = built.split("train")[0]
    scenario = next(s for s in small.scenarios() if s.slug == sample.scenario)
    assert (sample.sentence, sample.paraphrases) == (scenario.sentence, scenario.paraphrases)


def test_no_text_of_the_test_set_stands_in_training(built):
    texts = {part: {t for s in built.split(part) for t in (s.sentence, *s.paraphrases, s.caption)} for part in SPLITS}
    assert texts["train"]
    assert not texts["train"] & (texts["test"] | texts["validation"])


def test_embeddings_are_those_of_the_encoder(built):
    np.testing.assert_array_equal(built.embeddings, Hashing().encode(built.texts))


def test_counts_are_those_of_the_graphs(built):
    rows = built.rows("train")
    for row, sample in zip(rows, built.split("train"), strict=True):
        assert built.counts[row].tolist() == [sample.graph.n_agents, sample.graph.n_events, sample.graph.n_nodes]


def test_the_split_is_80_15_5_within_each_theme():
    parts = split_by_scenario(["a"] * 100 + ["b"] * 16 + ["c"] * 3, seed=3)
    of = {t: [parts[i] for i in r] for t, r in {"a": range(100), "b": range(100, 116), "c": range(116, 119)}.items()}
    assert [of["a"].count(p) for p in SPLITS] == [80, 15, 5]
    assert [of["b"].count(p) for p in SPLITS] == [13, 2, 1]
    assert [of["c"].count(p) for p in SPLITS] == [1, 1, 1]
    assert parts != split_by_scenario(["a"] * 100 + ["b"] * 16 + ["c"] * 3, seed=4)


def test_building_again_changes_nothing_and_another_dataset_is_refused(built, tmp_path):
    small.dataset(tmp_path / "d")
    before = [(tmp_path / "d" / name).read_bytes() for name in FILES]
    small.dataset(tmp_path / "d")
    assert [(tmp_path / "d" / name).read_bytes() for name in FILES] == before
    with pytest.raises(DatasetError, match="another dataset"):
        build_dataset(small.scenarios()[:5], Hashing(), tmp_path / "d")
    with pytest.raises(DatasetError, match="at least 3"):
        build_dataset(small.scenarios()[:2], Hashing(), tmp_path / "e")


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("share", [0.0, 0.5])
def test_a_damaged_dataset_is_refused(tmp_path, name, share):
    small.dataset(tmp_path / "d")
    path = tmp_path / "d" / name
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(DatasetError, match="damaged"):
        load_dataset(tmp_path / "d")


def test_other_versions_and_empty_folders_are_refused(tmp_path):
    small.dataset(tmp_path / "d")
    path = tmp_path / "d" / "manifest.json"
    said = json.loads(path.read_text())
    for change, why in (({"schema": 0}, "schema 0"), ({"vocabulary_hash": "x"}, "another vocabulary")):
        path.write_text(json.dumps(said | change))
        with pytest.raises(DatasetError, match=why):
            load_dataset(tmp_path / "d")
    with pytest.raises(DatasetError, match="no dataset here"):
        load_dataset(tmp_path)


SLOW = """
import sys, time
sys.path.insert(0, {tests!r})
import small
from genc.learn import build
from genc.words.embed import Hashing
build.BLOCK = 40
encode = Hashing.encode
def slowly(self, texts):
    time.sleep(0.15)
    return encode(self, texts)
Hashing.encode = slowly
small.dataset({folder!r})
"""


def test_killed_in_the_middle_the_same_call_goes_on_to_the_same_bytes(tmp_path):
    small.dataset(tmp_path / "whole")
    script = SLOW.format(tests=small.__file__.rsplit("/", 1)[0], folder=str(tmp_path / "killed"))
    process = subprocess.Popen([sys.executable, "-c", script])
    partial = tmp_path / "killed" / "partial"
    while process.poll() is None and len(list(partial.glob("*.safetensors"))) < 2:
        time.sleep(0.02)
    assert process.poll() is None, "it ended before it could be killed"
    process.kill()
    process.wait()
    with pytest.raises(DatasetError, match="no dataset here"):
        load_dataset(tmp_path / "killed")
    saved = {file: file.stat().st_mtime_ns for file in partial.glob("*.safetensors")}
    subprocess.run([sys.executable, "-c", script], check=True)
    assert saved
    for name in FILES:
        assert (tmp_path / "killed" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert not partial.exists()
