"""Hypothesis strategies for groups: any valid group within small limits."""

from __future__ import annotations

from random import Random

import numpy as np
from hypothesis import strategies as st

from genc.graph.crowd_graph import CrowdGraph
from genc.graph.weave import weave
from genc.scenario.record import Record, Step
from genc.words.vocabulary import ACTIONS, CATEGORIES

_DOINGS = st.lists(st.tuples(st.sampled_from(ACTIONS), st.sampled_from(CATEGORIES)), min_size=1, max_size=3)


@st.composite
def records(draw: st.DrawFn) -> list[Record]:
    """The records of one or several groups."""
    n_agents = draw(st.integers(1, 6))
    casts = draw(st.lists(st.sets(st.integers(0, n_agents - 1), min_size=1), min_size=1, max_size=7))
    missing = set(range(n_agents)) - set().union(*casts)
    casts += [missing] if missing else []
    rows: list[list[Step]] = [[] for _ in range(n_agents)]
    for event, cast in enumerate(casts):
        for action, category in draw(_DOINGS):
            for agent in cast:
                partners = tuple(sorted(cast - {agent}))
                rows[agent].append(Step(event, action, category, partners))
    return [Record(agent, tuple(row)) for agent, row in enumerate(rows)]


def groups() -> st.SearchStrategy[CrowdGraph]:
    """One group: a connected part of drawn records."""
    return records().map(lambda drawn: weave(drawn).groups()[0])


def renumbered(group: CrowdGraph, random: Random) -> CrowdGraph:
    """The same group with its agents numbered anyhow."""
    number = list(range(group.n_agents))
    random.shuffle(number)
    agent = np.array(number)[group.agent]
    order = np.lexsort((group.step, agent, group.event))
    return CrowdGraph(agent[order], group.event[order], group.action[order], group.category[order])
