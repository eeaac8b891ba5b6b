"""Figures of a set of scenarios: how many, how large, what is done where, how varied."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from genc.scenario.scenario import Group, Scenario
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category

ActionRow = tuple[Action, ...]


@dataclass(frozen=True)
class Statistics:
    """Figures of a set of scenarios.

    Attributes:
        n_scenarios, n_groups, n_agents, n_events, n_nodes: counts; a node is one agent doing one thing.
        group_sizes: for each number of agents, how many groups have it.
        chain_lengths: for each number of steps, how many agents have it.
        action_shares, category_shares: the share of each word among the nodes.
        n_distinct_sequences: how many different rows of actions the agents have.
        sequence_entropy: the entropy of these rows, normalised: 0 if all agents do the same, 1 if all
            rows are equally frequent (Gen-C, Assessment of LLM-bootstrapped Data).
    """

    n_scenarios: int
    n_groups: int
    n_agents: int
    n_events: int
    n_nodes: int
    group_sizes: Mapping[int, int]
    chain_lengths: Mapping[int, int]
    action_shares: Mapping[Action, float]
    category_shares: Mapping[Category, float]
    n_distinct_sequences: int
    sequence_entropy: float


def statistics(scenarios: Iterable[Scenario]) -> Statistics:
    """The figures of these scenarios."""
    scenarios = tuple(scenarios)
    groups = [group for scenario in scenarios for group in scenario.groups]
    sequences = Counter(sequence for group in groups for sequence in _sequences(group))
    actions: Counter[Action] = Counter()
    categories: Counter[Category] = Counter()
    for scenario in scenarios:
        for event in scenario.events:
            for action, name in event.pairs:
                actions[action] += len(event.agents)
                categories[scenario.environment[name].category] += len(event.agents)
    lengths: Counter[int] = Counter()
    for sequence, n in sequences.items():
        lengths[len(sequence)] += n
    n_nodes = actions.total()
    return Statistics(
        n_scenarios=len(scenarios),
        n_groups=len(groups),
        n_agents=sequences.total(),
        n_events=sum(len(group.events) for group in groups),
        n_nodes=n_nodes,
        group_sizes=_ascending(Counter(len(group.agents) for group in groups)),
        chain_lengths=_ascending(lengths),
        action_shares={action: actions[action] / max(n_nodes, 1) for action in ACTIONS},
        category_shares={category: categories[category] / max(n_nodes, 1) for category in CATEGORIES},
        n_distinct_sequences=len(sequences),
        sequence_entropy=_normalised_entropy(sequences),
    )


def _sequences(group: Group) -> Iterator[ActionRow]:
    """The row of actions of each agent, in order of event ids."""
    rows: dict[str, list[Action]] = {agent: [] for agent in group.agents}
    for event in sorted(group.events, key=lambda event: event.id):
        for agent in event.agents:
            rows[agent] += (action for action, _ in event.pairs)
    return map(tuple, rows.values())


def _normalised_entropy(counts: Counter[ActionRow]) -> float:
    total = counts.total()
    entropy = -sum(n / total * math.log(n / total) for n in counts.values())
    return entropy / math.log(len(counts)) if len(counts) > 1 else 0.0


def _ascending(counts: Counter[int]) -> dict[int, int]:
    return dict(sorted(counts.items()))
