from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genc.evaluate.adherence import adherence
from genc.evaluate.baselines import Perturb, Random, Rates, Retrieval, Shuffle
from genc.evaluate.baselines.perturb import with_edges, with_nodes, without_edges, without_nodes
from genc.evaluate.baselines.random_groups import random_structures
from genc.evaluate.comparison import compare, floor
from genc.evaluate.measures import Profile, profile
from genc.graph.codec import Tokens, decode, group_fault
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import full_brief
from genc.model.rules import feasible_counts
from genc.words.brief import Brief
from genc.words.embed import Hashing
from genc.words.vocabulary import ACTIONS, CATEGORIES, MAX_AGENTS, MAX_NODES

FEASIBLE = feasible_counts().nonzero().numpy() + 1


def rng(seed: int = 0) -> np.random.Generator:
    return np.random.default_rng(seed)


def counts(group: CrowdGraph) -> list[int]:
    return [group.n_agents, group.n_events, group.n_nodes]


def test_shuffle_meets_counts_that_an_authored_group_has(groups: list[CrowdGraph]) -> None:
    few = groups[:1000]
    briefs = [full_brief("they meet", g) for g in few[::5]]
    found = adherence(briefs, Shuffle(few).sample(briefs, rng()))
    assert (found.valid, found.agents, found.events, found.nodes) == (1, 1, 1, 1)


def test_shuffle_takes_the_nearest_counts_where_none_fit(groups: list[CrowdGraph]) -> None:
    few = [g for g in groups[:400] if g.n_agents != 5]
    (group,) = Shuffle(few).sample([Brief("five", n_agents=5)], rng())
    assert group.n_agents in (4, 6)


def test_shuffle_gives_the_actions_asked_for_but_not_their_order(groups: list[CrowdGraph], authored: Profile) -> None:
    briefs = [full_brief("x", g) for g in groups[:500]]
    drawn = profile(Shuffle(groups[500:2000]).sample(briefs, rng()))
    ground = floor(authored[500:], authored[:500], 50, rng())
    ratios = compare(authored[:500], [drawn]).ratios(ground)
    assert ratios["action"] < 1
    assert ratios["action transition"] > 3
    assert ratios["joint"] > 3


@pytest.mark.parametrize("kind", [Shuffle, Random])
def test_labels_are_those_of_training_where_nothing_is_asked(
    kind: type[Shuffle] | type[Random], groups: list[CrowdGraph]
) -> None:
    few = groups[:500]
    drawn = kind(few).sample([Brief("x")] * 500, rng())
    for name in ("action", "category"):
        trained, found = (np.bincount(np.concatenate([getattr(g, name) for g in some])) for some in (few, drawn))
        assert found / found.sum() == pytest.approx(trained / trained.sum(), abs=0.03)


@settings(max_examples=40)
@given(st.lists(st.sampled_from(range(len(FEASIBLE))), min_size=1, max_size=8), st.integers(0, 99))
def test_a_random_structure_is_valid_with_exactly_the_counts_asked_for(rows: list[int], seed: int) -> None:
    for structure, wanted in zip(random_structures(FEASIBLE[rows], rng(seed)), FEASIBLE[rows], strict=True):
        none = np.zeros((structure[structure >= MAX_AGENTS] - MAX_AGENTS + 1).sum())
        group = decode(Tokens(structure, none, none))
        assert group_fault(group) is None
        assert counts(group) == wanted.tolist()


def test_every_cut_and_every_cast_of_a_small_group_comes_up() -> None:
    # two agents, two events, four nodes: one event is of both for one turn, the other of one of them for two turns,
    # or both are of both for one turn: five structures up to the order of who appears first
    drawn = random_structures(np.tile([2, 2, 4], (4000, 1)), rng())
    kinds, n = np.unique(["-".join(map(str, structure)) for structure in drawn], return_counts=True)
    assert len(kinds) == 4
    assert n.min() > 200


def test_random_takes_open_counts_from_training_as_far_as_they_can_be_had(groups: list[CrowdGraph]) -> None:
    few = [g for g in groups if counts(g) in ([2, 3, 8], [4, 6, 23])]
    drawn = Random(few).sample([Brief("any")] * 60, rng())
    assert {tuple(counts(g)) for g in drawn} == {(2, 3, 8), (4, 6, 23)}
    (of_two,) = Random(few).sample([Brief("two", n_agents=2)], rng())
    assert counts(of_two) == [2, 3, 8]
    (odd,) = Random(few).sample([Brief("one event", n_agents=5, n_events=1)], rng())
    assert counts(odd) in ([5, 1, 10], [5, 1, 15])


def test_random_is_far_in_structure_and_near_in_labels(groups: list[CrowdGraph], authored: Profile) -> None:
    """As in the paper's Table 1."""
    mixed = rng().permutation(len(groups))
    test, train = mixed[:400], [groups[i] for i in mixed[400:]]
    drawn = profile(Random(train).sample([full_brief("x", groups[i]) for i in test], rng()))
    ratios = compare(authored[test], [drawn]).ratios(floor(authored[mixed[400:]], authored[test], 100, rng()))
    assert min(ratios[name] for name in ("degree", "clustering", "diameter", "average path length")) > 3
    assert max(ratios[name] for name in ("action", "category")) < 3
    assert min(ratios[name] for name in ("action transition", "category transition", "joint")) > 2.5


def test_retrieval_finds_a_group_by_its_own_words(groups: list[CrowdGraph]) -> None:
    told = [("people at a fair", "two girls share a kite"), ("people at a fair", "a man sells balloons")]
    found = Retrieval(groups[:2], told, Hashing())
    briefs = [Brief("a man sells balloons"), Brief("two girls share one kite")]
    assert found.sample(briefs, rng()) == [groups[1], groups[0]]
    by_sentence = found.sample([Brief("people at the fair")] * 40, rng())
    assert {by_sentence.count(groups[0]) > 5, by_sentence.count(groups[1]) > 5} == {True}


def test_retrieval_by_the_whole_condition_finds_the_very_group(groups: list[CrowdGraph]) -> None:
    few = groups[::25]
    found = Retrieval(few, [["people"]] * len(few), Hashing(), whole_condition=True)
    asked = [full_brief("people", group) for group in few]
    alike = [[g for g in few if full_brief("people", g) == brief] for brief in asked]
    assert all(g in some for g, some in zip(found.sample(asked, rng()), alike, strict=True))
    by_text = Retrieval(few, [["people"]] * len(few), Hashing())
    assert sum(g in some for g, some in zip(by_text.sample(asked, rng()), alike, strict=True)) < len(few) / 4


@pytest.mark.parametrize("kind", ["shuffle", "retrieval", "random", "perturb"])
def test_same_seed_same_groups(kind: str, groups: list[CrowdGraph]) -> None:
    few = groups[:200]
    made = {"shuffle": Shuffle, "random": Random, "perturb": Perturb}
    source = made[kind](few) if kind in made else Retrieval(few, [["a"]] * len(few), Hashing())
    first, again, other = (source.sample([Brief("a")] * 20, rng(s)) for s in (1, 1, 2))
    assert first == again
    assert first != other


def test_each_way_of_spoiling_does_what_it_says(groups: list[CrowdGraph]) -> None:
    whole = max(groups, key=lambda g: g.n_nodes).adjacency
    n, n_edges = len(whole), np.count_nonzero(whole)
    assert np.array_equal(without_nodes(whole, 0, rng()), whole)
    assert without_nodes(whole, 1, rng()).shape == (1, 1)
    assert len(without_nodes(whole, 0.3, rng())) == pytest.approx(0.7 * n, abs=15)
    assert np.array_equal(without_edges(whole, 0, rng()), whole)
    assert not without_edges(whole, 1, rng()).any()
    fewer = without_edges(whole, 0.5, rng())
    assert np.count_nonzero(fewer) == pytest.approx(n_edges / 2, rel=0.2)
    assert np.array_equal(fewer[fewer != 0], whole[fewer != 0])
    assert with_nodes(whole, 50, rng()).shape == (min(n + 50, MAX_NODES),) * 2
    more = with_nodes(whole[:40, :40], 10, rng())
    linked = np.sort(np.flatnonzero(more.any(0)))
    assert np.array_equal(more[np.ix_(linked, linked)], whole[:40, :40][np.ix_(*[whole[:40, :40].any(0)] * 2)])
    added = with_edges(whole, 30, rng()) - whole
    assert np.array_equal(added, added.T)
    assert np.count_nonzero(added) == 60
    assert not added[whole != 0].any()
    assert {-1, 1} <= set(added.ravel().tolist())
    assert not np.diagonal(with_edges(whole, 10**6, rng())).any()


def test_unspoilt_groups_come_through_repair_unchanged_but_for_labels(groups: list[CrowdGraph]) -> None:
    few = groups[::200]
    briefs = [full_brief("x", g) for g in few]
    for brief, answer in zip(briefs, Perturb(few, Rates(0, 0, 0, 0)).decode(briefs, rng()), strict=True):
        assert answer.change_rate == 0
        assert counts(answer.group) == [brief.n_agents, brief.n_events, brief.n_nodes]


def test_perturbed_groups_have_uniform_labels_and_few_meetings(groups: list[CrowdGraph]) -> None:
    few = groups[::20]
    answers = Perturb(few).decode([full_brief("x", g) for g in few], rng())
    for name, size in (("action", len(ACTIONS)), ("category", len(CATEGORIES))):
        shares = np.bincount(np.concatenate([getattr(a.graph, name) for a in answers]), minlength=size)
        assert shares / shares.sum() == pytest.approx(np.full(size, 1 / size), abs=0.02)
    n_shares = sum((a.graph.adjacency < 0).sum() for a in answers) / sum((g.adjacency < 0).sum() for g in few)
    assert 0.3 < n_shares < 0.7
    assert np.mean([a.change_rate for a in answers]) > 0.05
    assert all(group_fault(a.group) is None for a in answers)
