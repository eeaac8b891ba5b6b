"""Records to graph and back: `unfold(weave(records)) == records` (Gen-C, Graph-Based Representation)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from genc.graph.crowd_graph import CrowdGraph
from genc.scenario.record import Record, Step
from genc.words.vocabulary import ACTION_INDEX, ACTIONS, CATEGORIES, CATEGORY_INDEX


def weave(records: Sequence[Record]) -> CrowdGraph:
    """The crowd scenario graph of these records: one node for each step of each agent.

    Agents must be numbered 0..A-1 in order and events 0..E-1, each number in use.

    Raises:
        ValueError: if the records contradict each other (a partner who does something else) or are numbered
            otherwise.
    """
    nodes = sorted(
        (step.event, record.agent, i, ACTION_INDEX[step.action], CATEGORY_INDEX[step.category])
        for record in records
        for i, step in enumerate(record.steps)
    )
    if not nodes:
        raise ValueError("no steps to weave")
    event, agent, _, action, category = np.array(nodes, dtype=np.int64).T
    graph = CrowdGraph(agent, event, action, category)
    if unfold(graph) != list(records):
        raise ValueError("the records disagree on who does what with whom, or are not in order of their agents")
    return graph


def unfold(graph: CrowdGraph) -> list[Record]:
    """The records in a graph, one for each agent, in order of agent numbers."""
    together: defaultdict[tuple[int, int], list[int]] = defaultdict(list)
    moments = list(zip(graph.event.tolist(), graph.turn.tolist(), strict=True))
    agents = graph.agent.tolist()
    for moment, agent in zip(moments, agents, strict=True):
        together[moment].append(agent)
    steps: list[list[Step]] = [[] for _ in range(graph.n_agents)]
    actions, categories = graph.action.tolist(), graph.category.tolist()
    for (event, turn), agent, action, category in zip(moments, agents, actions, categories, strict=True):
        partners = tuple(other for other in together[event, turn] if other != agent)
        steps[agent].append(Step(event, ACTIONS[action], CATEGORIES[category], partners))
    return [Record(agent, tuple(row)) for agent, row in enumerate(steps)]
