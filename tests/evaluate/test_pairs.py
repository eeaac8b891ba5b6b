from __future__ import annotations

import numpy as np
import pytest

from genc.evaluate.pairs import Pair, top_pairs
from genc.graph.crowd_graph import CrowdGraph
from genc.graph.signed_graph import SignedGraph
from genc.words.vocabulary import ACTION_INDEX, CATEGORY_INDEX, Action, Category


def doing(*pairs: tuple[Action, Category]) -> SignedGraph:
    action, category = ([ACTION_INDEX[a] for a, _ in pairs], [CATEGORY_INDEX[c] for _, c in pairs])
    return SignedGraph(np.zeros((len(pairs),) * 2, dtype=np.int8), np.array(action), np.array(category))


SIT, WAIT, ENTER = (
    (Action.SIT, Category.FURNITURE),
    (Action.WAIT, Category.SERVICE_AREA),
    (Action.ENTER_EXIT, Category.ENTRANCE),
)


def test_shares_are_of_all_nodes_of_all_groups() -> None:
    found = top_pairs([doing(SIT, SIT, ENTER), doing(SIT, ENTER, WAIT, (Action.SIT, Category.ROOM))], k=2)
    assert [(p.action, p.category) for p in found] == [SIT, ENTER]
    assert [p.share for p in found] == pytest.approx([3 / 7, 2 / 7])


def test_ties_are_broken_by_the_vocabulary() -> None:
    sit_in = [(Action.SIT, category) for category in (Category.SERVICE_AREA, Category.BUILDING)]
    found = top_pairs([doing(ENTER, *sit_in, WAIT)])
    assert [(p.action, p.category) for p in found] == [WAIT, sit_in[1], sit_in[0], ENTER]


def test_only_pairs_that_occur() -> None:
    assert len(top_pairs([doing(SIT, ENTER)], k=10)) == 2
    assert len(top_pairs([doing(SIT, ENTER)], k=1)) == 1


def test_a_pair_reads_as_in_the_paper() -> None:
    assert str(Pair(*SIT, 0.0849)) == "sit@furniture 0.08"
    assert str(Pair(*ENTER, 1 / 3)) == "enter/exit@entrance 0.33"


def test_authored_groups(groups: list[CrowdGraph]) -> None:
    found = top_pairs(groups)
    assert len(found) == 4
    assert (found[0].action, found[0].category) == ENTER
    shares = [p.share for p in found]
    assert shares == sorted(shares, reverse=True)
    at_doors = [(g.action == ACTION_INDEX[ENTER[0]]) & (g.category == CATEGORY_INDEX[ENTER[1]]) for g in groups]
    assert shares[0] == pytest.approx(np.mean(np.concatenate(at_doors)))
