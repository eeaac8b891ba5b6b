from __future__ import annotations

import numpy as np
import pytest

from genc.evaluate.adherence import adherence
from genc.evaluate.baselines import Retrieval, Shuffle
from genc.evaluate.comparison import compare, floor
from genc.evaluate.measures import Profile, profile
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.describe import full_brief
from genc.words.brief import Brief
from genc.words.embed import Hashing


def test_shuffle_meets_counts_that_an_authored_group_has(groups: list[CrowdGraph]) -> None:
    few = groups[:1000]
    briefs = [full_brief("they meet", g) for g in few[::5]]
    found = adherence(briefs, Shuffle(few).sample(briefs, np.random.default_rng(0)))
    assert (found.valid, found.agents, found.events, found.nodes) == (1, 1, 1, 1)


def test_shuffle_takes_the_nearest_counts_where_none_fit(groups: list[CrowdGraph]) -> None:
    few = [g for g in groups[:400] if g.n_agents != 5]
    (group,) = Shuffle(few).sample([Brief("five", n_agents=5)], np.random.default_rng(0))
    assert group.n_agents in (4, 6)


def test_shuffle_gives_the_actions_asked_for_but_not_their_order(groups: list[CrowdGraph], authored: Profile) -> None:
    briefs = [full_brief("x", g) for g in groups[:500]]
    drawn = profile(Shuffle(groups[500:2000]).sample(briefs, np.random.default_rng(0)))
    ground = floor(authored[500:], authored[:500], 50, np.random.default_rng(0))
    ratios = compare(authored[:500], [drawn]).ratios(ground)
    assert ratios["action"] < 1
    assert ratios["action transition"] > 3
    assert ratios["joint"] > 3


def test_shuffle_draws_from_training_where_nothing_is_asked(groups: list[CrowdGraph]) -> None:
    few = groups[:500]
    drawn = Shuffle(few).sample([Brief("x")] * 500, np.random.default_rng(0))
    trained, found = (np.bincount(np.concatenate([g.action for g in some])) for some in (few, drawn))
    assert found / found.sum() == pytest.approx(trained / trained.sum(), abs=0.03)


def test_retrieval_finds_a_group_by_its_own_words(groups: list[CrowdGraph]) -> None:
    told = [("people at a fair", "two girls share a kite"), ("people at a fair", "a man sells balloons")]
    found = Retrieval(groups[:2], told, Hashing())
    rng = np.random.default_rng(0)
    assert found.sample([Brief("a man sells balloons"), Brief("two girls share one kite")], rng) == [
        groups[1],
        groups[0],
    ]
    by_sentence = found.sample([Brief("people at the fair")] * 40, rng)
    assert {by_sentence.count(groups[0]) > 5, by_sentence.count(groups[1]) > 5} == {True}


@pytest.mark.parametrize("kind", ["shuffle", "retrieval"])
def test_same_seed_same_groups(kind: str, groups: list[CrowdGraph]) -> None:
    few = groups[:200]
    source = Shuffle(few) if kind == "shuffle" else Retrieval(few, [["a"]] * len(few), Hashing())
    first, again, other = (source.sample([Brief("a")] * 20, np.random.default_rng(s)) for s in (1, 1, 2))
    assert first == again
    assert first != other
