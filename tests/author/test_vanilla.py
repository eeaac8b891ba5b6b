"""The vanilla source over HTTP."""

from __future__ import annotations

import math

import numpy as np
import pytest

from genc.errors import ScriptError
from genc.graph.codec import canonical, group_fault
from genc.model.source import GraphSource
from genc.model.vanilla import Vanilla, is_valid
from genc.words.brief import Brief

SKIERS = "At the ski resort, friends queue for the lift and wave at each other"
PARENTS = "Below the slope, parents sit and look at their children"


@pytest.mark.parametrize("n_agents", [20, 160])
def test_a_crowd_has_the_people_asked_for_and_one_layout(serve, ask, n_agents):
    server = serve()
    vanilla = Vanilla(ask(server))
    groups = vanilla.crowd(SKIERS, n_agents, np.random.default_rng(0))
    assert 0 <= sum(group.n_agents for group in groups) - n_agents < 15  # the server counts in whole groups
    assert is_valid(groups, n_agents)
    before = vanilla.model.spent
    assert vanilla.crowd(SKIERS, n_agents, np.random.default_rng(0)) == groups
    assert vanilla.model.spent == before, "what the journal knows is not paid for again"


def test_it_is_a_graph_source(serve, ask):
    source: GraphSource = Vanilla(ask(serve()))
    briefs = [Brief(SKIERS), Brief(PARENTS), Brief(SKIERS)] * 20
    groups = source.sample(briefs, np.random.default_rng(0))
    assert len(groups) == len(briefs)
    for group in groups:
        assert group_fault(group) is None
        assert canonical(group) == group
    assert len(set(groups)) > 20
    assert source.sample([], np.random.default_rng(0)) == []


def test_what_cannot_be_read_is_said(serve, ask):
    from language_server import Mishaps

    vanilla = Vanilla(ask(serve(Mishaps(kinds=("invalid json",), rate=1.0))))
    with pytest.raises(ScriptError):
        vanilla.crowd(SKIERS, 20, np.random.default_rng(0))


def test_a_crowd_is_valid_within_a_fifth(serve, ask):
    groups = Vanilla(ask(serve())).crowd(SKIERS, 40, np.random.default_rng(0))
    n = sum(group.n_agents for group in groups)
    valid = {asked for asked in range(1, 200) if is_valid(groups, asked)}
    assert valid == set(range(math.ceil(n / 1.2), math.floor(n / 0.8) + 1))
    assert not is_valid([], 20)
