"""Arrays and tokens that come from outside: kept apart, or refused."""

from __future__ import annotations

import numpy as np
import pytest
from drawn_groups import groups, renumbered
from hypothesis import given
from hypothesis import strategies as st

from genc.graph.codec import Tokens, canonical, decode, encode, group_fault, turns_token
from genc.graph.crowd_graph import CrowdGraph


def test_a_graph_keeps_its_own_arrays():
    zeros = np.zeros(1, dtype=np.int64)
    graph = CrowdGraph(zeros, zeros, zeros, zeros)
    zeros[0] = 7
    assert graph.agent.tolist() == graph.action.tolist() == [0]
    with pytest.raises(ValueError, match="read-only"):
        graph.action[0] = 3


@pytest.mark.parametrize(
    ("structure", "n_actions", "n_categories"),
    [
        ([0, 0, turns_token(1)], 1, 1),
        ([1, 0, turns_token(1)], 1, 1),
        ([0, turns_token(2)], 2, 1),
        ([0, turns_token(2)], 2, 3),
        ([0, turns_token(2)], 1, 2),
        ([-1, turns_token(1)], 1, 1),
        ([1, turns_token(1)], 1, 1),
        ([], 0, 0),
    ],
)
def test_tokens_that_spell_no_graph_are_refused(structure, n_actions, n_categories):
    with pytest.raises(ValueError, match=r"event|gaps"):
        decode(Tokens(np.array(structure, dtype=int), np.zeros(n_actions, int), np.zeros(n_categories, int)))


@given(groups(), st.randoms(use_true_random=False))
def test_renumbering_agents_changes_nobodys_life(group, random):
    renamed = renumbered(group, random)
    assert _lives(canonical(renamed)) == _lives(canonical(group)) == _lives(group)
    assert len(encode(renamed).structure) == len(encode(group).structure)


def _lives(group: CrowdGraph) -> list[list[tuple[int, int, int]]]:
    rows = list(zip(group.agent, group.event, group.action, group.category, strict=True))
    return sorted([(e, a, c) for agent, e, a, c in rows if agent == k] for k in range(group.n_agents))


@given(groups(), st.data())
def test_one_flipped_token_spells_another_graph_or_none(group, data):
    tokens = encode(group)
    structure = tokens.structure.copy()
    at = data.draw(st.integers(0, len(structure) - 1))
    structure[at] = data.draw(st.integers(0, 114).filter(lambda token: token != structure[at]))
    try:
        other = decode(Tokens(structure, tokens.action, tokens.category))
    except ValueError:
        return
    assert other != canonical(group)
    assert group_fault(other) is not None or decode(encode(other)) == canonical(other)
