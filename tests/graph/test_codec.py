from __future__ import annotations

import numpy as np
import pytest
from drawn_groups import groups
from hypothesis import given

from genc.graph.codec import Tokens, canonical, decode, encode, group_fault, turns_token
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import unfold, weave
from genc.scenario.corpus import load_corpus
from genc.scenario.rehearse import rehearse


@given(groups())
def test_decode_takes_back_what_encode_makes(group):
    assert decode(encode(group)) == canonical(group)


@given(groups())
def test_tokens_are_one_spelling_of_a_group(group):
    tokens = encode(group)
    again = encode(decode(tokens))
    assert all(np.array_equal(a, b) for a, b in zip(vars(tokens).values(), vars(again).values(), strict=True))


@given(groups())
def test_agents_are_numbered_by_first_appearance(group):
    agents = canonical(group).agent
    firsts = [int(np.flatnonzero(agents == a)[0]) for a in range(group.n_agents)]
    assert firsts == sorted(firsts)


def test_every_authored_group_is_represented():
    n_groups = n_nodes = 0
    for i, scenario in enumerate(load_corpus()):
        records = list(rehearse(scenario, np.random.default_rng(i)).records)
        graph = weave(records)
        if i % 12 == 0:
            assert unfold(graph) == records
        for group in graph.groups():
            assert group_fault(group) is None
            n_groups, n_nodes = n_groups + 1, n_nodes + group.n_nodes
            if i % 12 == 0:
                assert decode(encode(group)) == canonical(group)
    assert (n_groups, n_nodes) == (5306, 78707)


def test_graphs_that_are_no_group_are_refused():
    apart = CrowdGraph(np.array([0, 1]), np.array([0, 1]), np.array([0, 0]), np.array([0, 0]))
    with pytest.raises(ValueError, match="falls apart"):
        encode(apart)
    long = CrowdGraph(np.zeros(101, int), np.zeros(101, int), np.zeros(101, int), np.zeros(101, int))
    with pytest.raises(ValueError, match="101 nodes"):
        encode(long)


@pytest.mark.parametrize(
    ("structure", "n_steps"), [([0], 0), ([turns_token(1)], 1), ([0, turns_token(2)], 1), ([0, turns_token(1), 0], 1)]
)
def test_tokens_that_spell_no_group_are_refused(structure, n_steps):
    nothing = np.zeros(n_steps, dtype=int)
    with pytest.raises(ValueError, match="event"):
        decode(Tokens(np.array(structure), nothing, nothing))
