"""Sources of which the outcome is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import museum
import numpy as np
import pytest
from numpy.typing import NDArray

from genc.errors import BriefError, DatasetError
from genc.evaluate.answers import CHANGED, COPIES, VALID
from genc.evaluate.comparison import NAMES, compare
from genc.evaluate.crowd import FRECHET, MMD, PARTICIPATION
from genc.evaluate.evaluation import Evaluation, Trial
from genc.evaluate.examine import examine
from genc.evaluate.figures import ENTROPY, TWO_SAMPLE
from genc.evaluate.interaction import participation_rate
from genc.evaluate.material import Material
from genc.evaluate.measures import profile
from genc.evaluate.pairs import top_pairs
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.model.source import Decoded
from genc.words.brief import Brief

TRIAL = Trial(ask="full", n_repeats=3, seed=0)


class Lot:
    """Groups by lot; and, if `dumb`, all with one action at one place."""

    hash = "1" * 16

    def __init__(self, groups: Sequence[CrowdGraph], dumb: bool = False) -> None:
        self.groups, self.dumb = groups, dumb

    def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
        drawn = [self.groups[i] for i in rng.choice(len(self.groups), len(briefs))]
        none = [np.zeros(g.n_nodes) for g in drawn]
        return [CrowdGraph(g.agent, g.event, z, z) for g, z in zip(drawn, none, strict=True)] if self.dumb else drawn


class Matrices(Lot):
    """The same, decoded with a third of the edges missing from groups of more than ten nodes."""

    def decode(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[Decoded]:
        return [
            Decoded(SignedGraph(a, g.action, g.category), g, float(np.any(a != g.adjacency)))
            for g in self.sample(briefs, rng)
            for a in [g.adjacency if g.n_nodes <= 10 else thinned(g.adjacency)]
        ]


def thinned(adjacency: NDArray[np.int8]) -> NDArray[np.int8]:
    index = np.arange(len(adjacency))
    return np.where((index[:, None] + index) % 3, adjacency, np.int8(0))


@pytest.fixture(scope="module")
def material() -> Material:
    return museum.material()


@pytest.fixture(scope="module")
def of_training(material: Material) -> Evaluation:
    return examine(Lot([s.graph for s in material.train]), material, TRIAL)


def test_training_groups_are_at_the_floor_and_all_copies(of_training: Evaluation) -> None:
    total = of_training["total"]
    assert total.ratio(total.generated) == pytest.approx(1, abs=0.35)
    assert of_training[COPIES].generated.mean == 100
    assert of_training[COPIES].authored.mean < 20
    assert of_training[TWO_SAMPLE].generated.mean == pytest.approx(50, abs=12)
    assert of_training[VALID].generated.mean == 100
    assert of_training["agents as asked"].generated.mean < 60
    assert of_training.facts["model_hash"] == "1" * 16


def test_the_test_groups_themselves_are_at_no_distance(material: Material) -> None:
    class Answered:
        def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
            return [s.graph for s in material.test] * TRIAL.n_repeats

    found = examine(Answered(), material, TRIAL)
    for name in (*NAMES, "total", FRECHET, "actions not as asked"):
        assert found[name].generated.mean == pytest.approx(0, abs=1e-8), name
    assert found[MMD].generated.mean <= 0
    for name in ("agents as asked", "events as asked", "nodes as asked"):
        assert found[name].generated.mean == 100
    assert found[PARTICIPATION].generated.mean == found[PARTICIPATION].authored.mean
    assert found[COPIES].generated == found[COPIES].authored
    assert found[ENTROPY].generated.mean < found[ENTROPY].authored.mean  # thrice the same is less various
    assert found.pairs["generated"] == found.pairs["authored"]


def test_a_source_with_one_label_is_found_out(material: Material, of_training: Evaluation) -> None:
    found = examine(Lot([s.graph for s in material.train], dumb=True), material, TRIAL)
    for name in ("action", "category", "joint", "action transition", "category transition", FRECHET):
        assert found[name].generated.mean > 2 * found[name].floor.mean, name
    assert found["degree"].generated == of_training["degree"].generated
    assert found[TWO_SAMPLE].generated.mean > 95
    assert found[COPIES].generated.mean < 5
    assert found[ENTROPY].generated.mean < found[ENTROPY].authored.low


def test_each_figure_is_what_its_measure_says(material: Material, of_training: Evaluation) -> None:
    groups = Lot([s.graph for s in material.train]).sample(
        [Brief("x")] * 3 * len(material.test), np.random.default_rng(TRIAL.seed).spawn(4)[0]
    )
    test = [s.graph for s in material.test]
    by_hand = compare(profile(test), np.split(profile(groups), 3))
    for name in NAMES:
        assert of_training[name].generated.mean == pytest.approx(by_hand.means[name])
    assert of_training[PARTICIPATION].authored.mean == pytest.approx(100 * participation_rate(test))
    assert of_training[PARTICIPATION].generated.mean == pytest.approx(100 * participation_rate(groups), abs=2)
    assert list(of_training.pairs["generated"]) == top_pairs(groups)
    shares = of_training.histograms["action"]
    assert shares.authored == pytest.approx(
        np.bincount(np.concatenate([g.action for g in test]), minlength=13) / sum(g.n_nodes for g in test)
    )


def test_a_source_of_matrices_has_a_second_column(material: Material, of_training: Evaluation) -> None:
    found = examine(Matrices([s.graph for s in material.train]), material, TRIAL)
    assert found["degree"].generated == of_training["degree"].generated
    assert found["clustering"].decoded.mean > 1.5 * found["clustering"].generated.mean
    assert found["action"].decoded == found["action"].generated
    assert found[PARTICIPATION].decoded.mean < found[PARTICIPATION].generated.mean
    assert found[CHANGED].generated.mean == pytest.approx(100 - found[VALID].decoded.mean)
    assert 0 < found[VALID].decoded.mean < 50
    assert all(figure.decoded is None for figure in of_training.figures)


def test_all_chance_comes_from_the_seed(material: Material, of_training: Evaluation) -> None:
    source = Lot([s.graph for s in material.train])
    again, other = (examine(source, material, replace(TRIAL, seed=seed)) for seed in (0, 1))
    assert again.figures[:-1] == of_training.figures[:-1]  # all but the speed
    assert again.pairs == of_training.pairs
    assert other["total"] != again["total"]


@pytest.mark.parametrize("ask", ["sentence", "caption"])
def test_a_text_alone_asks_for_no_counts(material: Material, ask: str) -> None:
    asked: list[Brief] = []

    class Listening(Lot):
        def sample(self, briefs: Sequence[Brief], rng: np.random.Generator) -> list[CrowdGraph]:
            asked.extend(briefs)
            return super().sample(briefs, rng)

    found = examine(Listening([s.graph for s in material.train]), material, Trial(ask, 1))
    assert [b.text for b in asked] == [getattr(s, ask) for s in material.test]
    assert {b.n_agents for b in asked} == {None}
    assert not [figure for figure in found.figures if "as asked" in figure.name]


def test_odd_trials_and_too_little_material_are_refused(material: Material) -> None:
    for trial, said in (({"ask": "nicely"}, "nicely"), ({"n_repeats": 0}, "0 repeats"), ({"n_repeats": 2000}, "2000")):
        with pytest.raises(BriefError, match=said):
            Trial(**trial)  # type: ignore[arg-type]
    with pytest.raises(DatasetError, match="3 groups"):
        replace(material, test=material.test[:3])
    with pytest.raises(DatasetError, match="20 training groups"):
        replace(material, train=material.train[:20])
