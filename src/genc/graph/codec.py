"""A group as a short sequence of tokens, and back: a bijection on all valid groups.

Event by event: who takes part, each agent by number of first appearance, and for how many turns; then for
each turn one action and one category for all who take part. Nothing else is free: the order of nodes, the
sequence edges and the share edges follow.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genc.graph.crowd_graph import CrowdGraph, Ints
from genc.words.vocabulary import MAX_AGENTS, MAX_EVENTS, MAX_NODES

N_STRUCTURE_TOKENS = MAX_AGENTS + MAX_NODES
"""Token `k < 15` says that agent k takes part; token `14 + k` ends the event and says that it has k turns."""


def turns_token(n_turns: int) -> int:
    """The token that ends an event of so many turns."""
    return MAX_AGENTS - 1 + n_turns


@dataclass(frozen=True, eq=False)
class Tokens:
    """One group as tokens.

    Attributes:
        structure: for each event its agents, ascending, then its turns token.
        action: vocabulary index for each turn of each event `[t]`.
        category: the same for categories `[t]`.
    """

    structure: Ints
    action: Ints
    category: Ints


def group_fault(graph: CrowdGraph) -> str | None:
    """Why this graph is no group that the model's limits allow, or None if it is one."""
    if graph.n_agents > MAX_AGENTS:
        return f"{graph.n_agents} agents; a group has at most {MAX_AGENTS}"
    if graph.n_nodes > MAX_NODES:
        return f"{graph.n_nodes} nodes; a group has at most {MAX_NODES}"
    if graph.n_events > MAX_EVENTS:
        return f"{graph.n_events} events; a group has at most {MAX_EVENTS}"
    if graph.part.any():
        return "it falls apart: some of its agents never share an event"
    return None


def canonical(graph: CrowdGraph) -> CrowdGraph:
    """The same group with its agents renumbered by first appearance."""
    _, first = np.unique(graph.agent, return_index=True)
    rank = np.empty(graph.n_agents, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(graph.n_agents)
    agent = rank[graph.agent]
    order = np.lexsort((graph.step, agent, graph.event))
    return CrowdGraph(agent[order], graph.event[order], graph.action[order], graph.category[order])


def encode(graph: CrowdGraph) -> Tokens:
    """The tokens of a group: `decode(encode(g)) == canonical(g)`.

    Raises:
        ValueError: if the graph is not one group within the limits.
    """
    fault = group_fault(graph)
    if fault:
        raise ValueError(f"not a group: {fault}")
    group = canonical(graph)
    leads = np.flatnonzero(group.turn == 0)  # one node for each (event, agent)
    n_turns = np.diff(np.r_[leads, group.n_nodes])
    last_of_event = np.r_[group.event[leads][1:] != group.event[leads][:-1], True]
    ends = MAX_AGENTS - 1 + n_turns[last_of_event]
    structure = np.insert(group.agent[leads], np.flatnonzero(last_of_event) + 1, ends)
    _, first = np.unique(group.event * MAX_NODES + group.turn, return_index=True)
    return Tokens(structure, group.action[first], group.category[first])


def decode(tokens: Tokens) -> CrowdGraph:
    """The group that these tokens spell.

    Raises:
        ValueError: if they spell none.
    """
    ends = np.flatnonzero(tokens.structure >= MAX_AGENTS)
    if len(ends) == 0 or ends[-1] != len(tokens.structure) - 1:
        raise ValueError("the last event has no turns token")
    n_members = np.diff(np.r_[-1, ends]) - 1
    n_turns = tokens.structure[ends] - (MAX_AGENTS - 1)
    if n_members.min() == 0 or any(len(done) != n_turns.sum() for done in (tokens.action, tokens.category)):
        raise ValueError("an event without agents, or turns without actions")
    members = tokens.structure[tokens.structure < MAX_AGENTS]
    member_event = np.repeat(np.arange(len(ends)), n_members)
    if np.any((np.diff(members) <= 0) & (np.diff(member_event) == 0)):
        raise ValueError("the agents of an event are not in ascending order")
    member_turns = n_turns[member_event]
    agent, event = np.repeat(members, member_turns), np.repeat(member_event, member_turns)
    turn = np.arange(len(agent)) - np.repeat(np.cumsum(member_turns) - member_turns, member_turns)
    at = (np.cumsum(n_turns) - n_turns)[event] + turn
    return CrowdGraph(agent, event, tokens.action[at], tokens.category[at])
