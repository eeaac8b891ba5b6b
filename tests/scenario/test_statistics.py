from __future__ import annotations

import math

import pytest

from genc.scenario.scenario import Scenario
from genc.scenario.script import parse_script
from genc.scenario.statistics import statistics
from genc.words.vocabulary import Action, Category

SCRIPT = """\
=== bar
S: At the bar.
L: bar | service area | 0,0 | 3x2
L: hall | room | 10,5 | 20x10
G: two meet
2 - ab: discuss@hall
1 - b: wait@hall
G: one is served
3 - a: queue@bar, wait@hall
"""


def test_a_small_script_counted_by_hand() -> None:
    figures = statistics(parse_script(SCRIPT, "s"))
    assert (figures.n_scenarios, figures.n_groups, figures.n_agents) == (1, 2, 3)
    assert (figures.n_events, figures.n_nodes) == (3, 5)
    assert figures.group_sizes == {1: 1, 2: 1}
    assert figures.chain_lengths == {1: 1, 2: 2}
    assert figures.action_shares[Action.DISCUSS] == pytest.approx(2 / 5)
    assert figures.category_shares[Category.SERVICE_AREA] == pytest.approx(1 / 5)
    assert figures.n_distinct_sequences == 3
    assert figures.sequence_entropy == pytest.approx(1)


def test_entropy_falls_when_people_do_the_same() -> None:
    more = SCRIPT + "G: another is served\n4 - a: queue@bar, wait@hall\n"
    p = [2 / 4, 1 / 4, 1 / 4]
    expected = -sum(q * math.log(q) for q in p) / math.log(3)
    assert statistics(parse_script(more, "s")).sequence_entropy == pytest.approx(expected)


def test_the_corpus(authored: tuple[Scenario, ...]) -> None:
    figures = statistics(authored)
    assert (figures.n_scenarios, figures.n_groups, figures.n_agents, figures.n_nodes) == (288, 5306, 10954, 78707)
    assert max(figures.group_sizes) <= 15
    assert sum(figures.action_shares.values()) == pytest.approx(1)
    assert sum(figures.category_shares.values()) == pytest.approx(1)
    assert figures.sequence_entropy > 0.98
