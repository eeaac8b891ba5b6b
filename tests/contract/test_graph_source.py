"""What every `GraphSource` must do; a new generator joins `SOURCES`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import torch

from genc.evaluate.baselines import Perturb, Random, Retrieval, Shuffle
from genc.graph.codec import canonical, group_fault
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import action_frequencies
from genc.graph.weave import weave
from genc.model.codec import CodecConfig, CodecModel
from genc.model.generator import CodecGenerator
from genc.model.paper.generator import PaperGenerator
from genc.model.paper.vgae import PaperConfig, PaperModel
from genc.model.source import GraphSource, MatrixSource
from genc.scenario.corpus import load_theme
from genc.scenario.rehearse import rehearse
from genc.words.brief import Brief
from genc.words.embed import Hashing
from genc.words.vocabulary import ACTIONS

EVEN = (1 / len(ACTIONS),) * len(ACTIONS)
BRIEFS = [
    Brief("visitors look at the bones"),
    Brief("a pair meets", n_agents=2),
    Brief("they do a lot", n_events=12),
    Brief("one long look", n_nodes=41),
    Brief("everything at once", 15, 30, 100, EVEN),
    Brief("as little as can be", 1, 1, 1),
    Brief("all of them once", n_agents=13, n_events=1),
]


def codec(guidance: float = 1.0) -> CodecGenerator:
    torch.manual_seed(0)
    shape = CodecConfig(Hashing.dimension, 16, 2, 4, 8, encoder_depth=1, structure_depth=1, feature_depth=1)
    return CodecGenerator(CodecModel(shape).eval(), Hashing(), "0" * 16, guidance=guidance)


def paper(*, drawn: bool = False) -> PaperGenerator:
    torch.manual_seed(0)
    groups = authored()
    model = PaperModel(PaperConfig(Hashing.dimension, len(groups), width=16, latent=4, condition=8)).eval()
    model.known_counts.copy_(torch.tensor([[g.n_agents, g.n_events, g.n_nodes] for g in groups]))
    model.known_frequencies.copy_(torch.tensor([action_frequencies(g) for g in groups]))
    return PaperGenerator(model, Hashing(), "0" * 16, drawn)


def authored() -> list[CrowdGraph]:
    rng = np.random.default_rng(0)
    return [g for s in load_theme("museum")[:4] for g in weave(rehearse(s, rng).records).groups()]


def told() -> list[list[str]]:
    return [[f"group {i}", "bones"] for i in range(len(authored()))]


SOURCES: dict[str, Callable[[], GraphSource]] = {
    "codec": codec,
    "codec, guided": lambda: codec(guidance=2.5),
    "paper": paper,
    "paper, drawn": lambda: paper(drawn=True),
    "shuffle": lambda: Shuffle(authored()),
    "random": lambda: Random(authored()),
    "perturb": lambda: Perturb(authored()),
    "retrieval": lambda: Retrieval(authored(), told(), Hashing()),
    "retrieval, whole condition": lambda: Retrieval(authored(), told(), Hashing(), whole_condition=True),
}
EXACT = ("codec", "codec, guided", "paper", "paper, drawn", "random")
"""The other baselines give counts only as well as an authored group happens to have them."""
MATRICES = ("paper", "paper, drawn", "perturb")


@pytest.fixture(params=sorted(SOURCES))
def make(request):
    return SOURCES[request.param]


def test_each_brief_gets_one_valid_group_in_canonical_order(make):
    groups = make().sample(BRIEFS * 5, np.random.default_rng(0))
    assert len(groups) == 5 * len(BRIEFS)
    for group in groups:
        assert group_fault(group) is None
        assert canonical(group) == group


@pytest.mark.parametrize("name", EXACT)
def test_counts_are_met_exactly_and_each_answer_belongs_to_its_brief(name):
    briefs = [Brief("x", n_agents=k) for k in range(1, 16)] + BRIEFS * 10
    order = np.random.default_rng(3).permutation(len(briefs))
    briefs = [briefs[i] for i in order]
    for brief, group in zip(briefs, SOURCES[name]().sample(briefs, np.random.default_rng(0)), strict=True):
        for count in ("n_agents", "n_events", "n_nodes"):
            assert getattr(brief, count) in (None, getattr(group, count))


def test_all_chance_comes_from_the_rng(make):
    source = make()
    torch.manual_seed(1)
    first = source.sample(BRIEFS * 3, np.random.default_rng(7))
    torch.manual_seed(2)
    state = torch.get_rng_state()
    assert source.sample(BRIEFS * 3, np.random.default_rng(7)) == first
    assert torch.equal(torch.get_rng_state(), state)
    assert source.sample(BRIEFS * 3, np.random.default_rng(8)) != first


def test_one_rng_gives_other_groups_the_second_time(make):
    source, rng = make(), np.random.default_rng(0)
    assert source.sample(BRIEFS * 3, rng) != source.sample(BRIEFS * 3, rng)


def test_nobody_asking_is_no_fault(make):
    assert make().sample([], np.random.default_rng(0)) == []


@pytest.mark.parametrize("name", MATRICES)
def test_what_is_decoded_is_what_is_sampled_before_its_repair(name):
    source = SOURCES[name]()
    assert isinstance(source, MatrixSource)
    decoded = source.decode(BRIEFS * 3, np.random.default_rng(7))
    assert [answer.group for answer in decoded] == source.sample(BRIEFS * 3, np.random.default_rng(7))
    for answer in decoded:
        adjacency = answer.graph.adjacency
        assert adjacency.dtype == np.int8
        assert np.array_equal(adjacency, adjacency.T)
        assert not np.diagonal(adjacency).any()
        assert set(np.unique(adjacency).tolist()) <= {-1, 0, 1}
        assert len(answer.graph.action) == len(answer.graph.category) == len(adjacency)
        assert answer.change_rate >= 0


def test_only_sources_of_matrices_are_taken_for_such():
    assert {name for name, make in SOURCES.items() if isinstance(make(), MatrixSource)} == set(MATRICES)
