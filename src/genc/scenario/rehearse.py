"""Rehearsal: a scenario is run once, so that everybody's steps come into an order (Gen-C, Bootstrapping)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from genc.scenario.durations import sample_durations
from genc.scenario.record import Record, Step
from genc.scenario.scenario import Event, Scenario
from genc.words.vocabulary import ACTION_INDEX, CATEGORY_INDEX

_Agent = tuple[int, str]
"""Group and letter."""


@dataclass(frozen=True)
class Rehearsal:
    """What a rehearsal found.

    Attributes:
        records: one for each agent; agents are numbered by group, then letter. Events are numbered from 0 in
            the order in which they began; of those that began at once, the one with the lower id first.
        triggers: for each event that waited for another, the number of that other.
        group_of: for each agent, the index of its group.
        captions: for each group, its caption.
    """

    records: tuple[Record, ...]
    triggers: Mapping[int, int]
    group_of: tuple[int, ...]
    captions: tuple[str, ...]


def rehearse(scenario: Scenario, rng: np.random.Generator) -> Rehearsal:
    """What everybody does, in order, when the scenario is run once.

    An event begins when its trigger has ended and all its agents are free; it lasts as long as its pairs do,
    by the one table of durations. Agents take their events in order of id, except where a trigger says
    otherwise (`running_order`). The scenario must be sound (`faults` finds nothing).
    """
    cast = {event.id: _cast(g, event) for g, group in enumerate(scenario.groups) for event in group.events}
    begin_s = _begin_s(scenario, cast, rng)
    begun = sorted(scenario.events, key=lambda event: (begin_s[event.id], event.id))
    number = {event.id: n for n, event in enumerate(begun)}

    agents = [(g, letter) for g, group in enumerate(scenario.groups) for letter in group.agents]
    index = {agent: i for i, agent in enumerate(agents)}
    steps: list[list[Step]] = [[] for _ in agents]
    for event in begun:
        together = [index[agent] for agent in cast[event.id]]
        for action, name in event.pairs:
            category = scenario.environment[name].category
            for i in together:
                partners = tuple(other for other in together if other != i)
                steps[i].append(Step(number[event.id], action, category, partners, name))
    return Rehearsal(
        records=tuple(Record(i, tuple(row)) for i, row in enumerate(steps)),
        triggers={number[event.id]: number[event.after] for event in begun if event.after is not None},
        group_of=tuple(g for g, _ in agents),
        captions=tuple(group.caption for group in scenario.groups),
    )


def running_order(events: Mapping[int, Event], cast: Mapping[int, tuple[_Agent, ...]]) -> list[int]:
    """The ids of all events, in an order that respects every trigger and, where triggers allow, every agent.

    An agent's events follow in order of id. Where authors contradict that with a trigger (event 5 waits for
    event 9 of the same person), the trigger wins: 9 comes just before 5, and all else stays in its order.
    """
    to_do: dict[_Agent, list[int]] = {}
    for event_id in sorted(events):
        for agent in cast[event_id]:
            to_do.setdefault(agent, []).append(event_id)
    unplaced = dict.fromkeys(sorted(events))
    pending: list[int] = []

    def waits_for(event_id: int | None) -> Iterator[int]:
        """The event itself and the row of triggers behind it that are still to be placed."""
        while event_id in unplaced:
            yield event_id
            event_id = events[event_id].after

    def due_before(event_id: int) -> int | None:
        """An event to place before this one. Its trigger must be; an agent's earlier event only gives way
        if it waits, by triggers, for what is pending already."""
        trigger = events[event_id].after
        if trigger in unplaced:
            return trigger
        earlier = {e for agent in cast[event_id] for e in to_do[agent] if e < event_id}
        return next((e for e in sorted(earlier) if not set(pending).intersection(waits_for(e))), None)

    order: list[int] = []
    while unplaced:
        pending = [next(iter(unplaced))]
        while pending:
            before = due_before(pending[-1])
            if before is not None:
                pending.append(before)
                continue
            placed = pending.pop()
            order.append(placed)
            del unplaced[placed]
            for agent in cast[placed]:
                to_do[agent].remove(placed)
    return order


def _cast(group: int, event: Event) -> tuple[_Agent, ...]:
    return tuple((group, letter) for letter in sorted(event.agents))


def _begin_s(scenario: Scenario, cast: Mapping[int, tuple[_Agent, ...]], rng: np.random.Generator) -> dict[int, float]:
    """When each event begins, by id."""
    events = {event.id: event for event in scenario.events}
    length_s = _lengths_s(scenario, events, rng)
    begin_s: dict[int, float] = {}
    end_s: dict[int | None, float] = {None: 0.0}
    free_s: dict[_Agent, float] = {}
    for event_id in running_order(events, cast):
        ready_s = [free_s.get(agent, 0.0) for agent in cast[event_id]]
        begin_s[event_id] = max(end_s[events[event_id].after], *ready_s)
        end_s[event_id] = begin_s[event_id] + length_s[event_id]
        free_s.update(dict.fromkeys(cast[event_id], end_s[event_id]))
    return begin_s


def _lengths_s(scenario: Scenario, events: Mapping[int, Event], rng: np.random.Generator) -> dict[int, float]:
    """How long each event takes, by id: the sum over its pairs."""
    ids = sorted(events)
    pairs = [pair for event_id in ids for pair in events[event_id].pairs]
    actions = np.array([ACTION_INDEX[action] for action, _ in pairs])
    categories = np.array([CATEGORY_INDEX[scenario.environment[name].category] for _, name in pairs])
    starts = np.cumsum([0, *(len(events[event_id].pairs) for event_id in ids[:-1])])
    sums_s = np.add.reduceat(sample_durations(actions, categories, rng), starts)
    return dict(zip(ids, sums_s.tolist(), strict=True))
