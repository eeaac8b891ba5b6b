from __future__ import annotations

import csv
import json
import re
from collections.abc import Sequence
from dataclasses import asdict, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from genc.errors import DatasetError, ExtraError, OutputError, ScriptError
from genc.evaluate import provenance
from genc.evaluate.annotations import SYNTHETIC_ANNOTATIONS
from genc.evaluate.assessment import Assessment, assess
from genc.evaluate.assessment_report import deviations_table, figures_table, to_markdown, write_assessment
from genc.evaluate.deviations import deviations
from genc.evaluate.lives import FEWEST_LIVES, Lives, of_samples, read_lives
from genc.evaluate.material import samples
from genc.evaluate.sequences import ActionSequence, normalised_entropy, rarefied_entropy
from genc.evaluate.transition_maps import transition_maps
from genc.evaluate.transitions import transition_matrix
from genc.learn.build import build_dataset
from genc.scenario.corpus import load_theme, themes
from genc.scenario.script import write_script
from genc.words.embed import Hashing
from genc.words.vocabulary import ACTIONS

DOCS = Path(__file__).parents[2] / "docs/assessment.md"
FILES = {
    *("assessment.md", "assessment.json", "transitions.png"),
    *("transitions_a.csv", "transitions_b.csv", "transitions_difference.csv"),
}
MUSEUM = "museum"


def lives(sequences: Sequence[ActionSequence], n_clusters: int, *, annotated: bool = False) -> Lives:
    clusters = tuple(str(i % n_clusters) for i in range(len(sequences)))
    return Lives("made", tuple(sequences), clusters, annotated)


def walks(matrix: np.ndarray, n_clusters: int, rng: np.random.Generator, alike: float = 0.0) -> Lives:
    """Six lives in each cluster by a Markov chain of three actions; a share of them repeat their cluster's first."""
    found: list[ActionSequence] = []
    for _ in range(n_clusters):
        own = []
        for _ in range(6):
            life = [int(rng.integers(3))]
            while len(life) < 5:
                life.append(int(rng.choice(3, p=matrix[life[-1]])))
            own.append(own[0] if own and rng.random() < alike else tuple(life))
        found += own
    return Lives("walks", tuple(found), tuple(str(i // 6) for i in range(len(found))))


@pytest.fixture(scope="module")
def museum() -> Lives:
    return read_lives(MUSEUM)


@pytest.fixture(scope="module")
def beside_video() -> Assessment:
    return assess(MUSEUM, SYNTHETIC_ANNOTATIONS)


@pytest.fixture(scope="module")
def folder(beside_video: Assessment, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("assessment") / "new"
    assert write_assessment(beside_video, place) == place / "assessment.md"
    return place


def test_a_theme_its_scripts_and_a_dataset_of_it_are_the_same_lives(museum, tmp_path):
    scenarios = load_theme(MUSEUM)
    build_dataset(scenarios, Hashing(), tmp_path / "data")
    (tmp_path / "some.txt").write_text(write_script(scenarios), encoding="utf-8")
    for place in (MUSEUM.upper(), tmp_path / "data", tmp_path / "some.txt"):
        found = read_lives(place)
        assert sorted(zip(found.sequences, found.clusters, strict=True)) == sorted(
            zip(museum.sequences, museum.clusters, strict=True)
        )
        assert not found.annotated
    assert museum.n_clusters == len(scenarios)
    assert len(museum.sequences) == sum(len(group.agents) for s in scenarios for group in s.groups)


def test_a_place_goes_before_a_theme_of_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / MUSEUM).mkdir()
    (tmp_path / MUSEUM / "1.txt").write_text(write_script(load_theme("hospital")[:1]), encoding="utf-8")
    assert {cluster.split("/")[0] for cluster in read_lives(MUSEUM).clusters} == {"hospital"}


def test_scenarios_of_two_themes_with_one_name_are_two_clusters():
    one = samples(load_theme(MUSEUM)[:1], 0)
    assert of_samples("both", one + [replace(s, theme="other") for s in one]).n_clusters == 2


def test_what_holds_no_lives_is_refused(tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "half" / "partial").mkdir(parents=True)
    few = replace(load_theme(MUSEUM)[0], groups=load_theme(MUSEUM)[0].groups[:1])
    (tmp_path / "few.txt").write_text(write_script([few]), encoding="utf-8")
    for place, error, said in (
        ("musem", DatasetError, "musem: no such file or folder, and unknown theme 'musem'; did you mean 'museum'"),
        (tmp_path / "empty", ScriptError, "no scripts in this folder"),
        (tmp_path / "half", DatasetError, "no dataset here"),
        (tmp_path / "few.txt", DatasetError, f"at least {FEWEST_LIVES}"),
    ):
        with pytest.raises(error, match=said) as caught:
            read_lives(place)
        assert "\n" not in str(caught.value)


def test_repetitions_are_made_one_on_both_sides_beside_video_and_else_on_demand(museum):
    repeated = lives([(0, 0, 1, 1, 0), (2, 2)] * 20, 20)
    assert repeated.merged().sequences[:2] == ((0, 1, 0), (2,))
    assert not assess(museum, repeated).merged
    video = replace(repeated, annotated=True)
    for found in (assess(museum, video), assess(video, museum), assess(museum, repeated, merge=True)):
        assert found.merged
        for side in (found.a, found.b):
            assert np.nansum(np.diag(side.transitions)) == 0
            assert side.lives.merged().sequences == side.lives.sequences
    assert any(x == y for life in museum.sequences for x, y in pairwise(life))


def test_entropies_are_those_of_one_size(museum):
    other = read_lives("hospital")
    found = assess(museum, other)
    assert found.size == min(len(museum.sequences), len(other.sequences)) // 2
    for side, of in ((found.a, museum), (found.b, other)):
        assert side.entropy == pytest.approx(rarefied_entropy(of.sequences, found.size))
        assert side.low < side.entropy < side.high
        assert side.as_json()["entropy_of_all"] == normalised_entropy(of.sequences) < side.entropy


def test_exchanged_sides_give_the_same_with_the_sign_changed():
    one, other = assess(MUSEUM, "hospital"), assess("hospital", MUSEUM)
    assert (one.a.as_json(), one.b.as_json()) == (other.b.as_json(), other.a.as_json())
    np.testing.assert_array_equal(one.difference, -other.difference)
    mirrored = {(d.before, d.after): (d.b, d.a, -d.difference.high, -d.difference.low) for d in other.deviations}
    for d in one.deviations:
        assert mirrored.pop((d.before, d.after)) == (d.a, d.b, d.difference.low, d.difference.high)
    assert not mirrored


def test_few_or_uneven_clusters_are_told():
    sequences = [(0, 1), (1, 2, 0), (0,), (2, 1)] * 10
    whole = Lives("one", tuple(sequences), ("x",) * 40)
    found = assess(whole, lives(sequences, 8, annotated=True))
    assert (found.a.low, found.a.high) == (None, None)
    assert found.a.entropy == found.b.entropy
    said = "\n".join(found.notes)
    assert "A has no interval of its entropy: one of its scenarios" in said
    assert "B has 8 clips: its intervals are too narrow." in said
    assert assess(lives(sequences, 20), lives(sequences, 20)).notes == ()


def test_a_corpus_against_itself_differs_in_nothing(museum):
    found = assess(museum, museum)
    assert np.nanmax(np.abs(found.difference)) == 0
    assert all(deviation.sure == 0 for deviation in found.deviations)


def test_deviations_are_of_transitions_that_occur_and_in_order_of_what_is_sure(museum):
    other = read_lives("hospital")
    found = deviations(museum, other)
    of_a, of_b = transition_matrix(museum.sequences), transition_matrix(other.sequences)
    for d in found:
        i, j = ACTIONS.index(d.before), ACTIONS.index(d.after)
        assert (d.a, d.b, d.difference.mean) == (of_a[i, j], of_b[i, j], of_a[i, j] - of_b[i, j])
        assert -1 <= d.difference.low <= d.difference.mean <= d.difference.high <= 1
    assert len(found) == (of_a + of_b > 0).sum()
    assert [d.sure for d in found] == sorted((d.sure for d in found), reverse=True)
    assert found[0].sure > 0


def test_what_a_few_never_did_is_not_surely_rare():
    many = lives([(0, 1), (0, 2)] * 60, 15)  # each cluster has as many of both
    twice = lives([(0, 1)] * 2 + [(3,)] * 18, 20)
    (to_one, *_) = [d for d in deviations(many, twice) if d.after == ACTIONS[1]]
    assert to_one.difference.mean == -0.5
    assert to_one.sure == 0
    often = deviations(many, lives([(0, 1)] * 60, 15))
    assert {d.after: d.sure > 0.3 for d in often} == {ACTIONS[1]: True, ACTIONS[2]: True}


@pytest.mark.parametrize("alike", [0.0, 0.9])
def test_intervals_hold_the_truth_as_often_as_they_say(alike):
    one = np.array([[0.2, 0.5, 0.3], [0.6, 0.1, 0.3], [0.3, 0.3, 0.4]])
    other = np.array([[0.3, 0.3, 0.4], [0.6, 0.2, 0.2], [0.05, 0.05, 0.9]])
    held = []
    for i in range(80):
        rng = np.random.default_rng([7, i])
        for d in deviations(walks(one, 40, rng, alike), walks(other, 30, rng, alike)):
            truth = (one - other)[ACTIONS.index(d.before), ACTIONS.index(d.after)]
            held.append(d.difference.low <= truth <= d.difference.high)
    assert np.mean(held) == pytest.approx(0.95, abs=0.025)


def test_the_files_say_the_same(beside_video, folder):
    assert {file.name for file in folder.iterdir()} == FILES
    said = json.loads((folder / "assessment.json").read_text(encoding="utf-8"))
    assert said == json.loads(json.dumps(beside_video.as_json()))
    assert said["deviations"][0] == json.loads(json.dumps(asdict(beside_video.deviations[0])))
    for name, matrix in (
        ("a", beside_video.a.transitions),
        ("b", beside_video.b.transitions),
        ("difference", beside_video.difference),
    ):
        head, *rows = csv.reader((folder / f"transitions_{name}.csv").read_text(encoding="utf-8").splitlines())
        assert head[1:] == [row[0] for row in rows] == list(ACTIONS)
        shares = np.array([[float(cell or "nan") for cell in row[1:]] for row in rows])
        np.testing.assert_allclose(shares, matrix, atol=5e-7)
    counts = np.array(said["B"]["transition_counts"])
    np.testing.assert_array_equal(counts.sum(1) == 0, np.isnan(beside_video.b.transitions).all(1))
    page = (folder / "assessment.md").read_text(encoding="utf-8")
    assert page == to_markdown(beside_video)
    assert all(f"**Note.** {note}" in page for note in beside_video.notes)
    assert f"{said['A']['n_agents']:,} | {said['B']['n_agents']:,}" in page
    assert f"{said['A']['entropy']['mean']:.4f} | {said['B']['entropy']['mean']:.4f}" in page


def test_the_same_assessment_makes_the_same_bytes_and_another_seed_moves_intervals_only(folder, tmp_path):
    write_assessment(assess(MUSEUM, SYNTHETIC_ANNOTATIONS), tmp_path)
    assert {f.name: f.read_bytes() for f in tmp_path.iterdir()} == {f.name: f.read_bytes() for f in folder.iterdir()}
    one, other = (assess(read_lives(MUSEUM), SYNTHETIC_ANNOTATIONS, seed) for seed in (0, 1))
    assert (one.a.low, one.a.entropy) != (other.a.low, one.a.entropy)
    assert one.a.entropy == other.a.entropy


def test_the_picture_has_three_maps_with_a_grey_row_where_nothing_is_known(beside_video, folder):
    maps = transition_maps(beside_video).axes
    assert [axes.get_title()[:2] for axes in maps] == ["A:", "B:", "A "]
    for axes, matrix in zip(
        maps, (beside_video.a.transitions, beside_video.b.transitions, beside_video.difference), strict=True
    ):
        np.testing.assert_array_equal(np.ma.filled(axes.images[0].get_array(), np.nan), matrix)
        assert [label.get_text() for label in axes.get_yticklabels()] == list(ACTIONS)
    with Image.open(folder / "transitions.png") as image:
        colours = image.convert("RGB").getcolors(1 << 24)
    assert next(n for n, colour in colours if colour == (0xD9, 0xD9, 0xD9)) > 10_000


def test_long_names_fit_above_their_map(museum):
    long = replace(museum, name="/some/where/" + "x" * 300)
    (title, *_) = (axes.get_title() for axes in transition_maps(assess(long, museum)).axes)
    assert len(title) < 45
    assert title.endswith("…")


def test_a_report_that_cannot_be_written_is_one_line(beside_video, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="file"):
        write_assessment(beside_video, tmp_path / "file" / "r")
    monkeypatch.setattr(provenance, "find_spec", lambda name: None)
    with pytest.raises(ExtraError, match=re.escape("genc[evaluate]")):
        write_assessment(beside_video, tmp_path / "r")
    assert not (tmp_path / "r").exists()


def test_the_tables_of_the_docs_are_what_comes_out():
    told = DOCS.read_text(encoding="utf-8")
    (a, b) = re.findall(r'genc assess "([a-z ]+)" "([a-z ]+)"', told)[0]
    assert {a, b} <= set(themes())
    found = assess(a, b)
    assert figures_table(found) in told
    assert deviations_table(found) in told


def test_the_snippet_of_the_docs_runs(tmp_path, capsys):
    (snippet,) = re.findall(r"```python\n(.*?)```", DOCS.read_text(encoding="utf-8"), re.S)
    exec(compile(snippet.replace("out/assessment", str(tmp_path)), DOCS.name, "exec"), {})
    assert "Deviation" in capsys.readouterr().out
    assert {file.name for file in tmp_path.iterdir()} == FILES
